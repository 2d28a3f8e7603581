// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/TransferTexture.h"

#include "Common/PiecedArray.h"
#include "Representations/Gpu/OpenGL.h"
#include "Representations/Tissue/CoarseVoxels.h"
#include "Representations/Tissue/SteepnessTexture.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPiecewiseFunction.h"
#include "vtkSMPTools.h"
#include "vtkTextureObject.h"
#include "vtkVolumeProperty.h"

#include <cmath>

namespace brainshift
{
namespace
{
constexpr int Channels = 4; // the fourth unused: rows of three bytes are misaligned

bool isReal(vtkDataArray* array)
{
  return array->GetDataType() == VTK_FLOAT || array->GetDataType() == VTK_DOUBLE;
}

std::vector<std::uint8_t> bytesOf(vtkDataArray* array)
{
  const double scale = isReal(array) ? 255.0 : 1.0;
  std::vector<std::uint8_t> bytes(Channels * array->GetNumberOfTuples());
  vtkSMPTools::For(0, array->GetNumberOfTuples(), [&](vtkIdType first, vtkIdType end) {
    std::uint8_t* out = &bytes[Channels * first];
    for (const auto tuple : vtk::DataArrayTupleRange(array, first, end))
    {
      for (int c = 0; c < Channels; ++c, ++out)
      {
        const double level = static_cast<double>(tuple[c]) * scale + 0.5;
        *out = level >= 0.0 ? static_cast<std::uint8_t>(std::min(level, 255.0)) : 0; // NaN: 0
      }
    }
  });
  return bytes;
}

std::vector<std::uint8_t> coarserBytes(
  const std::vector<std::uint8_t>& bytes, const ValueLayout& layout)
{
  const glm::ivec3& side = layout.dimensions;
  std::vector<std::uint8_t> coarse(static_cast<std::size_t>(Channels) * side.x * side.y * side.z);
  for (int c = 0; c < Channels; ++c)
  {
    joinVoxels<MeanNumber>(
      layout, [&](vtkIdType voxel) { return static_cast<double>(bytes[Channels * voxel + c]); },
      [&](vtkIdType texel, double mean) {
        coarse[Channels * texel + c] = static_cast<std::uint8_t>(mean + 0.5);
      });
  }
  return coarse;
}
}

ColorTexture::ColorTexture() = default;
ColorTexture::~ColorTexture() = default;

bool ColorTexture::update(
  vtkOpenGLRenderWindow* window, vtkDataArray* array, const ValueLayout& layout, Counters& counters)
{
  if (this->Texture && this->Uploaded == array && this->UploadedTime == array->GetMTime() &&
    this->UploadedPerTexel == layout.perTexel)
  {
    return true;
  }
  std::vector<std::uint8_t> bytes = bytesOf(contiguous(array));
  if (!layout.isWhole())
  {
    bytes = coarserBytes(bytes, layout);
  }
  const glm::ivec3& dimensions = layout.dimensions;
  this->Texture = vtkSmartPointer<vtkTextureObject>::New();
  this->Texture->SetContext(window);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapR(vtkTextureObject::ClampToEdge);
  counters.bytesUploaded += static_cast<std::int64_t>(bytes.size());
  if (!this->Texture->Create3DFromRaw(
        dimensions.x, dimensions.y, dimensions.z, Channels, VTK_UNSIGNED_CHAR, bytes.data()))
  {
    this->Texture = nullptr;
    return false;
  }
  this->Uploaded = array;
  this->UploadedTime = array->GetMTime();
  this->UploadedPerTexel = layout.perTexel;
  return true;
}

void ColorTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
  this->Uploaded = nullptr;
}

