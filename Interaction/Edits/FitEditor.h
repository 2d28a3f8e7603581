// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Edits what was measured for a Free-Form Deformation, with undo: the lists of the Fit Deformation
/// that is its Lattice. There need not be a fit yet: the first edit makes it, in the same undo
/// step, and the Free-Form Deformation stays the active source. Another Lattice, say of a
/// refinement, becomes the base of the fit.
#ifndef BrainShift_FitEditor_h
#define BrainShift_FitEditor_h

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <QObject>
#include <QString>
#include <QTimer>

#include <glm/vec3.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

class pqPipelineSource;
class vtkObject;
class vtkSMProxy;
class vtkSMSourceProxy;

namespace brainshift
{
/// The Fit Deformation that is the Lattice of a Free-Form Deformation. Null if there is none.
vtkSMSourceProxy* fitOf(pqPipelineSource* deformation);

class FitEditor : public QObject
{
  Q_OBJECT

public:
  using Numbers = std::vector<double>;

  /// The editor of a Free-Form Deformation; it lives as long as the source. Null for any other
  /// source.
  static FitEditor* of(pqPipelineSource* source);

  /// The fit, also the one that an edit under the hand made for now. Null if there is none.
  vtkSMSourceProxy* fit() const { return fitOf(this->Source); }
  /// The numbers of a list of the fit, such as "Pulls" or "Pins". None if there is no fit.
  Numbers numbers(const char* list) const;

  /// Where the Lattice draws tissue at rest (mm), before strokes and without the rigid part of a
  /// fit, which pulls are measured against as well. As many as `rest`; none if there is no
  /// Lattice or it failed. It asks the server.
  std::vector<glm::dvec3> fittedPlaces(const std::vector<glm::dvec3>& rest) const;

  /// Where the base of the fit draws tissue at rest (mm), and so where pins hold it. `rest` itself
  /// without a base, or if it failed. It asks the server after a change alone.
  std::vector<glm::dvec3> basePlaces(const std::vector<glm::dvec3>& rest) const;

  /// Sets a list of a fit, within edit().
  static void setNumbers(vtkSMProxy* fit, const char* list, const Numbers& numbers);
  /// Says that a hand moves what was measured (null: nothing), or that it let go. Undo does not see
  /// it.
  static void setLive(vtkSMProxy* fit, bool on);
  /// One undo step that makes the fit, if there is none, and calls `change` to set its properties.
  void edit(const QString& label, const std::function<void(vtkSMProxy*)>& change);
  /// Replaces a list in one undo step.
  void replace(const char* list, const Numbers& numbers, const QString& label);
  /// Takes the fit away. Its base is the Lattice again.
  void remove();

  /// Begins an edit of a list. Views draw it at once, at the quality of a moving picture, and the
  /// undo stack does not see it. An edit that runs already is cancelled first.
  void begin(const char* list, const Numbers& underHand);
  /// Replaces the list under the hand.
  void change(const Numbers& underHand);
  /// Ends the edit: one step on ParaView's undo stack (none if nothing changed), then a picture at
  /// full quality.
  void commit(const QString& label);
  /// Ends the edit and restores what was there before it. The undo stack sees nothing.
  void cancel();
  bool isEditing() const { return this->Editing; }

Q_SIGNALS:
  /// The fit came or went, or one of its properties changed, whoever changed it.
  void changed();
  /// An edit began or ended.
  void editing(bool on);
  /// A new picture of what is under the hand is there.
  void drawn();

private Q_SLOTS:
  void noticeLattice();
  void noticeFit(vtkObject* fit, unsigned long event, void* clientData, void* name);
  void shareSettings();

private:
  explicit FitEditor(pqPipelineSource* source);

  vtkSmartPointer<vtkSMProxy> base() const; ///< Of the fit, or of the one to be made.
  /// As basePlaces(); none without a base, or if it failed.
  std::vector<glm::dvec3> askBase(const std::vector<glm::dvec3>& rest) const;
  /// A fit with the settings of the deformation, on its base.
  vtkSmartPointer<vtkSMProxy> prepare() const;
  static void enter(vtkSMProxy* made);  ///< Shows it in the pipeline.
  void setLattice(vtkSMProxy* lattice); ///< Null: none.
  void make();
  void restore(); ///< What was there before the edit.
  void stopEditing();
  void write(const Numbers& numbers);
  void draw();

  pqPipelineSource* Source;
  mutable std::vector<glm::dvec3> AskedBase; ///< What basePlaces() was asked last ...
  /// ... and the answer, none of them if it failed. Null: to be asked again.
  mutable std::optional<std::vector<glm::dvec3>> BaseAnswer;
  vtkNew<vtkEventQtSlotConnect> OfSource;
  vtkNew<vtkEventQtSlotConnect> OfFit;
  QTimer Redraw;                        ///< Merges the events of one turn of the event loop.
  std::string List;                     ///< During an edit: the property.
  Numbers Before;                       ///< During an edit: cancel and undo restore them.
  vtkWeakPointer<vtkSMProxy> UnderHand; ///< During an edit: the fit.
  bool Made = false;                    ///< During an edit: there was no fit before it.
  bool Editing = false;
  bool Writing = false; ///< This editor changes something right now.
};
}

#endif
