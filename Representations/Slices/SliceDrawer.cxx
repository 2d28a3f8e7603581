// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/SliceDrawer.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/SceneScope.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

#include <glm/mat4x4.hpp>

#include <vector>

namespace brainshift
{
namespace
{
void setSliceUniforms(Program& program, const SliceScene& scene)
{
  const RayCastScene& volume = scene.volume;
  setTissueUniforms(program, volume);
  if (volume.offsets)
  {
    setFieldUniforms(program, volume);
  }
  setColoringUniforms(program, volume.options);
  program.set("clipFromTexture", glm::mat4(volume.clipFromWorld * volume.worldFromTexture));
  program.set("voxels", glm::vec3(scene.voxels));
  program.set("cubic", scene.cubic ? 1 : 0);
  program.set("opacity", static_cast<float>(scene.opacity));
  program.set("mapsOpacity", scene.mapsOpacity ? 1 : 0);
  program.set("selecting", scene.selecting ? 1 : 0);
}
}

bool SliceDrawer::draw(vtkOpenGLRenderWindow* window, const SliceScene& scene, Counters& counters)
{
  const RayCastScene& volume = scene.volume;
  const SlicesVariant variant{ volume.offsets != nullptr, volume.options.coloring,
    scene.reference.place.scalars != nullptr, scene.reference.cavity.voxels != nullptr };
  Program& program = this->Programs[variant];
  if (!program.use(window, slicesSource(variant), counters))
  {
    return false;
  }
  setSliceUniforms(program, scene);
  if (variant.compared)
  {
    setReferenceUniforms(program, scene.reference);
  }
  {
    vtkOpenGLState* state = window->GetState();
    const SceneScope scope(state, scene.blended);
    state->vtkglDepthMask(scene.blended ? GL_FALSE : GL_TRUE);
    const std::vector<SliceQuad> quads = scene.blended
      ? quadsBackToFront(scene.planes, volume.clipFromWorld * volume.worldFromTexture)
      : wholeQuads(scene.planes);
    for (const SliceQuad& quad : quads)
    {
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
    { volume.scalars, volume.offsets, volume.transfer, volume.options.colors,
      volume.options.colorScalars, scene.reference.place.scalars, scene.reference.cavity.voxels })
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
  counters.frames += 1;
  return true;
}
}
