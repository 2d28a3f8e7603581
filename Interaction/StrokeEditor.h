// SPDX-License-Identifier: BSD-3-Clause
// Edits the property Strokes of one Free-Form Deformation, live and undoable. The property is the
// only truth: nothing here keeps a copy of strokes that are done.
#ifndef BrainShift_StrokeEditor_h
#define BrainShift_StrokeEditor_h

#include "EmptySelections.h"
#include "Filters/Deformation/Stroke.h"

#include <QObject>
#include <QTimer>

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>

#include <vector>

class pqPipelineSource;
class vtkSMSourceProxy;

class StrokeEditor : public QObject
{
  Q_OBJECT

public:
  using Strokes = std::vector<brainshift::Stroke>;

  // The editor of a Free-Form Deformation; it lives as long as the source. Null for anything else.
  static StrokeEditor* of(pqPipelineSource* source);
  static StrokeEditor* of(vtkSMSourceProxy* proxy);

  // What the property holds; none if its numbers are no strokes.
  Strokes strokes() const;

  // Strokes under the hand follow the strokes that are there: seen at once, at the quality of a
  // moving picture, and in no undo step. What is under the hand already is given up first. Nothing
  // begins while the property holds numbers that are no strokes.
  void begin(const brainshift::Stroke& stroke) { this->begin(Strokes{ stroke }); }
  void begin(const Strokes& underHand);
  // The last stroke comes under the hand again, as `stroke`.
  void beginAtLast(const brainshift::Stroke& stroke);
  void change(const brainshift::Stroke& stroke) { this->change(Strokes{ stroke }); }
  void change(const Strokes& underHand);
  // One step on ParaView's undo stack (none if nothing changed), then a picture at full quality.
  void commit(const QString& label);
  // As before begin; nothing on the undo stack.
  void cancel();
  bool isEditing() const { return this->Editing; }

  // Edits of the list: one undo step.
  void replaceAll(const Strokes& strokes, const QString& label);

  // Shows the volume as loaded for as long as it is on; in no undo step. Off: Strength as before.
  void showBefore(bool on);
  bool showsBefore() const { return this->ShowsBefore; }

  // Strength under the hand, 0 to 1: change as often as the hand moves, then commit for one undo
  // step.
  void changeStrength(double strength);
  void commitStrength();

Q_SIGNALS:
  // The property has other strokes, whoever changed it.
  void changed();
  void editing(bool on);
  // There is a new picture of what is under the hand. Until the hand lets go this is the only news:
  // the source's dataUpdated waits for the end.
  void drawn();

private Q_SLOTS:
  void notice();

private:
  explicit StrokeEditor(pqPipelineSource* source);

  void startEditing(const Strokes& before, const Strokes& kept, const Strokes& underHand);
  void stopEditing();
  void write(const Strokes& strokes);
  void drawSoon(); // merges the events of one turn of the event loop into one picture
  void draw();

  pqPipelineSource* Source;
  vtkNew<vtkEventQtSlotConnect> Connector;
  EmptySelections Unselected; // while editing
  QTimer Redraw;
  Strokes Before; // while editing: what cancel and undo come back to
  Strokes Kept;   // while editing: all that is not under the hand
  bool Editing = false;
  bool Writing = false; // the property changes because of this editor
  bool ShowsBefore = false;
  bool ChangesStrength = false;
  double StrengthBefore = 1.0; // while Strength is under the hand
  double StrengthAfter = 1.0;  // while the volume is shown as loaded
};

#endif
