// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The OpenGL state for drawing into the window, among VTK's own props.
#ifndef BrainShift_SceneScope_h
#define BrainShift_SceneScope_h

#include "Representations/Gpu/OpenGL.h"

#include "vtkOpenGLState.h"

namespace brainshift
{
/// Draws what is as near as, or nearer than, what is there, and its depth too. The end of the scope
/// restores the state.
class SceneScope
{
public:
  /// `blended`: colours, already times their opacity, are blended over what is there.
  SceneScope(vtkOpenGLState* state, bool blended)
    : Viewport(state)
    , ScissorBox(state)
    , ColorMask(state)
    , DepthMask(state)
    , DepthFunction(state)
    , BlendFunction(state)
    , DepthTest(state, GL_DEPTH_TEST)
    , Blend(state, GL_BLEND)
    , Cull(state, GL_CULL_FACE)
  {
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthFunc(GL_LEQUAL);
    state->vtkglDepthMask(GL_TRUE);
    state->vtkglDisable(GL_CULL_FACE);
    state->SetEnumState(GL_BLEND, blended);
    state->vtkglBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  }

private:
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglScissor ScissorBox;
  vtkOpenGLState::ScopedglColorMask ColorMask;
  vtkOpenGLState::ScopedglDepthMask DepthMask;
  vtkOpenGLState::ScopedglDepthFunc DepthFunction;
  vtkOpenGLState::ScopedglBlendFuncSeparate BlendFunction;
  vtkOpenGLState::ScopedglEnableDisable DepthTest;
  vtkOpenGLState::ScopedglEnableDisable Blend;
  vtkOpenGLState::ScopedglEnableDisable Cull;
};
}

#endif
