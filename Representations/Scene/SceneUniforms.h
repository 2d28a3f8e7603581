// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Sets the uniforms of those groups of a scene that rays and slices share.
 */
#ifndef BrainShift_SceneUniforms_h
#define BrainShift_SceneUniforms_h

#include "Representations/Scene/RayCastScene.h"

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

namespace brainshift
{
class Program;

/// What Shaders/Tissue/tissue.glsl needs. `stepDoublings`: how often the step was doubled, which
/// chooses the row of opacities.
void setTissueUniforms(Program& program, const SceneTissue& tissue, int stepDoublings);

/// What Shaders/Field/field.glsl needs of a volume with a deformation.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT void setFieldUniforms(
  Program& program, const SceneField& field);

/// Ends the use of the field's textures.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT void deactivateField(const SceneField& field);

/// What Shaders/Tissue/evidence.glsl needs. Nothing if evidence is not shown.
void setEvidenceUniforms(Program& program, const SceneEvidence& evidence);

/// What Shaders/Tissue/components.glsl needs.
void setColoringUniforms(Program& program, const SceneColoring& coloring);
}

#endif
