// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far the landmarks of a Free-Form Deformation are from where they were measured, before and
/// after its last refinement. A refinement replaces the fit that holds the landmarks.
#ifndef BrainShift_LandmarkErrors_h
#define BrainShift_LandmarkErrors_h

#include "Interaction/Edits/RefineEditor.h"

namespace brainshift
{
struct LandmarkRow;

/// Of one landmark: distance (mm) of its drawn tissue from its measured position.
struct LandmarkError
{
  QString name;          ///< number, and the name if there is one
  bool wasInFit = false; ///< whether the deformation before had been fitted to it
  double before = 0.0;
  double now = 0.0;
};

class LandmarkErrors : public QObject
{
  Q_OBJECT

public:
  /// The errors of a Free-Form Deformation; they live as long as the source. Null for any other
  /// source.
  static LandmarkErrors* of(pqPipelineSource* deformation);

  /// In the order of the list of landmarks. Empty while a refinement runs, if none was kept, and if
  /// there were no landmarks when it began.
  const QList<LandmarkError>& errors() const { return this->Errors; }
  /// What to know about all errors: a sentence. Empty if nothing.
  QString note() const;

private:
  explicit LandmarkErrors(pqPipelineSource* deformation);

  void follow();
  void measure();

  pqPipelineSource* const Deformation;
  RefineEditor* const Editor;
  LiveRun::State Last = LiveRun::State::Idle;
  std::vector<LandmarkRow> AtStart;
  double ShiftAtStart = 0.0;   // mm, of the rigid motion that the fit before left out
  double DegreesAtStart = 0.0; // the same
  QList<LandmarkError> Errors;
};
}

#endif
