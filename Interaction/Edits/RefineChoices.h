// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a refinement compares with, and by which similarity.
#ifndef BrainShift_RefineChoices_h
#define BrainShift_RefineChoices_h

#include <vtkSMProxy.h>
#include <vtkSmartPointer.h>

#include <QList>
#include <QString>

class pqPipelineSource;

namespace brainshift
{
/// What a refinement compares with, and how.
struct RefineSettings
{
  pqPipelineSource* reference = nullptr; ///< a Compare Volumes of the deformation, or a volume
  pqPipelineSource* cavity = nullptr;    ///< null: none, or that of the Compare Volumes
  int similarity = 0;                    ///< its place in similaritiesFor
  double stiffness = 1.0;                ///< factor on what bending costs; above 0
};

/// A similarity as the server lists it.
struct SimilarityChoice
{
  QString label;
  QString tooltip; ///< when to choose it, and what it compares
};

/// The similarities that a refinement of a source may use.
QList<SimilarityChoice> similaritiesFor(pqPipelineSource* source);

/// Whether a source is a Compare Volumes.
bool isComparison(pqPipelineSource* source);

/// The Compare Volumes that show a deformation, the nearest first.
QList<pqPipelineSource*> comparisonsOf(pqPipelineSource* deformation);

/// Why a refinement cannot begin, as far as the client knows: a sentence; empty if it can.
QString whyNot(pqPipelineSource* deformation, const RefineSettings& settings);

/// The Compare Volumes of the settings; if they have a volume instead, one that is not registered
/// and lives as long as the pointer.
vtkSmartPointer<vtkSMProxy> comparisonFor(
  pqPipelineSource* deformation, const RefineSettings& settings);
}

#endif
