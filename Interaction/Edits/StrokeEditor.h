// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Edits the property Strokes of one Free-Form Deformation, live and with undo. The property is the
/// only truth: the editor keeps no copy of finished strokes. "Under the hand" means strokes that a
/// drag or a burst of wheel clicks is making.
#ifndef BrainShift_StrokeEditor_h
#define BrainShift_StrokeEditor_h

#include "Filters/Deformation/Stroke.h"
#include "Interaction/Workarounds/Selections.h"

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>

#include <QTimer>

#include <glm/glm.hpp>

#include <functional>

class pqPipelineSource;
class vtkSMProxy;
class vtkSMSourceProxy;

namespace brainshift
{
class StrokeEditor : public QObject
{
  Q_OBJECT

public:
  using Strokes = std::vector<Stroke>;

  /// The editor of a Free-Form Deformation; it lives as long as the source. Null for any other
  /// source.
  static StrokeEditor* of(pqPipelineSource* source);
  static StrokeEditor* of(vtkSMSourceProxy* proxy);

  /// The strokes of the property. None if its numbers are not valid strokes.
  Strokes strokes() const;

  /// Begins an edit: appends strokes that are under the hand. Views draw them at once, at the
  /// quality of a moving picture, and the undo stack does not see them. An edit that runs already
  /// is cancelled first. Nothing begins while the numbers of the property are not valid strokes.
  void begin(const Stroke& stroke) { this->begin(Strokes{ stroke }); }
  void begin(const Strokes& underHand);
  /// Begins an edit that replaces the last stroke by `stroke`.
  void beginAtLast(const Stroke& stroke);
  /// Replaces the strokes under the hand.
  void change(const Stroke& stroke) { this->change(Strokes{ stroke }); }
  void change(const Strokes& underHand);
  /// Ends the edit: one step on ParaView's undo stack (none if nothing changed), then a picture at
  /// full quality.
  void commit(const QString& label);
  /// Ends the edit and restores the strokes that were there before it. The undo stack sees nothing.
  void cancel();
  bool isEditing() const { return this->Editing; }

  /// Replaces all strokes in one undo step, as the list of strokes does.
  void replaceAll(const Strokes& strokes, const QString& label);

  /// Calls `measure` after none of the strokes, after the first one, and so on, to all of them. It
  /// draws nothing, and the undo stack sees nothing.
  void walkThrough(const std::function<void()>& measure);

  /// Whether a property is under way to what it was: Strokes while they are walked through,
  /// Strength while the volume is shown as loaded.
  bool bringsBack(const char* property) const;

  /// On: shows the volume as loaded. Off: restores Strength. The undo stack sees neither.
  void showBefore(bool on);
  bool showsBefore() const { return this->ShowsBefore; }
  /// How often it was on, in this window.
  int timesBefore() const { return this->TimesBefore; }

  /// Changes Strength (0 to 1) during a drag of its slider.
  void changeStrength(double strength);
  /// Ends the drag: one undo step.
  void commitStrength();

Q_SIGNALS:
  /// An edit of strokes or of Strength is about to read and change them: a run that has put other
  /// strokes there ends now.
  void aboutToEdit();
  /// The strokes of the property changed, by this editor or by any other.
  void changed();
  /// An edit began or ended.
  void editing(bool on);
  /// A new picture of the strokes under the hand is there. The source announces its new data only
  /// after the edit.
  void drawn();

private Q_SLOTS:
  void notice();

private:
  explicit StrokeEditor(pqPipelineSource* source);

  void startEditing(const Strokes& before, const Strokes& kept, const Strokes& underHand);
  void stopEditing();
  void write(const Strokes& strokes);
  void drawSoon(); ///< Draws once for all pending events.
  void draw();

  pqPipelineSource* Source;
  vtkNew<vtkEventQtSlotConnect> Connector;
  EmptySelections Unselected; ///< During an edit.
  QTimer Redraw;
  Strokes Before; ///< During an edit: cancel and undo restore them.
  Strokes Kept;   ///< During an edit: all strokes not under the hand.
  bool Editing = false;
  bool Writing = false; ///< This editor changes the property right now.
  bool ShowsBefore = false;
  bool Walking = false; ///< walkThrough() is under way.
  int TimesBefore = 0;
  bool ChangesStrength = false;
  double StrengthBefore = 1.0; ///< During a drag of Strength.
  double StrengthAfter = 1.0;  ///< While the volume is shown as loaded.
};

// Edits the property PointOfInterest of a Free-Form Deformation, for the key I and for the panel.
// An edit acts at once, without Apply, and is one undo step. An edit without a change is no step.

/// Moves the point to a position (mm, world axes).
void setPointOfInterest(vtkSMProxy* filter, const glm::dvec3& position);
/// Moves the point to the centre of the volume.
void centrePointOfInterest(vtkSMProxy* filter);
}

#endif
