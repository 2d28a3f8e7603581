// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/PictureCapture.h"

#include "vtkOpenGLRenderWindow.h"

#include <utility>

namespace brainshift
{
PictureCapture& PictureCapture::current()
{
  static PictureCapture capture;
  return capture;
}

void PictureCapture::join(vtkOpenGLRenderWindow* window, const void* device, bool isLeftEye)
{
  const double* tile = window->GetTileViewport();
  const Part part(device, isLeftEye, tile[0], tile[1]);
  if (this->Window != window || this->Drawn.count(part) > 0)
  {
    this->end();
    this->Window = window;
    this->Deadline = StreamedBricks::Clock::now() + LongestWait;
  }
  this->Drawn.insert(part);
}

void PictureCapture::end()
{
  this->Window = nullptr;
  this->Drawn.clear();
  this->Warned = false;
}

void PictureCapture::reportIfCoarse(GpuTask& gpu, const StreamedBricks& bricks)
{
  gpu.remarks.push_back(bricks.problem()); // which may have come up while it waited
  const std::int64_t wanted = bricks.wantedByEye();
  const int lost = bricks.lost();
  const bool isWhole = wanted <= 0 && lost == 0 && !bricks.lacksRoom();
  if (isWhole || std::exchange(this->Warned, true))
  {
    return;
  }
  gpu.warnings.push_back("A picture that was saved is coarser in places: " +
    (wanted > 0 ? std::to_string(wanted) + " bricks of finer voxels or more were still to come " +
          "after " + std::to_string(LongestWait.count()) + " s. Save it once more to wait for them"
        : lost > 0
        ? std::to_string(lost) +
          " bricks of finer voxels cannot be read, as a message tells. Mend " +
          "the file and save the picture once more, some 30 s later"
        : "there is no memory for more bricks of finer voxels. Set a greater Memory Limit"));
}
}
