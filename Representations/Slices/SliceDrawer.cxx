// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/SliceDrawer.h"

#include "Common/ScreenScale.h"
#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/SceneScope.h"
#include "Representations/Scene/SceneUniforms.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

#include <glm/mat4x4.hpp>

#include <vector>

namespace brainshift
{
namespace
{
glm::dmat4 clipFromTexture(const SceneFrame& frame)
{
  return frame.clipFromWorld * frame.worldFromTexture;
}

void setSliceUniforms(Program& program, const SliceScene& scene, double scale)
{
  constexpr int noDoublings = 0;
  setTissueUniforms(program, scene.tissue, noDoublings);
  if (scene.field.offsets)
  {
    setFieldUniforms(program, scene.field);
  }
  setColoringUniforms(program, scene.tissue.coloring);
  setEvidenceUniforms(program, scene.evidence);
  program.set("clipFromTexture", glm::mat4(clipFromTexture(scene.frame)));
  program.set("voxels", glm::vec3(scene.voxels));
  program.set("cubic", scene.cubic ? 1 : 0);
  program.set("opacity", static_cast<float>(scene.opacity));
  program.set("mapsOpacity", scene.mapsOpacity ? 1 : 0);
  program.set("selecting", scene.selecting ? 1 : 0);
  program.set("crosshair", scene.crosshair && !scene.selecting ? 1 : 0);
  program.set("crossing", glm::vec3(scene.planes.position));
  program.set("crosshairColors", scene.crosshairColors);
  program.set("screenScale", static_cast<float>(scale));
}
}

bool SliceDrawer::draw(vtkOpenGLRenderWindow* window, const SliceScene& scene, Counters& counters)
{
  const SceneTissue& tissue = scene.tissue;
  const SlicesVariant variant{ scene.field.offsets != nullptr, tissue.coloring.source,
    scene.reference.place.scalars != nullptr, scene.reference.cavity.voxels != nullptr,
    scene.evidence.deviations != nullptr };
  Program& program = this->Programs[variant];
  if (!program.use(window, slicesSource(variant), counters))
  {
    return false;
  }
  setSliceUniforms(program, scene, screenScale(window));
  if (variant.compared)
  {
    setReferenceUniforms(program, scene.reference);
  }
  {
    vtkOpenGLState* state = window->GetState();
    const SceneScope scope(state, scene.blended);
    state->vtkglDepthMask(scene.blended ? GL_FALSE : GL_TRUE);
    const std::vector<SliceQuad> quads = scene.blended
      ? quadsBackToFront(scene.planes, clipFromTexture(scene.frame))
      : wholeQuads(scene.planes);
    for (const SliceQuad& quad : quads)
    {
      program.set("quadAxis", quad.axis);
      program.set("quadCorner", glm::vec3(quad.corner));
      program.set("quadRight", glm::vec3(quad.right));
      program.set("quadUp", glm::vec3(quad.up));
      if (variant.compared)
      {
        setWipeUniforms(program, scene.reference, quad.axis);
      }
      constexpr int trianglesOfQuad = 2;
      drawTriangles(trianglesOfQuad);
    }
  }
  for (vtkTextureObject* texture :
    { tissue.scalars, tissue.transfer, tissue.coloring.colors, tissue.coloring.scalars,
      scene.reference.place.scalars, scene.reference.cavity.voxels, scene.evidence.deviations })
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
  deactivateField(scene.field);
  counters.frames += 1;
  return true;
}
}
