// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/SelectionCover.h"

#include "Representations/Gpu/SceneScope.h"
#include "Representations/Scene/Frustum.h"
#include "Representations/Scene/SceneGeometry.h"

#include "vtkDataObject.h"
#include "vtkHardwareSelector.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"

namespace brainshift
{
bool selectsPoints(vtkRenderer* renderer)
{
  vtkHardwareSelector* selector = renderer->GetSelector();
  return selector && selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_POINTS;
}

bool SelectionCover::draw(
  vtkOpenGLRenderWindow* window, vtkRenderer* renderer, const FirstHits& hits, Counters& counters)
{
  if (!this->CoverProgram.use(window, coverSource(), counters))
  {
    return false;
  }
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  vtkOpenGLState* state = window->GetState();
  constexpr bool blended = false;
  const SceneScope scope(state, blended);
  state->vtkglViewport(origin[0], origin[1], size[0], size[1]);
  state->vtkglScissor(origin[0], origin[1], size[0], size[1]);
  this->CoverProgram.set("hits", hits.texture.Get());
  this->CoverProgram.set("hitsFromFraction", glm::vec2(hits.area.textureFromFraction()));
  this->CoverProgram.set("hitsOfFractionZero", glm::vec2(hits.area.textureOfFractionZero()));
  this->CoverProgram.set("nearPlane", glm::mat3(hits.frustum.near.columns()));
  this->CoverProgram.set("farPlane", glm::mat3(hits.frustum.far.columns()));
  this->CoverProgram.set("clipFromWorld", glm::mat4(clipFromWorld(renderer)));
  drawTriangles(1);
  hits.texture->Deactivate();
  return true;
}
}
