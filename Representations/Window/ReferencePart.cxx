// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/ReferencePart.h"

#include "Common/PiecedArray.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Window/RankParts.h"

namespace brainshift
{
namespace
{
glm::ivec3 sidesOf(const Extent& extent)
{
  return { extent[1] - extent[0] + 1, extent[3] - extent[2] + 1, extent[5] - extent[4] + 1 };
}
}

glm::ivec3 ReferencePart::Piece::cut(PlacedVoxels& placed, const Box& box, double haloMm)
{
  if (!placed.voxels)
  {
    *this = Piece();
    return glm::ivec3(0);
  }
  const glm::ivec3 last = placed.grid.dimensions - 1;
  const WholeVolume all{ placed.grid, { 0, last.x, 0, last.y, 0, last.z } };
  const bool isNew = this->whole != placed.voxels || this->time != placed.voxels->GetMTime();
  Extent wanted = isNew ? Extent{ 0, -1, 0, -1, 0, -1 } : this->extent;
  // A box that goes far beyond an oblique grid would take in more of it.
  followBox(wanted, all, nullptr, commonBox(boxAround(placed.grid), box), haloMm);
  if (isNew || wanted != this->extent)
  {
    this->whole = placed.voxels;
    this->time = placed.voxels->GetMTime();
    this->extent = wanted;
    this->voxels = arrayOfPieces(wanted, { { all.extent, all.extent, placed.voxels } });
  }
  const glm::ivec3 first(wanted[0], wanted[2], wanted[4]);
  placed.voxels = this->voxels;
  placed.grid.origin = placed.grid.worldFromGrid(first);
  placed.grid.dimensions = sidesOf(wanted);
  return first;
}

void ReferencePart::cut(vtkImageData* volume, const Box& box, double haloMm)
{
  ReferenceVolume reference = readReference(volume);
  if (!reference.voxels)
  {
    *this = ReferencePart();
  }
  else
  {
    WholeReference whole = wholeOf(reference);
    whole.first = this->Voxels.cut(reference, box, haloMm);
    this->Cavity.cut(reference.cavity, box, haloMm);
    reference.whole = whole;
    attachReference(volume, reference);
  }
}
}