namespace
{
constexpr int Entries = TransferEntries;
// Pictures of skin and cortex show rings where so much of a step's opacity is gained within so
// small a part of the colour map's range.
constexpr float SteepRise = 0.8f;
constexpr int SteepEntries = Entries / 12;

// The opacity of a sample, from the opacity of one unit distance.
float opacityOfSample(float opacity, double unitsInStep, Blend blend)
{
  const double given = std::clamp(static_cast<double>(opacity), 0.0, 1.0);
  switch (blend)
  {
    case Blend::Composite:
      return static_cast<float>(1.0 - std::pow(1.0 - given, unitsInStep));
    case Blend::Additive:
      return static_cast<float>(given * unitsInStep);
    default:
      return static_cast<float>(given);
  }
}

// `texels`: colours and opacities. Only the first row, of one step, counts.
bool risesFast(const std::vector<float>& texels)
{
  float rise = 0.0f;
  for (int i = 0; i < Entries - SteepEntries; ++i)
  {
    const float before = texels[4 * i + 3];
    const float after = texels[4 * (i + SteepEntries) + 3];
    rise = std::max(rise, std::abs(after - before));
  }
  return rise >= SteepRise;
}

vtkSmartPointer<vtkTextureObject> makeTable(
  vtkOpenGLRenderWindow* window, std::vector<float>& texels, Counters& counters)
{
  auto table = vtkSmartPointer<vtkTextureObject>::New();
  table->SetContext(window);
  table->SetMinificationFilter(vtkTextureObject::Nearest);
  table->SetMagnificationFilter(vtkTextureObject::Nearest);
  table->SetWrapS(vtkTextureObject::ClampToEdge);
  table->SetWrapT(vtkTextureObject::ClampToEdge);
  table->Create2DFromRaw(Entries, TransferRows, 4, VTK_FLOAT, texels.data());
  counters.bytesUploaded += static_cast<std::int64_t>(texels.size() * sizeof(float));
  return table;
}
}

TransferTexture::TransferTexture() = default;
TransferTexture::~TransferTexture() = default;

double TransferTexture::scale() const
{
  return (Entries - 1.0) / Entries / (this->Range[1] - this->Range[0]);
}

double TransferTexture::shift() const
{
  return 0.5 / Entries - this->Range[0] * this->scale();
}

bool TransferTexture::update(
  GpuTask& gpu, vtkVolumeProperty* property, double stepMm, Blend blend, Coloring coloring)
{
  vtkColorTransferFunction* color = property->GetRGBTransferFunction();
  vtkPiecewiseFunction* opacity = property->GetScalarOpacity();
  const double unitMm = property->GetScalarOpacityUnitDistance();
  if (this->Texture && this->ColumnsTime == 0 && this->ColorTime == color->GetMTime() &&
    this->OpacityTime == opacity->GetMTime() && this->StepMm == stepMm && this->UnitMm == unitMm &&
    this->Blending == blend && this->ColorSource == coloring)
  {
    return false;
  }
  const double* opacityRange = opacity->GetRange();
  const double* colorRange = coloring == Coloring::Direct ? opacityRange : color->GetRange();
  this->Range[0] = std::min(colorRange[0], opacityRange[0]);
  this->Range[1] = std::max(colorRange[1], opacityRange[1]);
  if (!(this->Range[1] > this->Range[0]))
  {
    this->Range[1] = this->Range[0] + 1.0;
  }
  std::vector<float> colors(3 * Entries);
  std::vector<float> opacities(Entries);
  color->GetTable(this->Range[0], this->Range[1], Entries, colors.data());
  opacity->GetTable(this->Range[0], this->Range[1], Entries, opacities.data());
  std::vector<float> texels(4 * Entries * TransferRows);
  for (int i = 0; i < Entries; ++i)
  {
    std::copy_n(&colors[3 * i], 3, &texels[4 * i]);
    texels[4 * i + 3] = opacityOfSample(opacities[i], stepMm / unitMm, blend);
  }
  for (std::size_t i = 4 * Entries; i < texels.size(); ++i)
  {
    const float above = texels[i - 4 * Entries];
    texels[i] = i % 4 == 3 ? above * (2.0f - above) : above; // what two such steps hide
  }
  this->upload(gpu, texels);
  this->makeSums(gpu.window, texels, gpu.counters);
  this->ColumnsTime = 0;
  this->ColorTime = color->GetMTime();
  this->OpacityTime = opacity->GetMTime();
  this->StepMm = stepMm;
  this->UnitMm = unitMm;
  this->Blending = blend;
  this->ColorSource = coloring;
  return true;
}

