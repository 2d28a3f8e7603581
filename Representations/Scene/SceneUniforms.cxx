// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/SceneUniforms.h"

#include "Representations/Gpu/Program.h"

#include "vtkShaderProgram.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <array>

namespace brainshift
{
void setTissueUniforms(Program& program, const SceneTissue& tissue, int stepDoublings)
{
  program.set("scalars", tissue.scalars);
  program.set("transfer", tissue.transfer);
  program.set(
    "transferRow", (static_cast<float>(stepDoublings) + 0.5f) / static_cast<float>(TransferRows));
  program.set("transferFromScalar", glm::vec2(tissue.transferFromScalar));
  program.set("visibleScalars", glm::vec2(tissue.visibleScalars));
  program.set("volumeLow", glm::vec3(tissue.volumeLow));
  program.set("volumeHigh", glm::vec3(tissue.volumeHigh));
}

void setFieldUniforms(Program& program, const SceneField& field)
{
  program.set("offsets", field.offsets);
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
