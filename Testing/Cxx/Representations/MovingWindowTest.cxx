// SPDX-License-Identifier: BSD-3-Clause
// Proves what a window leaves out while it moves, that it is put back after every picture, and that
// nothing is left out where it would be missed.
#include "Representations/Window/MovingWindow.h"
#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Gpu/OpenGL.h"
#include "Testing/Cxx/Representations/TestWindow.h"

#include <vtkOpenGLFramebufferObject.h>
#include <vtkTextureObject.h>

#include <gtest/gtest.h>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double Moving = 15.0; // pictures a second
constexpr double Still = 0.001;

// A window with an inset, as ParaView's orientation axes are, and what it held when the last of
// its renderers had drawn and nothing was copied yet.
class MovingWindowTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Inset->UseFXAAOn();
    this->Inset->SetViewport(0.0, 0.0, 0.2, 0.2);
    this->window()->AddRenderer(this->Inset);
    this->window()->SetFrameBlitModeToNoBlit(); // as Qt's widget for VTK does
    this->Inset->AddObserver(vtkCommand::EndEvent, this, &MovingWindowTest::look);
    this->Leaving.watch(this->Test.renderer());
  }

  vtkOpenGLRenderWindow* window() { return this->Test.window(); }
  vtkTextureObject* depths()
  {
    return this->window()->GetDisplayFramebuffer()->GetDepthAttachmentAsTextureObject();
  }
  void look()
  {
    this->Smoothed = this->Inset->GetUseFXAA();
    this->Copied = this->depths() != nullptr;
  }

  void draw(double rate)
  {
    vtkTextureObject* before = this->depths();
    this->window()->SetDesiredUpdateRate(rate);
    this->window()->Render();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_TRUE(this->Inset->GetUseFXAA()) << "not put back";
    EXPECT_EQ(this->depths(), before) << "not put back";
  }

  TestWindow Test;
  vtkNew<vtkRenderer> Inset;
  MovingWindow Leaving;
  bool Smoothed = false;
  bool Copied = false;
};
}

TEST_F(MovingWindowTest, LeavesOutWhatASoftwareDriverNeedNotDo)
{
  this->draw(Moving);
  EXPECT_EQ(this->Smoothed, !drawsInSoftware());
  EXPECT_EQ(this->Copied, !drawsInSoftware());
}

TEST_F(MovingWindowTest, LeavesOutNothingOfAStillPicture)
{
  this->draw(Moving);
  this->draw(Still);
  EXPECT_TRUE(this->Smoothed);
  EXPECT_TRUE(this->Copied);
}

TEST_F(MovingWindowTest, CopiesDepthsWhereTheWindowMayReadThem)
{
  this->window()->SetFrameBlitModeToBlitToHardware();
  this->draw(Moving);
  EXPECT_TRUE(this->Copied);
}

TEST_F(MovingWindowTest, LeavesOutNothingForAHiddenVolumeOrNoRenderer)
{
  this->Leaving.setEnabled(false);
  this->draw(Moving);
  EXPECT_TRUE(this->Smoothed && this->Copied);
  this->Leaving.setEnabled(true);
  this->Leaving.watch(nullptr);
  this->draw(Moving);
  EXPECT_TRUE(this->Smoothed && this->Copied);
}

TEST_F(MovingWindowTest, SeveralVolumesLeaveOutTheSameOnce)
{
  MovingWindow other;
  other.watch(this->Test.renderer());
  this->draw(Moving);
  this->draw(Still);
  EXPECT_TRUE(this->Smoothed && this->Copied);
}