bool TransferTexture::update(GpuTask& gpu, const VisibleColumns& columns, double steps)
{
  if (this->Texture && this->ColumnsTime == columns.time && this->StepMm == steps)
  {
    return false;
  }
  this->Range[0] = columns.range.x;
  this->Range[1] = columns.range.y > columns.range.x ? columns.range.y : columns.range.x + 1.0;
  // An entry stands for the scalars around it, and the table is blended between two columns.
  const int count = static_cast<int>(columns.visible.size());
  std::vector<float> texels(4 * Entries * TransferRows, 0.0f);
  for (int i = 0; i < Entries * TransferRows; ++i)
  {
    const double entry = i % Entries;
    const double column = (count - 1) / (Entries - 1.0);
    const int first = std::max(static_cast<int>(std::floor((entry - 1.0) * column)) - 1, 0);
    const int last = std::min(static_cast<int>(std::ceil((entry + 1.0) * column)) + 1, count - 1);
    const auto from = columns.visible.begin() + first;
    const bool visible = std::find(from, columns.visible.begin() + last + 1, true) !=
      columns.visible.begin() + last + 1;
    texels[4 * static_cast<std::size_t>(i) + 3] = visible ? 1.0f : 0.0f;
  }
  this->upload(gpu, texels);
  this->Sums = nullptr;
  this->LargestOpacity = opacityOfSample(columns.largest, steps, Blend::Composite);
  this->ColumnsTime = columns.time;
  this->StepMm = steps;
  return true;
}

// Of the first row it also finds what is visible.
void TransferTexture::upload(GpuTask& gpu, std::vector<float>& texels)
{
  this->VisibleBefore.assign(Entries + 1, 0);
  this->LargestOpacity = 0.0f;
  for (int i = 0; i < Entries; ++i)
  {
    this->LargestOpacity = std::max(this->LargestOpacity, texels[4 * i + 3]);
    this->VisibleBefore[i + 1] = this->VisibleBefore[i] + (texels[4 * i + 3] > 0.0f ? 1 : 0);
  }
  this->Texture = makeTable(gpu.window, texels, gpu.counters);
  gpu.counters.transferUploads += 1;
}

void TransferTexture::makeSums(
  vtkOpenGLRenderWindow* window, const std::vector<float>& texels, Counters& counters)
{
  this->Sums = nullptr;
  if (!risesFast(texels))
  {
    return;
  }
  std::vector<float> sums(texels.size());
  for (int row = 0; row < TransferRows; ++row)
  {
    double before[4] = { 0.0, 0.0, 0.0, 1.0 };
    for (int i = 4 * row * Entries; i < 4 * (row + 1) * Entries; i += 4)
    {
      const float opacity = texels[i + 3];
      std::copy_n(before, 4, &sums[i]);
      sums[i + 3] *= opacity > 0.0f ? 1.0f : -1.0f;
      for (int component = 0; component < 4; ++component)
      {
        before[component] += component == 3 ? opacity : opacity * texels[i + component];
      }
    }
  }
  this->Sums = makeTable(window, sums, counters);
}

VisibleValues TransferTexture::visibleValues(double scale, double shift) const
{
  VisibleValues visible;
  visible.entries = Entries;
  visible.before = this->VisibleBefore;
  visible.entryFromValue = scale * this->scale() * Entries;
  visible.entryOfValueZero = (shift * this->scale() + this->shift()) * Entries - 0.5;
  return visible;
}

bool TransferTexture::visibleUpwards() const
{
  const int visible = this->VisibleBefore[Entries];
  return this->VisibleBefore[Entries - visible] == 0;
}

bool TransferTexture::visibleDownwards() const
{
  const int visible = this->VisibleBefore[Entries];
  return this->VisibleBefore[visible] == visible;
}

void TransferTexture::releaseGraphicsResources(vtkWindow* window)
{
  for (auto* table : { &this->Texture, &this->Sums })
  {
    if (*table)
    {
      (*table)->ReleaseGraphicsResources(window);
    }
    *table = nullptr;
  }
}
}
