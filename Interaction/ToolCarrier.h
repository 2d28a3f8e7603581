// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Carries the tool in hand from view to view. The tool belongs to the view that the cursor entered
/// last, or to a view that was made active since then. There is one hand, so there is one carrier.
#ifndef BrainShift_ToolCarrier_h
#define BrainShift_ToolCarrier_h

#include "Interaction/Commands/ToolSettings.h"
#include "Interaction/Views/CursorWatch.h"
#include "Interaction/Views/OtherVolume.h"
#include "Interaction/Workarounds/Updates.h"

#include <vtkType.h>

#include <memory>

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

/// What the hand does in the view of its tool.
enum class Hand
{
  Away, ///< It has no cursor there.
  Hovering,
  HoldingByButton,
  HoldingByKey, ///< See Command::TakeHold.
  Dropped,      ///< The button is still down after Escape.
  Zooming,      ///< A burst of wheel clicks began away from tissue.
};

class ToolCarrier : public QObject
{
  Q_OBJECT

public:
  explicit ToolCarrier(QObject* parent);
  ~ToolCarrier() override;

  /// The tool in hand; null while there is none, or nothing that it could work on.
  HandTool* tool() const { return this->isAlive() ? this->Held.get() : nullptr; }
  Tool kind() const { return this->ToolInHand; }
  Hand hand() const { return this->HandNow; }
  bool isHolding() const;
  bool isEditing() const; ///< Something is under the hand. There must be a tool.
  ViewProbe* probe() const { return this->Probe.get(); }
  pqPipelineSource* deformation() const;
  pqRenderView* view() const; ///< Of the tool.
  pqRenderView* viewUnderCursor() const { return this->Cursor.view(); }
  const glm::ivec2& pixel() const { return this->Pixel; } ///< Of the cursor in the view.
  bool isMovedByKeys() const { return this->ByKeys; }

  /// An event of the hand in the view. True: the camera must not get it.
  bool handle(const HandEvent& event);
  /// Presses or releases without a button.
  void handleByKey(const HandEvent& event);
  /// Brings the cursor to a pixel without the mouse.
  void moveTo(const glm::ivec2& pixel);
  void hoverAgain(); ///< As if the cursor came to where it is.
  void stepSlices(int voxels);
  void cancel();
  /// Ends a burst of wheel clicks, so that it is on the undo stack. A drag goes on.
  void settle();
  /// Shows a volume as loaded, until it is called with null.
  void showBefore(StrokeEditor* editor);
  bool showsBefore() const { return !this->ShowingBefore.isNull(); }

private:
  void followApplication(); ///< Connects the signals of ParaView.
  void followCursor(pqRenderView* view);
  void refresh(); ///< Adapts to the tool, the view and the filter that are active now.
  void take(pqPipelineSource* deformation, pqRenderView* view, Tool tool);
  void suggestRanges();
  void putDown();
  bool hearMouse(const HandEvent& event);
  bool pass(const HandEvent& event);
  bool press(const HandEvent& event);
  bool move(const HandEvent& event);
  bool release(const HandEvent& event);
  bool turnWheel(const HandEvent& event);
  void drawSoon();
  void outlineNothing();
  void reportMoved();
  void drawIfChanged(vtkMTimeType before);
  bool isAlive() const;

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
  std::unique_ptr<HandTool> Held;
  Tool ToolInHand = Tool::None;
  Tool Wanted = Tool::None; ///< Chosen; without a deformation it is not in hand.
  QTimer Refresh;           ///< Merges events that may have changed something.
  QTimer Settle;            ///< Ends a burst of wheel clicks.
  Hand HandNow = Hand::Away;
  bool SaysMoved = false; ///< The request says that the display has a transform.
  bool ByKeys = false;    ///< Keys moved the cursor last, and not the mouse.
  glm::ivec2 Pixel{ 0 };  ///< From the view's lower left corner. Without meaning if Away.
};
}

#endif
