// SPDX-License-Identifier: BSD-3-Clause
#include "SelectionCover.h"

#include "OpenGL.h"
#include "SceneGeometry.h"

#include "vtkDataObject.h"
#include "vtkHardwareSelector.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"

#include <glm/mat4x4.hpp>

namespace brainshift
{
bool selectsPoints(vtkRenderer* renderer)
{
  vtkHardwareSelector* selector = renderer->GetSelector();
  return selector && selector->GetFieldAssociation() == vtkDataObject::FIELD_ASSOCIATION_POINTS;
}

bool SelectionCover::draw(
  vtkOpenGLRenderWindow* window, vtkRenderer* renderer, vtkTextureObject* hits, Counters& counters)
{
  if (!this->CoverProgram.use(window, coverSource(), counters))
  {
    return false;
  }
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglScissor scissor(state);
  vtkOpenGLState::ScopedglDepthMask depthMask(state);
  vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable cull(state, GL_CULL_FACE);
  state->vtkglViewport(origin[0], origin[1], size[0], size[1]);
  state->vtkglScissor(origin[0], origin[1], size[0], size[1]);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_CULL_FACE);
  this->CoverProgram.set("hits", hits);
  this->CoverProgram.set("clipFromWorld", glm::mat4(clipFromWorld(renderer)));
  drawTriangles(1);
  hits->Deactivate();
  return true;
}
}
