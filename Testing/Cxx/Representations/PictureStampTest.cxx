// SPDX-License-Identifier: BSD-3-Clause
// Proves that a picture is cast anew when anything it depends on has changed, in part when tissue
// bends, and not at all otherwise; and what may show tissue whose bricks nothing asked for.
#include "Representations/Gpu/GpuTask.h"
#include "Representations/Picture/Picture.h"
#include "Representations/Scene/RayCastScene.h"
#include "Testing/Cxx/Representations/TestWindow.h"

#include <vtkActor.h>
#include <vtkPolyDataMapper.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkTextureObject.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <functional>
#include <utility>
#include <vector>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
class PictureStampTest : public ::testing::Test
{
protected:
  PictureStampTest()
  {
    this->Scene.tissue.scalars = this->textureOf(8);
    this->Scene.image.size = { 40, 30 };
    this->Scene.frame.lights.position = { 0.0f, 0.0f, 1.0f, 0.0f };
    this->Scene.frame.lights.color = { 1.0f, 1.0f, 1.0f };
    this->Scene.frame.lights.specular = { 1.0f, 1.0f, 1.0f };
    // The volume lies between the camera's clipping planes.
    this->Scene.frame.clipFromWorld =
      glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(-0.5)), glm::dvec3(0.9));
    this->Shown.renderer()->AddViewProp(this->Volume);
  }
  ~PictureStampTest() override
  {
    for (vtkTextureObject* texture : this->Textures)
    {
      texture->ReleaseGraphicsResources(this->Shown.window());
    }
  }

  PictureStamp::Change change()
  {
    return this->Stamp.change(
      { this->Shown.renderer(), this->Volume }, this->SettingsTime, this->Scene, this->Count);
  }

  // What one edit of the scene does to a picture that was up to date.
  PictureStamp::Change after(const std::function<void()>& edit)
  {
    this->change();
    EXPECT_EQ(this->change(), PictureStamp::Nothing);
    edit();
    return this->change();
  }

  // What one edit means for the bricks of a view that has all of them.
  ViewStamp::Change viewAfter(const std::function<void()>& edit)
  {
    const auto change = [this] {
      return this->View.change(
        { this->Shown.renderer(), this->Volume }, this->SettingsTime, this->Scene, this->Count);
    };
    change();
    EXPECT_EQ(change(), ViewStamp::Nothing);
    edit();
    return change();
  }

  vtkTextureObject* textureOf(int side)
  {
    auto texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(this->Shown.window());
    EXPECT_TRUE(texture->Allocate3D(side, side, side, 1, VTK_FLOAT));
    this->Textures.push_back(texture);
    return texture;
  }

  TestWindow Shown;
  std::vector<vtkSmartPointer<vtkTextureObject>> Textures;
  vtkNew<vtkVolume> Volume;
  RayCastScene Scene;
  Counters Count;
  unsigned long long SettingsTime = 1;
  PictureStamp Stamp;
  ViewStamp View;
};
}

TEST_F(PictureStampTest, TheFirstPictureIsNewAndTheSecondIsNot)
{
  EXPECT_EQ(this->change(), PictureStamp::Anything);
  EXPECT_EQ(this->change(), PictureStamp::Nothing);
  this->Stamp.forget();
  EXPECT_EQ(this->change(), PictureStamp::Anything);
}

TEST_F(PictureStampTest, AnythingThatIsSeenMakesAPictureNew)
{
  RayCastScene& scene = this->Scene;
  const std::vector<std::pair<const char*, std::function<void()>>> edits = {
    { "camera", [&] { scene.frame.clipFromWorld[0][0] *= 1.001; } },
    { "place", [&] { scene.frame.worldFromTexture[3][1] += 0.01; } },
    { "lattice", [&] { scene.field.latticeFromTexture.y *= 1.01; } },
    { "lattice's place", [&] { scene.field.latticeOfTextureZero.z += 0.01; } },
    { "width", [&] { scene.image.size.x += 1; } },
    { "height", [&] { scene.image.size.y += 1; } },
    { "step", [&] { scene.tissue.stepMm *= 1.1; } },
    { "skipping", [&] { scene.image.skips = !scene.image.skips; } },
    { "counting", [&] { scene.image.countSamples = true; } },
    { "tile", [&] { scene.frame.tile = true; } },
    { "headlight", [&] { scene.frame.lights.headlight = true; } },
    { "lamp's place", [&] { scene.frame.lights.position[0] = 0.1f; } },
    { "lamp's colour", [&] { scene.frame.lights.color[2] = 0.9f; } },
    { "lamp's glint", [&] { scene.frame.lights.specular[1] = 0.8f; } },
    { "clipping", [&] { scene.cuts.clipPlanes = { 1.0f, 0.0f, 0.0f, -0.2f }; } },
    { "isosurface", [&] { scene.blending.isovalues = { 0.5f }; } },
    { "plane", [&] { scene.blending.slicePlane.w = 0.1; } },
    { "volume", [&] { this->Count.volumeUploads += 1; } },
    { "colours", [&] { this->Count.transferUploads += 1; } },
    { "segment", [&] { this->Count.segmentUploads += 1; } },
    { "settings", [&] { this->SettingsTime += 1; } },
    { "property", [&] { this->Volume->GetProperty()->SetAmbient(0.7); } },
    { "scalars", [&] { scene.tissue.scalars = this->textureOf(4); } },
  };
  for (const auto& [what, edit] : edits)
  {
    EXPECT_EQ(this->after(edit), PictureStamp::Anything) << what;
  }
}

