// SPDX-License-Identifier: BSD-3-Clause
// Proves that one vtkDeformedVolumeMapper draws in several windows, each an OpenGL context of its
// own, what it draws in a single one, and uploads to each of them once.
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Deformation/Stroke.h"
#include "Representations/Gpu/GpuTask.h"
#include "Testing/Cxx/Representations/TestWindow.h"
#include "vtkDeformedVolumeMapper.h"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using namespace brainshift;

namespace
{
constexpr int Side = 21; // voxels
constexpr double Middle = (Side - 1) / 2.0;

// A bent ball; `amount`: of the bend, mm.
class Ball
{
public:
  Ball(double amount)
  {
    this->Image->SetDimensions(Side, Side, Side);
    vtkNew<vtkFloatArray> values;
    values->SetNumberOfTuples(Side * Side * Side);
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      const glm::dvec3 voxel(i % Side, i / Side % Side, i / Side / Side);
      values->SetValue(
        i, static_cast<float>(100.0 - 10.0 * glm::distance(voxel, { Middle, Middle, Middle })));
    }
    values->SetName("Intensity");
    this->Image->GetPointData()->SetScalars(values);
    this->bend(amount);
    this->Mapper->SetInputData(this->Image);
    this->Mapper->SelectScalarArray("Intensity");
    this->Mapper->SetScalarModeToUsePointFieldData();
    this->Mapper->SetAdaptiveQuality(false);
    this->Volume->SetMapper(this->Mapper);
    vtkNew<vtkColorTransferFunction> color;
    color->AddRGBPoint(0.0, 0.0, 0.0, 1.0);
    color->AddRGBPoint(100.0, 1.0, 1.0, 0.0);
    vtkNew<vtkPiecewiseFunction> opacity;
    opacity->AddPoint(20.0, 0.0);
    opacity->AddPoint(100.0, 0.3);
    this->Volume->GetProperty()->SetColor(color);
    this->Volume->GetProperty()->SetScalarOpacity(opacity);
    this->Volume->GetProperty()->ShadeOn();
  }

  void bend(double amount)
  {
    Grid grid;
    grid.dimensions = glm::ivec3(9);
    grid.spacing = glm::dvec3((Side - 1) / 8.0);
    Deformation deformation;
    deformation.lattice = makeLattice(grid, 0);
    deformation.lattice.displacements[grid.offset(4, 4, 5)] = glm::vec3(amount, 0.0, 0.0);
    attach(this->Image, deformation);
    this->Image->Modified();
  }

  const Counters& count() { return this->Mapper->GetCounters(); }
  vtkVolume* volume() { return this->Volume; }

private:
  vtkNew<vtkImageData> Image;
  vtkNew<vtkDeformedVolumeMapper> Mapper;
  vtkNew<vtkVolume> Volume;
};

using Picture = std::vector<unsigned char>;

// A window of its own size that sees the volume from a direction.
class Window
{
public:
  Window(vtkVolume* volume, const glm::dvec3& direction, int size)
    : Size(size)
  {
    this->Renderer->AddVolume(volume);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    const glm::dvec3 eye = glm::dvec3(Middle) - 60.0 * glm::normalize(direction);
    camera->SetPosition(eye.x, eye.y, eye.z);
    camera->SetFocalPoint(Middle, Middle, Middle);
    this->RenderWindow->SetOffScreenRendering(1);
    this->RenderWindow->SetMultiSamples(0);
    this->RenderWindow->SetSize(size, size);
    this->RenderWindow->AddRenderer(this->Renderer);
  }

  Picture draw()
  {
    this->Renderer->ResetCameraClippingRange();
    this->RenderWindow->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->RenderWindow->GetPixelData(0, 0, this->Size - 1, this->Size - 1, 0, pixels);
    return Picture(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
  }

  void remove(vtkVolume* volume) { this->Renderer->RemoveVolume(volume); }
  void add(vtkVolume* volume) { this->Renderer->AddVolume(volume); }
  void removeRenderer() { this->RenderWindow->RemoveRenderer(this->Renderer); }

private:
  int Size;
  vtkNew<vtkRenderWindow> RenderWindow;
  vtkNew<vtkRenderer> Renderer;
};

const glm::dvec3 Directions[2] = { { 0.1, 0.2, -1.0 }, { 1.0, -0.3, 0.2 } };
constexpr int Sizes[2] = { 90, 70 };

// What a window shows of a ball that no other window shows.
Picture alone(double amount, int window)
{
  Ball ball(amount);
  return Window(ball.volume(), Directions[window], Sizes[window]).draw();
}

bool showsSomething(const Picture& picture)
{
  return std::count_if(picture.begin(), picture.end(), [](unsigned char v) { return v > 20; }) >
    500;
}
}

