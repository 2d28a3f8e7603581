// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/BakedVolume.h"

#include "Common/ImageParts.h"
#include "Common/Problem.h"
#include "Filters/Attached/RestExtent.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>

namespace brainshift
{
namespace
{
// The numbers of points or of cells in an extent, in those of the whole. A side of one point has
// the cells beside it.
IndexBox indicesOf(const Extent& extent, const Extent& whole, bool cells)
{
  IndexBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.first[axis] = extent[2 * axis] - whole[2 * axis];
    box.last[axis] = extent[2 * axis + 1] - whole[2 * axis];
    if (cells && box.last[axis] > box.first[axis])
    {
      --box.last[axis];
    }
    else if (cells)
    {
      const int lastCell = whole[2 * axis + 1] - whole[2 * axis] - 1;
      box.first[axis] = std::clamp(box.first[axis], 0, std::max(lastCell, 0));
      box.last[axis] = box.first[axis];
    }
  }
  return box;
}

// The points that hold the points or cells of a box.
Extent extentAround(const IndexBox& box, const Extent& whole, bool cells)
{
  Extent extent;
  for (int axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = whole[2 * axis] + box.first[axis];
    extent[2 * axis + 1] = whole[2 * axis] + box.last[axis] + (cells ? 1 : 0);
  }
  return extent;
}

void addLowest(vtkDataSetAttributes* arrays, std::vector<std::vector<double>>& lowest)
{
  lowest.resize(arrays->GetNumberOfArrays());
  for (std::size_t i = 0; i < lowest.size(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(static_cast<int>(i));
    const std::vector<double> ofPart = array ? lowestOf(array) : std::vector<double>();
    if (lowest[i].empty())
    {
      lowest[i] = ofPart;
    }
    for (std::size_t c = 0; c < std::min(ofPart.size(), lowest[i].size()); ++c)
    {
      lowest[i][c] = std::min(lowest[i][c], ofPart[c]);
    }
  }
}

bool isLike(vtkDataArray* array, vtkDataArray* other)
{
  return (!array && !other) ||
    (array && other && array->GetDataType() == other->GetDataType() &&
      array->GetNumberOfComponents() == other->GetNumberOfComponents());
}

Lacking bakeArrays(vtkDataSetAttributes* from, const std::vector<vtkSmartPointer<vtkDataArray>>& to,
  const std::vector<std::vector<double>>& lowest, const Resampling& how)
{
  Lacking lacking;
  for (std::size_t i = 0; i < to.size() && !lacking.stopped; ++i)
  {
    vtkDataArray* source = from->GetArray(static_cast<int>(i));
    if (!isLike(source, to[i]))
    {
      throw Problem("The input changed its arrays while it was baked");
    }
    if (source)
    {
      const std::vector<double> unknown(source->GetNumberOfComponents());
      lacking.add(resample(source, to[i], i < lowest.size() ? lowest[i] : unknown, how));
    }
  }
  return lacking;
}
}

void LowestValues::add(vtkImageData* part)
{
  addLowest(part->GetPointData(), this->points);
  addLowest(part->GetCellData(), this->cells);
}

Extent BakedVolume::restOf(
  const WholeVolume& volume, const brainshift::Lattice& lattice, const Extent& block)
{
  const Extent& whole = volume.extent;
  const glm::dvec3 start(whole[0], whole[2], whole[4]);
  const glm::dvec3 low = glm::dvec3(block[0], block[2], block[4]) - start;
  const glm::dvec3 high = glm::dvec3(block[1], block[3], block[5]) - start;
  const PositionRange part{ low, high + 1.0 }; // with the cells between it and the next block
  return around(restExtent(volume, &lattice, part, 0.0), block);
}

// Lattice coordinates of the values of an array: on the volume's points, or in its cells' middles.
ResampleGeometry BakedVolume::geometryOf(const Extent& held, const Extent& block, bool cells) const
{
  const Grid& grid = this->Volume.grid;
  const Extent& whole = this->Volume.extent;
  ResampleGeometry geometry;
  geometry.dimensions = cells ? grid.dimensions - 1 : grid.dimensions;
  geometry.held = indicesOf(held, whole, cells);
  geometry.target = indicesOf(this->Asked, whole, cells);
  geometry.written = indicesOf(cells ? withNextPoints(block, this->Asked) : block, whole, cells);
  const glm::dvec3 middle(cells ? 0.5 : 0.0);
  geometry.latticeFromIndex = grid.spacing / this->Lattice.spacing;
  geometry.latticeOfFirst = this->Lattice.gridFromWorld(grid.worldFromGrid(middle));
  return geometry;
}

void BakedVolume::make(vtkDataSetAttributes* from, bool cells, Arrays& arrays) const
{
  const glm::ivec3 size = indicesOf(this->Asked, this->Volume.extent, cells).size();
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkSmartPointer<vtkDataArray> array;
    if (vtkDataArray* source = from->GetArray(i)) // names of something cannot be interpolated
    {
      array = vtkSmartPointer<vtkDataArray>::Take(source->NewInstance());
      array->SetName(source->GetName());
      array->SetNumberOfComponents(source->GetNumberOfComponents());
      array->SetNumberOfTuples(static_cast<vtkIdType>(size.x) * size.y * size.z);
    }
    arrays.all.push_back(array);
  }
  arrays.scalars = from->GetScalars() && from->GetScalars()->GetName()
    ? from->GetScalars()->GetName()
    : std::string();
  arrays.isMade = true;
}

LackingBlock BakedVolume::bake(vtkImageData* input, const Extent& block, const LowestValues* lowest,
  Reading reading, const std::function<bool(double)>& proceed)
{
  LackingBlock lacking;
  for (const bool cells : { false, true })
  {
    vtkDataSetAttributes* from =
      cells ? static_cast<vtkDataSetAttributes*>(input->GetCellData()) : input->GetPointData();
    Arrays& to = cells ? this->Cells : this->Points;
    if (!to.isMade)
    {
      this->make(from, cells, to);
    }
    const Extent held = extentOf(input);
    const Resampling how{ this->geometryOf(held, block, cells), this->Backward, reading, proceed };
    const LowestValues unknown;
    const LowestValues& known = lowest ? *lowest : unknown;
    const Lacking found = bakeArrays(from, to.all, cells ? known.cells : known.points, how);
    lacking.lowest = lacking.lowest || (found.outside && !lowest);
    lacking.stopped = lacking.stopped || found.stopped;
    if (!found.voxels.empty())
    {
      const Extent more = extentAround(found.voxels, this->Volume.extent, cells);
      lacking.extent = around(lacking.extent ? *lacking.extent : held, more);
    }
  }
  return lacking;
}

void BakedVolume::giveTo(vtkImageData* image) const
{
  image->SetExtent(const_cast<int*>(this->Asked.data()));
  for (const bool cells : { false, true })
  {
    vtkDataSetAttributes* to =
      cells ? static_cast<vtkDataSetAttributes*>(image->GetCellData()) : image->GetPointData();
    const Arrays& arrays = cells ? this->Cells : this->Points;
    to->Initialize();
    for (const vtkSmartPointer<vtkDataArray>& array : arrays.all)
    {
      if (array)
      {
        to->AddArray(array);
      }
    }
    if (!arrays.scalars.empty())
    {
      to->SetActiveScalars(arrays.scalars.c_str());
    }
  }
}
}
