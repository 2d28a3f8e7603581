// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bricks of a finer level for the slices of one window. Which ones a picture needs is found by
/// drawing the slices into an image of their numbers.
#ifndef BrainShift_SliceBricks_h
#define BrainShift_SliceBricks_h

#include "Representations/Bricks/StreamedBricks.h"
#include "Representations/Slices/SliceDrawer.h"

#include <array>
#include <optional>

namespace brainshift
{
/// What is drawn, and its textures.
struct SliceTissue
{
  const TissueRequest& request;
  TissueTextures& textures;
};

class SliceBricks
{
public:
  using Clock = StreamedBricks::Clock;

  /// Fills the bricks of a scene that is complete without them, and asks for those that it lacks.
  /// `view`: as brickViewOf gives it, with the picture's pixels. `end`: waits until then for all
  /// that the picture shows; none: does not wait.
  void update(GpuTask& gpu, BrickView view, const SliceTissue& tissue, SliceScene& scene,
    const std::optional<Clock::time_point>& end);

  /// Nothing more is wanted until the next update.
  void rest() { this->Bricks.rest(); }

  /// What the images that ask for bricks take, in a picture of so many pixels.
  static std::int64_t bytesOf(const glm::ivec2& pixels);

  const StreamedBricks& bricks() const { return this->Bricks; }

  /// Those that are asked with; null: not in use.
  std::vector<vtkTextureObject*> images() const { return { this->Numbers, this->Depth }; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  std::vector<glm::vec2> ask(GpuTask& gpu, const SliceScene& scene, const glm::ivec2& pixels);
  bool isChanged(const GpuTask& gpu, const SliceScene& scene, const glm::ivec2& pixels);
  bool prepare(vtkOpenGLRenderWindow* window, const glm::ivec2& pixels);
  std::vector<glm::vec2> drawNumbers(
    vtkOpenGLRenderWindow* window, const SliceScene& scene, const glm::ivec2& pixels);

  StreamedBricks Bricks;
  std::array<std::vector<double>, 2> Asked; // what each eye saw when it was asked last
  std::array<Program, 2> Programs;          // for a volume at rest, and for a bent one
  vtkSmartPointer<vtkTextureObject> Numbers;
  vtkSmartPointer<vtkTextureObject> Depth;
};
}

#endif
