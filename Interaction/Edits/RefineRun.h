// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A refinement beside the data, which may lie on a server: a part of a step for each call, and
/// what is known after it. It changes nothing in the pipeline.
#ifndef BrainShift_RefineRun_h
#define BrainShift_RefineRun_h

#include <vtkSMProxy.h>
#include <vtkSmartPointer.h>

#include <QList>
#include <QString>

#include <optional>
#include <vector>

class pqPipelineSource;

namespace brainshift
{
/// What a refinement compares with, and how.
struct RefineSettings
{
  pqPipelineSource* reference = nullptr; ///< a Compare Volumes of the deformation, or a volume
  pqPipelineSource* cavity = nullptr;    ///< null: none, or that of the Compare Volumes
  int similarity = 0;                    ///< as in vtkRegistrationRun
  double stiffness = 1.0;                ///< factor on what bending costs; above 0
};

/// What is known after a step. Disagreements are those of the level; 0: both volumes agree.
struct RefineFigures
{
  int steps = 0;
  double done = 0.0; ///< share of the most steps there may be, 0 to 1
  /// Share of the volume that has a partner in the reference, 0 to 1; by ultrasound, the share of
  /// what the sweep saw that is compared.
  double compared = 0.0;
  bool isBySweep = false; ///< By ultrasound.
  double disagreement = 0.0;
  double disagreementBefore = 0.0; ///< of the beginning
  double share = 1.0;              ///< smallest share of a step that the fold guard left, 0 to 1
  double largestChange = 0.0;      ///< of a control point since the beginning, mm
  double meanChange = 0.0;         ///< mm
  std::optional<double> smallestDeterminant; ///< Jacobian; known once the result was kept
};

/// Whether a source is a Compare Volumes.
bool isComparison(pqPipelineSource* source);

/// The Compare Volumes that show a deformation, the nearest first.
QList<pqPipelineSource*> comparisonsOf(pqPipelineSource* deformation);

class RefineRun
{
public:
  /// Reads both volumes and begins from how the volume is bent. Returns why it cannot: a sentence;
  /// empty if it can.
  QString begin(pqPipelineSource* deformation, const RefineSettings& settings);
  /// Takes one step, or a part of one. False if it failed or the server is gone.
  bool step();
  /// Lets go of the volumes. Figures stay.
  void end() { this->Proxy = nullptr; }

  /// The control points: 3 numbers each (mm, world axes), x fastest.
  const std::vector<double>& start() const { return this->Start; }
  const std::vector<double>& points() const { return this->Points; }
  RefineFigures& figures() { return this->Figures; }
  const RefineFigures& figures() const { return this->Figures; }
  /// The disagreement after each step, as a share of that of the beginning on the same level.
  const QList<double>& shares() const { return this->Shares; }

private:
  void measureChange();

  vtkSmartPointer<vtkSMProxy> Proxy;
  std::vector<double> Start;
  std::vector<double> Points;
  RefineFigures Figures;
  QList<double> Shares;
};
}

#endif
