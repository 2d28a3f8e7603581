// SPDX-License-Identifier: BSD-3-Clause
// An off-screen window with a current OpenGL context.
#ifndef BrainShift_TestWindow_h
#define BrainShift_TestWindow_h

#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace brainshift::testing
{
class TestWindow
{
public:
  TestWindow()
  {
    this->Window->SetOffScreenRendering(1);
    this->Window->SetSize(64, 64);
    this->Window->AddRenderer(this->Renderer);
    this->Window->Render();
    this->window()->MakeCurrent();
  }

  vtkOpenGLRenderWindow* window() { return vtkOpenGLRenderWindow::SafeDownCast(this->Window); }

private:
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
};
}

#endif
