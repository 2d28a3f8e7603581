// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/ReferencePart.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageParts.h"
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

vtkSmartPointer<vtkDataArray> voxelsIn(const PlacedVoxels& placed, const Extent& extent)
{
  const glm::ivec3 sides = sidesOf(extent);
  const auto count = static_cast<vtkIdType>(pointsIn(extent));
  const double bytes = static_cast<double>(count) * placed.voxels->GetDataTypeSize();
  requireHostMemory("A part of the reference", bytes);
  const auto voxels = vtk::TakeSmartPointer(placed.voxels->NewInstance());
  voxels->SetName(placed.voxels->GetName());
  voxels->SetNumberOfTuples(count);
  vtkIdType to = 0;
  for (int z = extent[4]; z <= extent[5]; ++z)
  {
    for (int y = extent[2]; y <= extent[3]; ++y)
    {
      const auto from = static_cast<vtkIdType>(placed.grid.offset(extent[0], y, z));
      voxels->InsertTuples(to, sides.x, from, placed.voxels);
      to += sides.x;
    }
  }
  return voxels;
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
    this->voxels = nullptr;
    if (wanted != all.extent)
    {
      // Without memory for a part, all of the reference stays, which is drawn alike.
      sentenceThrownBy("A part of the reference", [&] { this->voxels = voxelsIn(placed, wanted); });
    }
  }
  if (!this->voxels)
  {
    return glm::ivec3(0);
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
