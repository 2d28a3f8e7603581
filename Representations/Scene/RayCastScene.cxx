// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/RayCastScene.h"

#include "Representations/Gpu/Program.h"

#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>

namespace brainshift
{
void setTissueUniforms(Program& program, const SceneTissue& tissue, int stepDoublings)
{
  program.set("scalars", tissue.scalars);
  program.set("transfer", tissue.transfer);
  // With gradients, opacities of one step are put together after the gradient has changed them.
  const int row = tissue.steepness.opacity == Opacity::Scalar ? stepDoublings : 0;
  program.set("transferRow", (static_cast<float>(row) + 0.5f) / static_cast<float>(TransferRows));
  program.set("transferFromScalar", glm::vec2(tissue.transferFromScalar));
  program.set("visibleScalars", glm::vec2(tissue.visibleScalars));
  program.set("volumeLow", glm::vec3(tissue.volumeLow));
  program.set("volumeHigh", glm::vec3(tissue.volumeHigh));
}

glm::vec3 texelOf(vtkTextureObject* texture)
{
  return 1.0f / glm::vec3(texture->GetWidth(), texture->GetHeight(), texture->GetDepth());
}

void setBrickUniforms(Program& program, const SceneBricks& bricks)
{
  if (bricks.pages)
  {
    program.set("pages", bricks.pages);
    program.set("atlas", bricks.atlas);
    program.set("fineFromTexture", glm::vec3(bricks.voxelFromTexture));
    program.set("fineOfTextureZero", glm::vec3(bricks.voxelOfTextureZero));
    program.set("fineVoxels", glm::vec3(bricks.voxels));
    program.set("pagesTexel", texelOf(bricks.pages));
    program.set("atlasTexel", texelOf(bricks.atlas));
  }
}

namespace
{
// Without corrections their samplers are not read; they need some texture nevertheless.
void setCorrectionUniforms(Program& program, const SceneField& field)
{
  vtkTextureObject* offsets = field.offsets;
  const SceneCorrections& corrections = field.corrections;
  const bool corrected = corrections.codes && corrections.values;
  vtkTextureObject* values = corrected ? corrections.values : offsets;
  program.set("correctedAbove", corrected ? 0.0f : 1e30f);
  program.set("correctionCodes", corrected ? corrections.codes : offsets);
  program.set("corrections", values);
  program.set(
    "fieldNodes", glm::vec3(offsets->GetWidth(), offsets->GetHeight(), offsets->GetDepth()));
  program.set("correctionTexel", texelOf(values));
  program.set("textureFromLattice", glm::vec3(1.0 / field.latticeFromTexture));
}
}

void setFieldUniforms(Program& program, const SceneField& field)
{
  program.set("offsets", field.offsets);
  setCorrectionUniforms(program, field);
  program.set("fieldFromTexture", glm::vec3(field.fieldFromTexture));
  program.set("fieldFromTextureShift", glm::vec3(field.fieldOfTextureZero));
  std::array<glm::vec3, SlabDirections> normals;
  std::array<glm::vec2, SlabDirections> spans;
  for (int i = 0; i < SlabDirections; ++i)
  {
    const glm::dvec3 normal(slabDirection(i));
    normals[i] = glm::vec3(normal * field.latticeFromTexture);
    const double shift = glm::dot(normal, field.latticeOfTextureZero);
    spans[i] = field.moved.empty() ? glm::vec2(1.0f, -1.0f)
                                   : glm::vec2(glm::dvec2(field.moved.spans[i]) - shift);
  }
  program.set("moves", field.moved.empty() ? 0 : 1);
  vtkShaderProgram* shader = program.get();
  shader->SetUniform3fv("movedNormals", SlabDirections, glm::value_ptr(normals[0]));
  shader->SetUniform2fv("movedSpans", SlabDirections, glm::value_ptr(spans[0]));
}

void deactivateField(const SceneField& field)
{
  for (vtkTextureObject* texture :
    { field.offsets, field.corrections.codes, field.corrections.values })
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
}

void setResectionUniforms(Program& program, const SceneResection& resection)
{
  if (vtkTextureObject* removed = resection.removed.fractions)
  {
    program.set("removed", removed);
    program.set("removedFromTexture", glm::mat4(resection.removed.ownFromTexture));
    program.set("removedTexel", texelOf(removed));
  }
  if (resection.tumour.fractions)
  {
    program.set("tumour", resection.tumour.fractions);
    program.set("tumourFromTexture", glm::mat4(resection.tumour.ownFromTexture));
    program.set("leftTint", LeftTumourTint);
    program.set("removedTint", RemovedTumourTint);
  }
}

void setEvidenceUniforms(Program& program, const SceneEvidence& evidence)
{
  if (evidence.deviations)
  {
    program.set("deviations", evidence.deviations);
    program.set("deviationFromTexture", glm::vec3(evidence.deviationFromTexture));
    program.set("deviationFromTextureShift", glm::vec3(evidence.deviationOfTextureZero));
    program.set("evidenceLimits", EvidenceLimits);
    program.set("evidenceTints", EvidenceTints);
    program.set("stripesFromTexture", glm::vec3(evidence.stripesFromTexture));
    program.set("stripesOfTextureZero", static_cast<float>(evidence.stripesOfTextureZero));
  }
}

void setPartPlanes(Program& program, const std::vector<float>& planes)
{
  constexpr int sidesOfBox = 6;
  std::array<float, 4 * sidesOfBox> part{};
  std::copy(planes.begin(), planes.end(), part.begin());
  program.set("partCount", static_cast<int>(planes.size() / 4));
  program.get()->SetUniform4fv("partPlanes", sidesOfBox, part.data());
}

void setColoringUniforms(Program& program, const SceneColoring& coloring)
{
  if (coloring.source == Coloring::Direct)
  {
    program.set("colors", coloring.colors);
  }
  if (coloring.source == Coloring::OtherScalar)
  {
    program.set("colorScalars", coloring.scalars);
    program.set("transferFromColorScalar", glm::vec2(coloring.transferFromScalar));
  }
}

}
