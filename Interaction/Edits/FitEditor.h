// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Edits the measurements of a Free-Form Deformation, with undo: the lists of the Fit Deformation
/// that is its Lattice. There need not be a fit yet: the first edit makes it, in the same undo
/// step, and the Free-Form Deformation stays the active source. Another Lattice, say of a
/// refinement, becomes the base of the fit.
#ifndef BrainShift_FitEditor_h
#define BrainShift_FitEditor_h

#include "Interaction/Edits/FormerWeights.h"

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <QObject>
#include <QString>
#include <QTimer>

#include <glm/glm.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class pqPipelineSource;
class vtkObject;
class vtkSMProxy;
class vtkSMSourceProxy;

namespace brainshift
{
/// Makes a filter of a kind, such as "FitDeformation", with the settings of a deformation. It is
/// annotated as made by BrainShift, and not registered. `base`: its property Base; null: none.
vtkSmartPointer<vtkSMProxy> makeLatticeFilter(
  vtkSMProxy* deformation, const char* kind, vtkSMProxy* base = nullptr);

/// Registers a new filter in the pipeline, named for its Input and `what` it is: "T1 refined". The
/// controller would make it the active source as well.
void registerQuietly(vtkSMProxy* made, const char* what);

/// Sets all elements of a property; none empties it.
void setNumbers(vtkSMProxy* proxy, const char* name, const std::vector<double>& numbers);

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

  /// Positions (mm) of tissue at rest after the Lattice, before strokes and without the rigid part
  /// of a fit; pulls start from them, too. As many as `rest`; none if there is no Lattice or it
  /// failed. Each call is a request to the server.
  std::vector<glm::dvec3> fittedPositions(const std::vector<glm::dvec3>& rest) const;

  /// Positions (mm) of tissue at rest after the base of the fit; pins hold it there. `rest` itself
  /// without a base, or if it failed. Only the first call after a change is a request to the
  /// server.
  std::vector<glm::dvec3> basePositions(const std::vector<glm::dvec3>& rest) const;

  /// Sets the property Live of a fit (null: nothing): whether the user is dragging a measurement.
  /// The undo stack does not see it.
  static void setLive(vtkSMProxy* fit, bool on);
  /// Ends an edit and a run under way, so that the Lattice is the one that an edit follows. Each
  /// edit does this first; call it before you read a list to change it. Returns whether the Lattice
  /// is another one now.
  bool claim();
  /// One undo step that makes the fit, if there is none, and calls `change` to set its properties.
  void edit(const QString& label, const std::function<void(vtkSMProxy*)>& change);
  /// Replaces a list in one undo step.
  void replace(const char* list, const Numbers& numbers, const QString& label);
  /// Weights of pulls and of pairs of landmarks that are switched off.
  const std::shared_ptr<FormerWeights>& formerWeights() const { return this->Weights; }
  /// Removes the fit. Its base becomes the Lattice again.
  void remove();

  /// Begins an edit of a list. Views draw it at once, at the quality of a moving picture, and the
  /// undo stack does not see it. An edit that runs already is cancelled first.
  void begin(const char* list, const Numbers& underHand);
  /// Replaces the list under the hand.
  void change(const Numbers& underHand);
  /// Ends the edit: one step on ParaView's undo stack (none if nothing changed), then a picture at
  /// full quality.
  void commit(const QString& label);
  /// Ends the edit and restores the state before it. The undo stack sees nothing.
  void cancel();
  bool isEditing() const { return this->Editing; }

Q_SIGNALS:
  /// The fit was added or removed, or one of its properties changed.
  void changed();
  /// An edit is about to read and change the measurements: a run that has put another Lattice there
  /// ends now.
  void aboutToEdit();
  /// The views show the present state of the edit.
  void drawn();

private Q_SLOTS:
  void noticeLattice();
  void noticeFit(vtkObject* fit, unsigned long event, void* clientData, void* name);
  void shareSettings();

private:
  explicit FitEditor(pqPipelineSource* source);

  vtkSmartPointer<vtkSMProxy> base() const; ///< Of the fit, or of the one to be made.
  /// As basePositions(); none without a base, or if it failed.
  std::vector<glm::dvec3> requestBase(const std::vector<glm::dvec3>& rest) const;
  /// A fit with the settings of the deformation, on its base.
  vtkSmartPointer<vtkSMProxy> prepare() const;
  void setLattice(vtkSMProxy* lattice); ///< Null: none.
  void make();
  void restore(); ///< Restores the state before the edit.
  void stopEditing();
  void write(const Numbers& numbers);
  void draw();

  pqPipelineSource* Source;
  const std::shared_ptr<FormerWeights> Weights = std::make_shared<FormerWeights>();
  mutable std::vector<glm::dvec3> BaseRest; ///< Argument of the last requestBase() ...
  /// ... and its result, empty if it failed. Null: it is out of date.
  mutable std::optional<std::vector<glm::dvec3>> BasePositions;
  vtkNew<vtkEventQtSlotConnect> OfSource;
  vtkNew<vtkEventQtSlotConnect> OfFit;
  QTimer Redraw;                        ///< Draws once for all pending events.
  std::string List;                     ///< During an edit: the property.
  Numbers Before;                       ///< During an edit: cancel and undo restore them.
  vtkWeakPointer<vtkSMProxy> UnderHand; ///< During an edit: the fit.
  bool Made = false;                    ///< During an edit: there was no fit before it.
  bool Editing = false;
  bool Writing = false; ///< This editor is changing a property.
};
}

#endif
