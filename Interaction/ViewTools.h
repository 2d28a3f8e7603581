// SPDX-License-Identifier: BSD-3-Clause
// Puts the tool in hand into the active view and takes it out again: there is one hand, so there is
// one of these. It also hears the keys that tools know.
#ifndef BrainShift_ViewTools_h
#define BrainShift_ViewTools_h

#include "ToolSettings.h"

#include <QObject>
#include <QPointer>
#include <QTimer>

#include <memory>

class QKeyEvent;
class StrokeEditor;
class ViewProbe;
class ViewTool;
class WidgetInView;
class pqPipelineSource;
class pqRenderView;
namespace brainshift
{
struct HandEvent;
}

class ViewTools : public QObject
{
  Q_OBJECT

public:
  explicit ViewTools(QObject* parent);
  ~ViewTools() override;

  // Keys, while the cursor is over the view: I point of interest, O as loaded while held; while
  // something is under the hand: X, Y, Z hold an axis or let it go, Escape cancels.
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void refresh(); // tool, view and filter as they are now
  void putDown();
  bool handle(const brainshift::HandEvent& event);
  bool pass(const brainshift::HandEvent& event);
  bool knowsKey(int key) const;
  bool pressKey(int key);
  void holdAxis(ToolSettings::AxisHold axis);
  void setInterest();
  void stopShowingBefore();
  void cancel();
  void drawSoon();
  bool isAlive() const;

  QPointer<pqPipelineSource> Deformation;
  QPointer<pqRenderView> View;
  QPointer<StrokeEditor> Editor;
  QPointer<StrokeEditor> ShowingBefore;
  std::unique_ptr<WidgetInView> Widget;
  std::unique_ptr<ViewProbe> Probe;
  std::unique_ptr<ViewTool> Tool;
  ToolSettings::Tool ToolInHand = ToolSettings::Tool::None;
  QTimer Refresh; // after the events that may have changed something
  QTimer Settle;  // ends a burst of wheel clicks
  bool Holding = false;
  bool CursorInside = false;
  bool Zooming = false; // a burst of wheel clicks that began away from tissue
  int CursorX = 0;      // pixels from the view's lower left corner
  int CursorY = 0;
};

#endif
