// SPDX-License-Identifier: BSD-3-Clause
// Puts the tool in hand into the view that the cursor came to last, or that was made active since,
// and takes it out again: there is one hand, so there is one of these. It also hears the keys that
// tools and slices know.
#ifndef BrainShift_ViewTools_h
#define BrainShift_ViewTools_h

#include "CursorWatch.h"
#include "KeptPictures.h"
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

  // Keys, while the cursor is over a view: O as loaded while held; Page Up and Page Down through
  // the slices of a 2D view; with the stamp in hand I point of interest; while something is under
  // the hand X, Y, Z hold an axis or let it go, Escape cancels.
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void followApplication(); // from now on
  void followCursor(pqRenderView* view);
  void refresh(); // tool, view and filter as they are now
  void suggestRanges();
  void putDown();
  bool handle(const brainshift::HandEvent& event);
  bool pass(const brainshift::HandEvent& event);
  bool knowsKey(int key) const;
  bool pressKey(int key);
  void holdAxis(ToolSettings::AxisHold axis);
  void setInterest();
  void stepSlices(int voxels);
  StrokeEditor* editorUnderCursor() const; // null if nothing can be bent there
  void stopShowingBefore();
  void cancel();
  void drawSoon();
  bool isAlive() const;

  CursorWatch Cursor;
  QPointer<pqRenderView> Under; // where the tool belongs
  KeptPictures Kept;            // for as long as a tool is in hand
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
  bool Zooming = false; // a burst of wheel clicks that began away from tissue
  int CursorX = 0;      // pixels from the view's lower left corner
  int CursorY = 0;
};

#endif
