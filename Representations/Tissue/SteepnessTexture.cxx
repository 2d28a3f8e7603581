// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/SteepnessTexture.h"

#include "Representations/Gpu/GpuTask.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointData.h"
#include "vtkTextureObject.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cstddef>

namespace brainshift
{
namespace
{
constexpr int VtkEntries = 1024; // that VTK makes of a curve, and of each side of a table at least

// VTK makes a table larger, to a power of two, and looks its entries up from edge to edge. Here the
// table stays as it is: the first and the last of VTK's entries are its own.
glm::dvec2 entryOfVtk(int count)
{
  const double enlarged = std::max(VtkEntries, vtkMath::NearestPowerOfTwo(count));
  const double shrunk = (count - 1) / (enlarged - 1.0);
  return glm::dvec2(enlarged * shrunk, 0.5 - 0.5 * shrunk) / static_cast<double>(count);
}
}

SteepnessTexture::SteepnessTexture() = default;
SteepnessTexture::~SteepnessTexture() = default;

glm::dvec2 SteepnessTexture::entryFromFraction() const
{
  return entryOfVtk(this->Size.x);
}

glm::dvec2 SteepnessTexture::entryFromSteepness() const
{
  return entryOfVtk(this->Size.y);
}

bool SteepnessTexture::update(
  GpuTask& gpu, vtkVolumeProperty* property, Opacity opacity, const glm::dvec2& range)
{
  if (opacity == Opacity::Scalar)
  {
    this->Texture = nullptr;
    this->Kind = opacity;
    return true;
  }
  const bool table = opacity == Opacity::Table;
  const unsigned long long time = table ? property->GetTransferFunction2D()->GetMTime()
                                        : property->GetGradientOpacity()->GetMTime();
  if (this->Texture && this->Kind == opacity && this->Range == range && this->SourceTime == time)
  {
    return true;
  }
  this->Kind = opacity;
  this->Range = range;
  this->SourceTime = time;
  gpu.counters.transferUploads += 1;
  return table ? this->uploadTable(gpu, property, range) : this->uploadCurve(gpu, property, range);
}

bool SteepnessTexture::uploadCurve(
  GpuTask& gpu, vtkVolumeProperty* property, const glm::dvec2& range)
{
  this->Size = { 1, VtkEntries };
  std::vector<float> factors(VtkEntries);
  const double steepest = SteepestFraction * (range.y > range.x ? range.y - range.x : 1.0);
  property->GetGradientOpacity()->GetTable(0.0, steepest, VtkEntries, factors.data());
  for (float& factor : factors)
  {
    factor = std::clamp(factor, 0.0f, 1.0f);
  }
  return this->create(gpu, 1, factors);
}

bool SteepnessTexture::uploadTable(
  GpuTask& gpu, vtkVolumeProperty* property, const glm::dvec2& range)
{
  vtkImageData* image = property->GetTransferFunction2D();
  const int* dimensions = image->GetDimensions();
  this->Size = { dimensions[0], dimensions[1] };
  const auto* entries = static_cast<float*>(image->GetPointData()->GetScalars()->GetVoidPointer(0));
  std::vector<float> texels(
    entries, entries + static_cast<std::size_t>(4) * this->Size.x * this->Size.y);
  this->Columns.visible.assign(this->Size.x, false);
  this->Columns.range = range;
  this->Columns.largest = 0.0f;
  for (std::size_t i = 0; i < texels.size() / 4; ++i)
  {
    float& opacity = texels[4 * i + 3];
    opacity = opacity > 0.0f ? std::min(opacity, 1.0f) : 0.0f; // 0 for NaN
    this->Columns.largest = std::max(this->Columns.largest, opacity);
    if (opacity > 0.0f)
    {
      this->Columns.visible[i % this->Size.x] = true;
    }
  }
  this->Columns.time = gpu.counters.transferUploads;
  return this->create(gpu, 4, texels);
}

bool SteepnessTexture::create(GpuTask& gpu, int components, std::vector<float>& texels)
{
  this->Texture = vtkSmartPointer<vtkTextureObject>::New();
  this->Texture->SetContext(gpu.window);
  this->Texture->SetMinificationFilter(vtkTextureObject::Linear);
  this->Texture->SetMagnificationFilter(vtkTextureObject::Linear);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  gpu.counters.bytesUploaded += static_cast<std::int64_t>(texels.size() * sizeof(float));
  if (!this->Texture->Create2DFromRaw(static_cast<unsigned int>(this->Size.x),
        static_cast<unsigned int>(this->Size.y), components, VTK_FLOAT, texels.data()))
  {
    this->Texture = nullptr;
    return false;
  }
  return true;
}

void SteepnessTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
}
}