TEST_F(PictureStampTest, BendingKeepsWhatItDoesNotReach)
{
  EXPECT_EQ(this->after([&] { this->Count.latticeUploads += 1; }), PictureStamp::Bending);
  EXPECT_EQ(this->after([&] { this->Count.texelsRefined += 100; }), PictureStamp::Bending);
  EXPECT_EQ(this->after([&] { this->Count.presenceUpdates += 1; }), PictureStamp::Bending);
  EXPECT_EQ(this->after([&] {
    this->Count.texelsRefined += 100;
    this->Scene.cuts.spaceHigh.x += 0.1;
  }),
    PictureStamp::Reaching);
  EXPECT_EQ(this->after([&] { this->Scene.cuts.spaceLow.z -= 0.1; }), PictureStamp::Reaching);
  EXPECT_EQ(this->after([&] { this->Scene.field.texel.y *= 0.5; }), PictureStamp::Reaching);
  EXPECT_EQ(this->after([&] {
    this->Count.texelsRefined += 100;
    this->Scene.image.size.x += 1;
  }),
    PictureStamp::Anything)
    << "both";
}

TEST_F(PictureStampTest, TheCamerasClippingPlanesCountOnlyWhereTheyCut)
{
  const auto movePlanes = [&] { this->Scene.frame.clipFromWorld[2][2] *= 0.9; };
  EXPECT_EQ(this->after(movePlanes), PictureStamp::Nothing);
  this->Scene.frame.clipFromWorld[2][2] = 10.0;
  EXPECT_EQ(this->after(movePlanes), PictureStamp::Anything);
}

TEST_F(PictureStampTest, OtherPropsCountWhereTheyAreSomewhere)
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  EXPECT_EQ(
    this->after([&] { this->Shown.renderer()->AddViewProp(actor); }), PictureStamp::Anything);
  EXPECT_EQ(this->after([&] { actor->SetPosition(1.0, 0.0, 0.0); }), PictureStamp::Anything);
  EXPECT_EQ(this->after([&] { actor->VisibilityOff(); }), PictureStamp::Anything);
  EXPECT_EQ(this->after([&] { actor->SetPosition(2.0, 0.0, 0.0); }), PictureStamp::Nothing)
    << "hidden";
}

TEST_F(PictureStampTest, BricksThatArriveMakeAPictureNewAndTheViewStaysTheSame)
{
  this->Scene.bricks.pages = this->textureOf(2);
  const auto arrive = [&] {
    this->Scene.bricks.changes += 1;
    this->Count.presenceUpdates += 1; // their ranges are wider
  };
  EXPECT_EQ(this->after(arrive), PictureStamp::Anything);
  EXPECT_EQ(this->viewAfter(arrive), ViewStamp::Nothing);
}

TEST_F(PictureStampTest, WhatMayShowOtherTissueMakesAViewNew)
{
  RayCastScene& scene = this->Scene;
  const std::vector<std::pair<const char*, std::function<void()>>> edits = {
    { "camera", [&] { scene.frame.clipFromWorld[0][0] *= 1.001; } },
    { "width", [&] { scene.image.size.x += 1; } },
    { "step", [&] { scene.tissue.stepMm *= 1.1; } },
    { "clipping", [&] { scene.cuts.clipPlanes = { 1.0f, 0.0f, 0.0f, -0.2f }; } },
    { "resection", [&] { scene.resection.removed.fractions = this->textureOf(4); } },
    { "settings", [&] { this->SettingsTime += 1; } },
    { "property", [&] { this->Volume->GetProperty()->SetAmbient(0.7); } },
    { "stroke", [&] { this->Count.latticeUploads += 1; } },
  };
  for (const auto& [what, edit] : edits)
  {
    EXPECT_EQ(this->viewAfter(edit), ViewStamp::View) << what;
  }
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->Shown.renderer()->AddViewProp(actor);
  EXPECT_EQ(this->viewAfter([&] { actor->VisibilityOff(); }), ViewStamp::Others);
}
