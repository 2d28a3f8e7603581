// SPDX-License-Identifier: BSD-3-Clause
// What rays and slices look tissue up by.
#include "Representations/Picture/RayCaster.h"
#include "Representations/Tissue/TransferTexture.h"

#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <array>

namespace brainshift
{
void setTissueUniforms(Program& program, const RayCastScene& scene)
{
  program.set("scalars", scene.scalars);
  program.set("transfer", scene.transfer);
  program.set("transferRow",
    (static_cast<float>(scene.stepDoublings) + 0.5f) / static_cast<float>(TransferRows));
  program.set("transferFromScalar", glm::vec2(scene.transferFromScalar));
  program.set("visibleScalars", glm::vec2(scene.visibleScalars));
  program.set("volumeLow", glm::vec3(scene.volumeLow));
  program.set("volumeHigh", glm::vec3(scene.volumeHigh));
}

void setFieldUniforms(Program& program, const RayCastScene& scene)
{
  program.set("offsets", scene.offsets);
  program.set("fieldFromTexture", glm::vec3(scene.fieldFromTexture));
  program.set("fieldFromTextureShift", glm::vec3(scene.fieldFromTextureShift));
  std::array<glm::vec3, SlabDirections> normals;
  std::array<glm::vec2, SlabDirections> spans;
  for (int i = 0; i < SlabDirections; ++i)
  {
    const glm::dvec3 normal(slabDirection(i));
    normals[i] = glm::vec3(normal * scene.latticeFromTexture);
    const double shift = glm::dot(normal, scene.latticeOfTextureZero);
    spans[i] = scene.moved.empty() ? glm::vec2(1.0f, -1.0f)
                                   : glm::vec2(glm::dvec2(scene.moved.spans[i]) - shift);
  }
  program.set("moves", scene.moved.empty() ? 0 : 1);
  vtkShaderProgram* shader = program.get();
  shader->SetUniform3fv("movedNormals", SlabDirections, glm::value_ptr(normals[0]));
  shader->SetUniform2fv("movedSpans", SlabDirections, glm::value_ptr(spans[0]));
}
}
