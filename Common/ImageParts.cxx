// SPDX-License-Identifier: BSD-3-Clause
#include "Common/ImageParts.h"

#include "Common/HostMemory.h"
#include "Common/Problem.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkExtentTranslator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace brainshift
{
namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr double BytesInMiB = 1048576.0;

vtkInformationIntegerKey* readsAllKey()
{
  static auto* const key = vtkInformationIntegerKey::MakeKey("READS_ALL", "BrainShift");
  return key;
}

std::string sidesOf(const Extent& extent)
{
  return sizeText(glm::dvec3(extent[1], extent[3], extent[5]) -
    glm::dvec3(extent[0], extent[2], extent[4]) + 1.0);
}

int longestAxisOf(const Extent& extent)
{
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
  {
    const int side = extent[2 * axis + 1] - extent[2 * axis];
    longest = side > extent[2 * longest + 1] - extent[2 * longest] ? axis : longest;
  }
  return longest;
}

// Where to cut: in the middle, or near it where chunks of files mostly end.
int cutOf(int first, int last)
{
  constexpr int chunk = 64;
  const int middle = first + (last - first + 1) / 2;
  const int atChunk = first + (middle - first + chunk / 2) / chunk * chunk;
  return last - first >= 2 * chunk ? atChunk : middle;
}

double bytesOf(vtkDataSetAttributes* arrays)
{
  double bytes = 0.0;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    bytes +=
      array ? static_cast<double>(array->GetNumberOfComponents()) * array->GetDataTypeSize() : 0.0;
  }
  return bytes;
}
}

Extent extentOf(vtkImageData* image)
{
  Extent extent;
  image->GetExtent(extent.data());
  return extent;
}

Extent wholeExtentOf(vtkInformation* image)
{
  Extent whole{ 0, -1, 0, -1, 0, -1 };
  if (image->Has(Pipeline::WHOLE_EXTENT()))
  {
    image->Get(Pipeline::WHOLE_EXTENT(), whole.data());
  }
  return whole;
}

bool isOnePieceOfSeveral(vtkInformation* output)
{
  return output->Has(Pipeline::UPDATE_NUMBER_OF_PIECES()) &&
    output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) > 1;
}

Extent updateExtentOf(vtkInformation* image)
{
  Extent asked = wholeExtentOf(image);
  if (image->Has(Pipeline::UPDATE_EXTENT()))
  {
    image->Get(Pipeline::UPDATE_EXTENT(), asked.data());
  }
  return asked;
}

Extent pieceAskedOf(vtkInformation* output)
{
  Extent asked = updateExtentOf(output);
  if (!isOnePieceOfSeveral(output))
  {
    return asked;
  }
  // As the pipeline does it before it asks for data.
  Extent piece = asked;
  const int mode = output->Has(vtkExtentTranslator::UPDATE_SPLIT_MODE())
    ? output->Get(vtkExtentTranslator::UPDATE_SPLIT_MODE())
    : static_cast<int>(vtkExtentTranslator::BLOCK_MODE);
  vtkNew<vtkExtentTranslator> translator;
  translator->PieceToExtentThreadSafe(output->Get(Pipeline::UPDATE_PIECE_NUMBER()),
    output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()),
    output->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), asked.data(), piece.data(), mode, 0);
  return piece;
}

std::vector<Extent> cutToFit(const Extent& extent, const std::function<bool(const Extent&)>& fits)
{
  const int axis = longestAxisOf(extent);
  const int first = extent[2 * axis];
  const int last = extent[2 * axis + 1];
  if (last - first < LeastSide || fits(extent))
  {
    return { extent };
  }
  const int cut = cutOf(first, last);
  Extent low = extent;
  Extent high = extent;
  low[2 * axis + 1] = cut - 1;
  high[2 * axis] = cut;
  std::vector<Extent> parts = cutToFit(low, fits);
  const std::vector<Extent> others = cutToFit(high, fits);
  parts.insert(parts.end(), others.begin(), others.end());
  return parts;
}

Extent withNextPoints(const Extent& extent, const Extent& whole)
{
  Extent wide = extent;
  for (int axis = 0; axis < 3; ++axis)
  {
    wide[2 * axis + 1] += extent[2 * axis + 1] < whole[2 * axis + 1] ? 1 : 0;
  }
  return wide;
}

double bytesOfPoint(vtkInformation* image)
{
  constexpr double Most = 8.0;
  vtkInformation* scalars = vtkDataObject::GetActiveFieldInformation(
    image, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  if (!scalars || !scalars->Has(vtkDataObject::FIELD_ARRAY_TYPE()))
  {
    return Most;
  }
  const int components = scalars->Has(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS())
    ? scalars->Get(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS())
    : 1;
  return std::max(1, components) *
    static_cast<double>(
      std::max(1, vtkDataArray::GetDataTypeSize(scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE()))));
}

double bytesOfPoint(vtkImageData* image)
{
  return bytesOf(image->GetPointData()) + bytesOf(image->GetCellData());
}

Extent cornerOf(const Extent& extent)
{
  Extent corner = extent;
  for (int axis = 0; axis < 3; ++axis)
  {
    corner[2 * axis + 1] = std::min(extent[2 * axis] + 1, extent[2 * axis + 1]);
  }
  return corner;
}

void announceReadingAll(vtkInformation* output, bool readsAll)
{
  output->Set(readsAllKey(), readsAll ? 1 : 0);
  output->AppendUnique(vtkExecutive::KEYS_TO_COPY(), readsAllKey());
}

bool isBestAskedWhole(vtkInformation* image, double limitMiB)
{
  const bool readsAll = image->Has(readsAllKey()) && image->Get(readsAllKey()) != 0;
  return readsAll || pointsIn(wholeExtentOf(image)) * bytesOfPoint(image) <= limitMiB * BytesInMiB;
}

void updateExtent(vtkInformation* image, const Extent& extent)
{
  image->Set(Pipeline::UPDATE_EXTENT(), extent.data(), 6);
  image->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  image->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  image->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

void requirePart(vtkImageData* input, const Extent& part)
{
  const Extent held = input ? extentOf(input) : Extent{ 0, -1, 0, -1, 0, -1 };
  if (!holds(held, part))
  {
    throw Problem("The input holds " + sidesOf(held) + " points; it must hold the " +
      sidesOf(part) + " points that it was asked for. It failed, or it was stopped");
  }
}

void bringPart(vtkInformation* input, const Extent& part)
{
  vtkExecutive* producer = nullptr;
  int port = 0;
  vtkExecutive::PRODUCER()->Get(input, producer, port);
  updateExtent(input, part);
  const bool done = producer && producer->Update(port) != 0;
  requirePart(done ? vtkImageData::GetData(input) : nullptr, part);
}
}