TEST(Windows, ShowOneVolumeInTurn)
{
  const Picture expected[2] = { alone(2.0, 0), alone(2.0, 1) };
  ASSERT_TRUE(showsSomething(expected[0]) && showsSomething(expected[1]));
  Ball ball(2.0);
  Window first(ball.volume(), Directions[0], Sizes[0]);
  Window second(ball.volume(), Directions[1], Sizes[1]);
  for (int turn = 0; turn < 3; ++turn)
  {
    EXPECT_TRUE(first.draw() == expected[0]) << "turn " << turn;
    EXPECT_TRUE(second.draw() == expected[1]) << "turn " << turn;
    EXPECT_EQ(ball.count().volumeUploads, 2);
    EXPECT_EQ(ball.count().latticeUploads, 2);
    EXPECT_EQ(ball.count().transferUploads, 2);
  }
}

TEST(Windows, AllFollowAStroke)
{
  const Picture before[2] = { alone(2.0, 0), alone(2.0, 1) };
  const Picture after[2] = { alone(-3.0, 0), alone(-3.0, 1) };
  ASSERT_TRUE(before[0] != after[0] && before[1] != after[1]);
  Ball ball(2.0);
  Window first(ball.volume(), Directions[0], Sizes[0]);
  Window second(ball.volume(), Directions[1], Sizes[1]);
  first.draw();
  second.draw();
  ball.bend(-3.0);
  EXPECT_TRUE(first.draw() == after[0]);
  EXPECT_TRUE(second.draw() == after[1]);
  ball.bend(2.0);
  EXPECT_TRUE(second.draw() == before[1]);
  ball.bend(-3.0);
  EXPECT_TRUE(first.draw() == after[0]) << "two strokes later";
  EXPECT_EQ(ball.count().volumeUploads, 2);
}

TEST(Windows, CloseAndOpen)
{
  const Picture expected[2] = { alone(2.0, 0), alone(2.0, 1) };
  Ball ball(2.0);
  Window kept(ball.volume(), Directions[0], Sizes[0]);
  EXPECT_TRUE(kept.draw() == expected[0]);
  for (int turn = 0; turn < 3; ++turn) // a new window may have the address of the last one
  {
    Window passing(ball.volume(), Directions[1], Sizes[1]);
    EXPECT_TRUE(passing.draw() == expected[1]) << "turn " << turn;
    EXPECT_TRUE(kept.draw() == expected[0]) << "turn " << turn;
  }
  EXPECT_TRUE(kept.draw() == expected[0]);
  EXPECT_EQ(ball.count().volumeUploads, 4); // once for each window
}

TEST(Windows, TakeAVolumeOutAndInAgain)
{
  const Picture expected = alone(2.0, 0);
  Ball ball(2.0);
  Window window(ball.volume(), Directions[0], Sizes[0]);
  EXPECT_TRUE(window.draw() == expected);
  window.remove(ball.volume());
  EXPECT_FALSE(showsSomething(window.draw()));
  window.add(ball.volume());
  EXPECT_TRUE(window.draw() == expected);
}

TEST(Windows, LetGoOfTheirOwnOnly)
{
  // As ParaView closes a view: while another window's context, with the same numbers for its
  // buffers, is the current one.
  const Picture expected = alone(2.0, 1);
  Ball ball(2.0);
  Window first(ball.volume(), Directions[0], Sizes[0]);
  Window second(ball.volume(), Directions[1], Sizes[1]);
  first.draw();
  EXPECT_TRUE(second.draw() == expected);
  first.removeRenderer();
  EXPECT_TRUE(second.draw() == expected);
  EXPECT_EQ(ball.count().volumeUploads, 2);
}
