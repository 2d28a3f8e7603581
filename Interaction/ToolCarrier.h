// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Carries the tool in hand from view to view. The tool belongs to the view that the cursor entered
/// last, or to a view that was made active since then. There is one hand, so there is one carrier.
/// It also hears the keys of the table of commands that work in views.
#ifndef BrainShift_ToolCarrier_h
#define BrainShift_ToolCarrier_h

#include "Interaction/Commands/Commands.h"
#include "Interaction/Commands/ToolSettings.h"
#include "Interaction/Views/CursorWatch.h"
#include "Interaction/Views/KeptPictures.h"
#include "Interaction/Views/OtherVolume.h"
#include "Interaction/Views/RestingCursor.h"

#include <QObject>
#include <QPointer>
#include <QTimer>

#include <vtkType.h>

#include <memory>

class QKeyEvent;
class pqPipelineSource;
class pqRenderView;

namespace brainshift
{
class FitEditor;
class StrokeEditor;
class ViewProbe;
class HandTool;
class WidgetInView;
struct HandEvent;

class ToolCarrier : public QObject
{
  Q_OBJECT

public:
  explicit ToolCarrier(QObject* parent);
  ~ToolCarrier() override;

  /// Keys are heard before ParaView's shortcuts, but only while the cursor is over a view and no
  /// text is typed. The table of commands says what they do.
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void followApplication(); ///< Connects the signals of ParaView.
  void followCursor(pqRenderView* view);
  void refresh(); ///< Adapts to the tool, the view and the filter that are active now.
  void suggestRanges();
  void hoverAgain(); ///< As if the cursor came to where it is.
  void putDown();
  bool hearMouse(const HandEvent& event);
  bool handle(const HandEvent& event);
  bool pass(const HandEvent& event);
  bool canDo(Command command) const;
  void act(const KeyCommand& found, bool shift);
  void holdAxis(ToolSettings::AxisHold axis);
  void setInterest();
  void moveCursor(int way); ///< See Command::MoveCursor.
  void stampByKey(int clicks);
  void holdByKey(bool shift); ///< See Command::TakeHold.
  bool viewHasKeys() const;   ///< The view of the tool has the keyboard.
  void stepSlices(int voxels);
  StrokeEditor* editorUnderCursor() const; ///< Null if nothing can be deformed there.
  void stopShowingBefore();
  void cancel();
  void drawSoon();
  void outlineNothing();
  void drawIfChanged(vtkMTimeType before);
  bool isAlive() const;
  bool isEditing() const; ///< Something is under the hand. The tool must be alive.

  CursorWatch Cursor;
  RestingCursor Resting;
  OtherVolume Other;
  QPointer<pqRenderView> Under; ///< The view that the tool belongs to.
  KeptPictures Kept;            ///< As long as a tool is in hand.
  QPointer<pqPipelineSource> Deformation;
  QPointer<pqRenderView> View;
  QPointer<StrokeEditor> Editor;
  QPointer<FitEditor> Fit;
  QPointer<StrokeEditor> ShowingBefore;
  std::unique_ptr<WidgetInView> Widget;
  std::unique_ptr<ViewProbe> Probe;
  std::unique_ptr<HandTool> Tool;
  ToolKind ToolInHand = ToolKind::None;
  ToolKind Wanted = ToolKind::None; ///< Chosen; without a deformation it is not in hand.
  QTimer Refresh;                   ///< Merges events that may have changed something.
  QTimer Settle;                    ///< Ends a burst of wheel clicks.
  bool Holding = false;
  bool HeldByKey = false; ///< And not by a mouse button.
  bool Dropped = false;   ///< The button is still down after Escape.
  bool Zooming = false;   ///< A burst of wheel clicks began away from tissue.
  bool ByKeys = false;    ///< Keys moved the cursor last, and not the mouse.
  bool HasCursor = false; ///< CursorX and CursorY are a place in the view.
  int CursorX = 0;        ///< Pixels from the view's lower left corner.
  int CursorY = 0;
};
}

#endif
