// SPDX-License-Identifier: BSD-3-Clause
#include "ScalarTexture.h"

#include "OpenGL.h"

#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSMPTools.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace brainshift
{
namespace
{
// One number of a tuple: a component, or the tuple's length.
template <typename T>
double numberOf(const T* tuple, int components, int component)
{
  if (component >= 0)
  {
    return static_cast<double>(tuple[std::min(component, components - 1)]);
  }
  double sum = 0.0;
  for (int c = 0; c < components; ++c)
  {
    sum += static_cast<double>(tuple[c]) * static_cast<double>(tuple[c]);
  }
  return std::sqrt(sum);
}

template <typename T, typename Stored, typename Convert>
void convertTyped(
  vtkDataArray* scalars, int component, std::vector<Stored>& stored, const Convert& convert)
{
  const T* values = static_cast<const T*>(scalars->GetVoidPointer(0));
  const int components = scalars->GetNumberOfComponents();
  vtkSMPTools::For(0, scalars->GetNumberOfTuples(), [&](vtkIdType first, vtkIdType end) {
    for (vtkIdType i = first; i < end; ++i)
    {
      stored[i] = convert(numberOf(values + i * components, components, component));
    }
  });
}

template <typename Stored, typename Convert>
std::vector<Stored> convertAll(vtkDataArray* scalars, int component, const Convert& convert)
{
  std::vector<Stored> stored(scalars->GetNumberOfTuples());
  switch (scalars->GetDataType())
  {
    vtkTemplateMacro((convertTyped<VTK_TT, Stored, Convert>(scalars, component, stored, convert)));
  }
  return stored;
}

// Types that 16 bits hold exactly. Eight-bit textures are avoided: their filter has eight bits too.
bool fitsSixteenBits(vtkDataArray* scalars, int component)
{
  return component >= 0 && scalars->GetDataTypeSize() <= 2;
}
}

ScalarTexture::ScalarTexture() = default;
ScalarTexture::~ScalarTexture() = default;

int ScalarTexture::bytesOf(vtkDataArray* scalars, int component)
{
  return fitsSixteenBits(scalars, component) ? 2 : 4;
}

bool ScalarTexture::update(vtkOpenGLRenderWindow* window, vtkDataArray* scalars,
  const glm::ivec3& dimensions, int component, Counters& counters, std::string& error)
{
  const unsigned long long time = scalars->GetMTime();
  if (this->Texture && this->Uploaded == scalars && this->UploadedTime == time &&
    this->UploadedComponent == component)
  {
    return true;
  }
  const int limit = vtkTextureObject::GetMaximumTextureSize3D(window);
  const int longest = std::max({ dimensions.x, dimensions.y, dimensions.z });
  if (longest > limit)
  {
    error = "The volume has " + std::to_string(longest) +
      " voxels along one axis; the GPU takes at most " + std::to_string(limit);
    return false;
  }
  if (!this->upload(window, scalars, dimensions, component, counters))
  {
    error = "The GPU refused a 3D texture of " + std::to_string(dimensions.x) + " x " +
      std::to_string(dimensions.y) + " x " + std::to_string(dimensions.z) + " voxels";
    this->Texture = nullptr;
    return false;
  }
  this->Uploaded = scalars;
  this->UploadedTime = time;
  this->UploadedComponent = component;
  return true;
}

bool ScalarTexture::upload(vtkOpenGLRenderWindow* window, vtkDataArray* scalars,
  const glm::ivec3& dimensions, int component, Counters& counters)
{
  this->Texture = vtkSmartPointer<vtkTextureObject>::New();
  this->Texture->SetContext(window);
  this->Texture->SetMinificationFilter(vtkTextureObject::Linear);
  this->Texture->SetMagnificationFilter(vtkTextureObject::Linear);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapR(vtkTextureObject::ClampToEdge);
  const auto create = [&](auto stored, int type, float shaderFromStored) {
    this->keepRanges(brickRanges(stored.data(), dimensions), shaderFromStored);
    counters.volumeUploads += 1;
    counters.bytesUploaded += static_cast<std::int64_t>(stored.size() * sizeof(stored[0]));
    return this->Texture->Create3DFromRaw(
      dimensions.x, dimensions.y, dimensions.z, 1, type, stored.data());
  };
  this->SixteenBits = fitsSixteenBits(scalars, component);
  if (!this->SixteenBits)
  {
    this->Scale = 1.0;
    this->Shift = 0.0;
    this->Texture->SetInternalFormat(GL_R32F);
    return create(
      convertAll<float>(scalars, component, [](double value) { return static_cast<float>(value); }),
      VTK_FLOAT, 1.0f);
  }
  // Whole numbers: stored from the type's lowest value up; eight bits spread over sixteen.
  const double lowest = scalars->GetDataTypeMin();
  const double spread = scalars->GetDataTypeSize() == 1 ? 257.0 : 1.0;
  this->Scale = 65535.0 / spread;
  this->Shift = lowest;
  this->Texture->SetInternalFormat(GL_R16);
  return create(
    convertAll<std::uint16_t>(scalars, component,
      [=](double value) { return static_cast<std::uint16_t>((value - lowest) * spread); }),
    VTK_UNSIGNED_SHORT, 1.0f / 65535.0f);
}

void ScalarTexture::keepRanges(const BrickRanges& ranges, float shaderFromStored)
{
  this->Ranges = ranges;
  float least = std::numeric_limits<float>::infinity();
  float greatest = -least;
  for (glm::vec2& range : this->Ranges.ranges)
  {
    range *= shaderFromStored;
    least = std::min(least, range.x);
    greatest = std::max(greatest, range.y);
  }
  this->Range = greatest > least && std::isfinite(greatest - least) ? greatest - least : 0.0f;
}

void ScalarTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
  this->Uploaded = nullptr;
}
}
