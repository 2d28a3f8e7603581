// SPDX-License-Identifier: BSD-3-Clause
// Where the rays of a picture met a surface first. One number a pixel: the rest follows from the
// camera that the picture was cast with, which may have moved on since.
#ifndef BrainShift_FirstHits_h
#define BrainShift_FirstHits_h

#include "Representations/Scene/Frustum.h"
#include "Representations/Scene/ImageArea.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

namespace brainshift
{
struct FirstHits
{
  // Share of the way from the near to the far plane; below 0: none, as beyond its area.
  vtkSmartPointer<vtkTextureObject> texture;
  ImageArea area;  // of the picture
  Frustum frustum; // of the picture, mm (world)
};
}

#endif
