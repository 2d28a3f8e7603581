// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The choices of a refinement: reference, cavity and similarity.
#ifndef BrainShift_RefineChoices_h
#define BrainShift_RefineChoices_h

#include <vtkSMProxy.h>
#include <vtkSmartPointer.h>

#include <QList>
#include <QString>

class pqPipelineSource;

namespace brainshift
{
/// The settings of a refinement.
struct RefineSettings
{
  pqPipelineSource* reference = nullptr; ///< a Compare Volumes of the deformation, or a volume
  pqPipelineSource* cavity = nullptr;    ///< null: none, or that of the Compare Volumes
  int similarity = 0;                    ///< its index in similaritiesFor
  double stiffness = 1.0;                ///< factor on the stiffness; above 0
};

/// A similarity as the server lists it.
struct SimilarityChoice
{
  QString label;
  QString tooltip; ///< use and method
};

/// The similarities that a refinement of a source may use.
QList<SimilarityChoice> similaritiesFor(pqPipelineSource* source);

/// Whether a source is a Compare Volumes.
bool isComparison(pqPipelineSource* source);

/// The Compare Volumes that show a deformation, the nearest first.
QList<pqPipelineSource*> comparisonsOf(pqPipelineSource* deformation);

/// The reason against a refinement that the client knows: a sentence; empty if there is none.
QString whyNot(pqPipelineSource* deformation, const RefineSettings& settings);

/// The Compare Volumes of the settings; if they have a volume instead, one that is not registered
/// and lives as long as the pointer.
vtkSmartPointer<vtkSMProxy> comparisonFor(
  pqPipelineSource* deformation, const RefineSettings& settings);
}

#endif
