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

bool PictureCapture::warns()
{
  return !std::exchange(this->Warned, true);
}
}
