// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Volumes/OutgoingVolume.h"

#include "Common/FieldWord.h"
#include "Common/ImageGrid.h"
#include "Common/ImageParts.h"
#include "Common/LabelTable.h"
#include "Formats/Files/Text.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
vtkDataArray* arrayOf(vtkImageData* image, const std::string& name)
{
  vtkPointData* arrays = image->GetPointData();
  if (!name.empty())
  {
    return arrays->GetArray(name.c_str());
  }
  for (int i = 0; !arrays->GetScalars() && i < arrays->GetNumberOfArrays(); ++i)
  {
    if (arrays->GetArray(i))
    {
      return arrays->GetArray(i);
    }
  }
  return arrays->GetScalars();
}

std::string missingArray(vtkImageData* image, const std::string& name)
{
  std::string names;
  for (int i = 0; i < image->GetPointData()->GetNumberOfArrays(); ++i)
  {
    const char* other = image->GetPointData()->GetArrayName(i);
    names += (names.empty() ? "" : ", ") + std::string(other ? other : "(no name)");
  }
  if (names.empty())
  {
    return "The input has no point array to write";
  }
  return "The input has no point array " + name + " of numbers; it has " + names;
}

bool isUnsigned(int type)
{
  switch (type)
  {
    case VTK_CHAR:
      return !std::numeric_limits<char>::is_signed;
    case VTK_UNSIGNED_CHAR:
    case VTK_UNSIGNED_SHORT:
    case VTK_UNSIGNED_INT:
    case VTK_UNSIGNED_LONG:
    case VTK_UNSIGNED_LONG_LONG:
      return true;
    default:
      return false;
  }
}

VoxelNumber typeOf(vtkDataArray* array)
{
  const int type = array->GetDataType();
  const bool isFloating = type == VTK_FLOAT || type == VTK_DOUBLE;
  return { isFloating    ? VoxelNumber::Kind::Floating
      : isUnsigned(type) ? VoxelNumber::Kind::Unsigned
                         : VoxelNumber::Kind::Signed,
    array->GetDataTypeSize() };
}

vtkSmartPointer<vtkDataArray> copyAs(int type, vtkDataArray* array)
{
  auto copy = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  copy->DeepCopy(array);
  return copy;
}

// Whole numbers of 8 bytes, which most readers of medical files do not know, become those of 4.
void shorten(vtkDataArray* array, OutgoingVolume& volume, std::string& warning)
{
  const bool isPositive = volume.type.kind == VoxelNumber::Kind::Unsigned;
  const double least = isPositive ? 0.0 : std::numeric_limits<vtkTypeInt32>::min();
  const double most = isPositive ? double(std::numeric_limits<vtkTypeUInt32>::max())
                                 : double(std::numeric_limits<vtkTypeInt32>::max());
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    double range[2];
    array->GetRange(range, i);
    if (range[0] < least || range[1] > most)
    {
      throw Problem(joined("The input is of the type ", array->GetDataTypeAsString(),
        ", which is written with 4 bytes a number; its numbers go from ", range[0], " to ",
        range[1], " and must be from ", least, " to ", most));
    }
  }
  volume.type.bytes = 4;
  warning = std::string("The input is of the type ") + array->GetDataTypeAsString() +
    "; the file has whole numbers of 4 bytes, which hold its values";
  volume.numbers = copyAs(isPositive ? VTK_UNSIGNED_INT : VTK_INT, array);
}

// What field arrays of our readers say of the scalars: unit, and whether small ones are bright.
void takeMeaning(vtkImageData* image, OutgoingVolume& volume)
{
  volume.unit = fieldWordOf(image, "Unit");
  vtkDataArray* mark = image->GetFieldData()->GetArray("SmallIsBright");
  volume.smallIsBright = mark && mark->GetNumberOfValues() == 1 && mark->GetComponent(0, 0) != 0.0;
}

