// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Registers the reference of a Compare Volumes rigidly: a few lines of the search, then a picture.
#ifndef BrainShift_AlignEditor_h
#define BrainShift_AlignEditor_h

#include "Interaction/Edits/LiveRun.h"

#include <QList>

#include <glm/glm.hpp>

namespace brainshift
{
/// The figures after a line was searched.
struct AlignFigures
{
  int lines = 0;            ///< searched so far
  double done = 0.0;        ///< fraction of the most rounds there may be, 0 to 1
  double overlap = 0.0;     ///< fraction of the volume with a partner in the reference, 0 to 1
  double information = 0.0; ///< mutual information on this level, nats; more is better
  double informationBefore = 0.0; ///< of the reference where it was, on the same level
  double shift = 0.0;             ///< of the middle of the compared tissue, mm
  double rotation = 0.0;          ///< degrees, 0 or more
  QString refusal;                ///< The reason to discard the result; empty if there is none.
  QString warning;                ///< What the user must check; empty if nothing.
  QString trust;                  ///< "unchecked", "good", "doubtful" or "failed"
  bool isChecking = false;        ///< whether it has searched its last line and checks the result
};

class AlignEditor : public LiveRun
{
  Q_OBJECT

public:
  /// The editor of a Compare Volumes; it lives as long as the source. Null for any other source.
  static AlignEditor* of(pqPipelineSource* source);

  /// Begins an alignment. If it cannot, problem() has the reason and nothing has changed.
  void begin();

  const AlignFigures& figures() const { return this->Figures; }

protected:
  void takeStep() override;
  void keep(State end) override;
  void putResult() override;
  void restore() override; ///< The reference goes back to where it was.
  void comeBack() override;
  void release() override;
  bool dependsOn(vtkObject* proxy, const char* property) const override;
  void followChange(vtkObject* proxy, const char* property) override;
  void followRemoval(pqPipelineSource* source) override;

private:
  explicit AlignEditor(pqPipelineSource* source);

  /// The two properties of a Compare Volumes.
  struct ReferencePlacement
  {
    glm::dvec3 rotation{ 0.0 };    ///< degrees about x, then y, then z
    glm::dvec3 translation{ 0.0 }; ///< mm, world axes
  };

  QString beginAlignment();
  void followDeformation();
  void readFigures();
  ReferencePlacement now() const;
  /// The present result of the search, rounded for the panel.
  ReferencePlacement found() const;
  void put(const ReferencePlacement& placement);
  void show();

  AlignFigures Figures;
  ReferencePlacement Start;
  ReferencePlacement Result; ///< after the last step

  // While it is active:
  QList<QMetaObject::Connection> Edits; ///< To the editors whose edits stop it.
};
}

#endif
