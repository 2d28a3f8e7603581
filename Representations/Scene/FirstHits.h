// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the rays of a picture met a surface first.
#ifndef BrainShift_FirstHits_h
#define BrainShift_FirstHits_h

#include "Representations/Scene/Frustum.h"
#include "Representations/Scene/ImageArea.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"

namespace brainshift
{
/// One number for each pixel. The position follows from it and from the camera of the picture,
/// which may have moved on since.
struct FirstHits
{
  /// Fraction of the way from the near to the far plane. Below 0, and beyond the area: no hit.
  vtkSmartPointer<vtkTextureObject> texture;
  ImageArea area;  ///< Of the picture.
  Frustum frustum; ///< Of the picture, mm, world.
};
}

#endif