void takeNumbers(vtkDataArray* array, OutgoingVolume& volume, std::string& warning)
{
  if (array->GetDataType() == VTK_BIT)
  {
    throw Problem("The input is of the type bit, which no file of volumes holds; it must be of "
                  "whole numbers of 1 to 8 bytes, float or double");
  }
  volume.type = typeOf(array);
  if (volume.type.bytes > 4 && volume.type.kind != VoxelNumber::Kind::Floating)
  {
    shorten(array, volume, warning);
    return;
  }
  // Files want the components of a voxel side by side.
  volume.numbers = array;
  if (!array->HasStandardMemoryLayout())
  {
    volume.numbers = copyAs(array->GetDataType(), array);
  }
}
}

int OutgoingVolume::components() const
{
  return this->numbers->GetNumberOfComponents();
}

const char* OutgoingVolume::bytes() const
{
  return static_cast<const char*>(this->numbers->GetVoidPointer(0));
}

std::size_t OutgoingVolume::bytesOfVoxel() const
{
  return static_cast<std::size_t>(this->components()) * this->type.bytes;
}

std::size_t OutgoingVolume::bytesOfVolume() const
{
  return this->grid.count() * this->bytesOfVoxel();
}

void takeOut(vtkImageData* image, const std::string& arrayName, WorldAxes world,
  OutgoingVolume& volume, std::string& warning)
{
  vtkDataArray* array = arrayOf(image, arrayName);
  if (!array)
  {
    throw Problem(missingArray(image, arrayName));
  }
  if (array->GetNumberOfTuples() == 0)
  {
    throw Problem("The input has no voxels");
  }
  volume.grid = outgoingGrid(image, image->GetExtent(), world);
  takeNumbers(array, volume, warning);
  const bool areScalars = array == image->GetPointData()->GetScalars();
  volume.isLabelMap = areScalars && isLabelMap(image);
  if (areScalars && !volume.isLabelMap)
  {
    takeMeaning(image, volume);
  }
  const WorldAxes axes = world == WorldAxes::Unknown ? worldAxesOf(image) : world;
  volume.knowsSides = axes != WorldAxes::Unknown;
  volume.space = templateOf(image);
  const WorldAxes own = worldAxesOf(image);
  if (own != WorldAxes::Unknown && own != axes)
  {
    warning += std::string(warning.empty() ? "" : ". ") + "The world axes of the input are " +
      (own == WorldAxes::LPS ? "LPS" : "RAS") + ", but World is " +
      (axes == WorldAxes::LPS ? "LPS" : "RAS") + ", which counts";
  }
  if (!volume.knowsSides)
  {
    warning += std::string(warning.empty() ? "" : ". ") + UnknownSidesWritten +
      ". Set World if you know the axes";
  }
}

Grid outgoingGrid(vtkImageData* image, const int extent[6], WorldAxes world)
{
  const Grid grid = gridOf(image, extent);
  withBeginning("The input's ", [&] { throwIfAny(problemOfGrid(grid)); });
  const WorldAxes axes = world == WorldAxes::Unknown ? worldAxesOf(image) : world;
  return axes == WorldAxes::LPS ? withReversedXY(grid) : grid;
}

std::string noteOfTimes(vtkImageData* image, vtkInformation* pipeline, const std::string& container)
{
  const int times = pipeline ? pipeline->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()) : 0;
  if (times <= 1)
  {
    return {};
  }
  vtkInformation* data = image->GetInformation();
  const bool knowsTime = data->Has(vtkDataObject::DATA_TIME_STEP()) != 0;
  return joined("The input has ", times, " times; the ", container, " has one of them",
    knowsTime ? joined(", at ", data->Get(vtkDataObject::DATA_TIME_STEP()), " s") : "");
}

bool needsTransform(const Grid& grid)
{
  return grid.direction != glm::dmat3(1.0) || grid.origin != glm::dvec3(0.0);
}

Grid withReversedXY(const Grid& grid)
{
  const glm::dvec3 signs(-1.0, -1.0, 1.0);
  Grid reversed = grid;
  reversed.origin *= signs;
  for (int axis = 0; axis < 3; ++axis)
  {
    reversed.direction[axis] *= signs;
  }
  return reversed;
}
}
