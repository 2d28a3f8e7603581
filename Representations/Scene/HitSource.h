// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Source of the positions at which the rays of a picture first met a surface.
///
/// VTK's wrapping tools parse the classes that inherit this one and everything that their headers
/// include. They need minutes for the headers of GLM, so this header includes nothing.
#ifndef BrainShift_HitSource_h
#define BrainShift_HitSource_h

class vtkWindow;

namespace brainshift
{
struct FirstHits;

/// Something that draws tissue and keeps the first hits of its pictures: the mapper of a deformed
/// volume. Traced points read from it which tissue hides them.
class HitSource
{
public:
  HitSource(const HitSource&) = delete;
  void operator=(const HitSource&) = delete;

  /// First hits of the last picture in a window, whole or a tile. Null if there is none.
  virtual const FirstHits* GetHits(vtkWindow* window) = 0;

protected:
  HitSource() = default;
  virtual ~HitSource() = default;
};
}

#endif
