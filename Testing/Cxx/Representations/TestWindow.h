// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An off-screen window with a current OpenGL context.
#ifndef BrainShift_TestWindow_h
#define BrainShift_TestWindow_h

#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <gtest/gtest.h>

#include <memory>

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

  vtkRenderer* renderer() { return this->Renderer; }
  vtkOpenGLRenderWindow* window() { return vtkOpenGLRenderWindow::SafeDownCast(this->Window); }

private:
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
};

// Keeps the display open while tests open and close windows of their own: Xvfb starts anew when its
// last client leaves, and refuses the next one meanwhile.
class OpenDisplay : public ::testing::Environment
{
public:
  void SetUp() override { this->Window = std::make_unique<TestWindow>(); }
  void TearDown() override { this->Window.reset(); }

private:
  std::unique_ptr<TestWindow> Window;
};

inline ::testing::Environment* const Display = ::testing::AddGlobalTestEnvironment(new OpenDisplay);
}

#endif
