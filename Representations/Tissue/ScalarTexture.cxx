// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/ScalarTexture.h"

#include "Common/PiecedArray.h"
#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Gpu/OpenGL.h"
#include "Representations/Tissue/CoarseVoxels.h"

#include "vtkDataArray.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

#include <cmath>
#include <memory>

namespace brainshift
{
namespace
{
constexpr vtkIdType VoxelsAtLeast = 65536; // for a thread

template <typename T>
double lengthOf(const T* tuple, int components)
{
  double sum = 0.0;
  for (int c = 0; c < components; ++c)
  {
    sum += static_cast<double>(tuple[c]) * static_cast<double>(tuple[c]);
  }
  return std::sqrt(sum);
}

// One number of each tuple: a component, or the tuple's length if `component` is -1.
template <typename T, typename Stored, typename Convert>
void convertTyped(vtkDataArray* scalars, int component, Stored* stored, const Convert& convert)
{
  const vtkIdType components = scalars->GetNumberOfComponents();
  const vtkIdType chosen = std::min<vtkIdType>(component, components - 1);
  const auto convertRun = [&](vtkIdType first, const T* values, vtkIdType count) {
    Stored* const out = stored + first;
    for (vtkIdType i = 0; components == 1 && i < count; ++i) // apart: this one vectorises
    {
      out[i] = convert(values[i]);
    }
    for (vtkIdType i = 0; components > 1 && i < count; ++i)
    {
      out[i] = chosen < 0 ? convert(lengthOf(values + i * components, components))
                          : convert(values[i * components + chosen]);
    }
  };
  const vtkSmartPointer<vtkDataArray> runs = inRuns<T>(scalars);
  parallelFor(0, scalars->GetNumberOfTuples(), VoxelsAtLeast,
    [&](vtkIdType first, vtkIdType end) { forEachRun<T>(runs, first, end, convertRun); });
}

template <typename Voxel, typename Write>
void joinAs(const ScalarSource& source, const Voxel& voxel, const Write& write)
{
  if (source.labels)
  {
    joinVoxels<MostFrequentNumber>(source.layout, voxel, write);
  }
  else
  {
    joinVoxels<MeanNumber>(source.layout, voxel, write);
  }
}

// One number for the voxels of each texel.
template <typename T, typename Stored, typename Convert>
void convertCoarser(const ScalarSource& source, Stored* stored, const Convert& convert)
{
  const vtkSmartPointer<vtkDataArray> scalars = contiguous(source.scalars);
  const T* values = static_cast<const T*>(scalars->GetVoidPointer(0));
  const int components = scalars->GetNumberOfComponents();
  const int chosen = std::min(source.component, components - 1);
  const auto write = [=](vtkIdType texel, double number) { stored[texel] = convert(number); };
  if (components == 1 && chosen == 0) // apart: this one is faster
  {
    joinAs(source, [=](vtkIdType i) { return static_cast<double>(values[i]); }, write);
    return;
  }
  const auto voxel = [=](vtkIdType i) {
    return chosen < 0 ? lengthOf(values + i * components, components)
                      : static_cast<double>(values[i * components + chosen]);
  };
  joinAs(source, voxel, write);
}

// Types that 16 bits hold exactly. Eight-bit textures are avoided: their filter has eight bits too.
bool fitsSixteenBits(vtkDataArray* scalars, int component)
{
  return component >= 0 && scalars->GetDataTypeSize() <= 2;
}

// Whole numbers of one or two bytes: stored from the type's lowest value up; eight bits spread over
// sixteen.
class SixteenBits
{
public:
  explicit SixteenBits(vtkDataArray* scalars)
    : Lowest(static_cast<int>(scalars->GetDataTypeMin()))
    , Spread(scalars->GetDataTypeSize() == 1 ? 257 : 1)
  {
  }

  double scale() const { return 65535.0 / this->Spread; }
  double shift() const { return this->Lowest; }

  template <typename Value>
  std::uint16_t operator()(Value value) const
  {
    if constexpr (std::is_floating_point_v<Value>) // the mean of several voxels
    {
      return static_cast<std::uint16_t>(std::lround((value - this->Lowest) * this->Spread));
    }
    else
    {
      return static_cast<std::uint16_t>((static_cast<int>(value) - this->Lowest) * this->Spread);
    }
  }

private:
  int Lowest;
  int Spread;
};

// As a float texture stores them.
struct Floats
{
  template <typename Value>
  float operator()(Value value) const
  {
    return static_cast<float>(static_cast<double>(value));
  }
};

// Whether a texture takes the array's own numbers, if they have its type.
bool isStoredAsItIs(const ScalarSource& source)
{
  return source.scalars->GetNumberOfComponents() == 1 && source.layout.isWhole() &&
    source.scalars->HasStandardMemoryLayout();
}

int& texturesGivenBack()
{
  static int count = 0;
  return count;
}
}

int ScalarTexture::givenBack()
{
  return texturesGivenBack();
}

// The memory is not set to zero, so that each thread is the first to touch its own part.
template <typename Stored, typename Convert>
std::unique_ptr<Stored[]> ScalarTexture::convertAll(
  const ScalarSource& source, const Convert& convert)
{
  const glm::ivec3& side = source.layout.dimensions;
  vtkDataArray* scalars = source.scalars;
  const vtkIdType count = source.layout.isWhole()
    ? scalars->GetNumberOfTuples()
    : static_cast<vtkIdType>(side.x) * side.y * side.z;
  std::unique_ptr<Stored[]> stored(new Stored[count]);
  if (source.layout.isWhole())
  {
    switch (scalars->GetDataType())
    {
      vtkTemplateMacro(
        (convertTyped<VTK_TT, Stored, Convert>(scalars, source.component, stored.get(), convert)));
    }
    return stored;
  }
  switch (scalars->GetDataType())
  {
    vtkTemplateMacro((convertCoarser<VTK_TT, Stored, Convert>(source, stored.get(), convert)));
  }
  return stored;
}

ScalarTexture::ScalarTexture() = default;

ScalarTexture::~ScalarTexture()
{
  texturesGivenBack() += this->Texture ? 1 : 0;
}

int ScalarTexture::bytesOf(vtkDataArray* scalars, int component)
{
  return fitsSixteenBits(scalars, component) && !drawsInSoftware() ? 2 : 4;
}

bool ScalarTexture::update(
  GpuTask& gpu, vtkDataArray* scalars, const ValueLayout& layout, int component, bool labels)
{
  const unsigned long long time = scalars->GetMTime();
  const bool isSame = this->Uploaded == scalars && this->UploadedTime == time &&
    this->UploadedComponent == component && this->UploadedPerTexel == layout.perTexel &&
    (this->UploadedLabels == labels || layout.isWhole());
  if (this->Texture && isSame)
  {
    return true;
  }
  if (isSame && !this->Refusal.empty() && this->RefusedAt == texturesGivenBack())
  {
    return gpu.refuse(this->Refusal); // an allocation of gigabytes takes seconds to fail
  }
  this->Texture = nullptr;
  this->Refusal.clear();
  this->Uploaded = scalars;
  this->UploadedTime = time;
  this->UploadedComponent = component;
  this->UploadedPerTexel = layout.perTexel;
  this->UploadedLabels = labels;
  this->Refusal = textureProblem(gpu.window, layout.dimensions);
  if (this->Refusal.empty() && !this->upload(gpu, { scalars, layout, component, labels }))
  {
    this->Refusal = refusedTexture(layout.dimensions);
  }
  if (!this->Refusal.empty())
  {
    this->Texture = nullptr;
    this->RefusedAt = texturesGivenBack();
    return gpu.refuse(this->Refusal);
  }
  return true;
}

bool ScalarTexture::upload(GpuTask& gpu, const ScalarSource& source)
{
  this->Texture = vtkSmartPointer<vtkTextureObject>::New();
  this->Texture->SetContext(gpu.window);
  this->Texture->SetMinificationFilter(vtkTextureObject::Linear);
  this->Texture->SetMagnificationFilter(vtkTextureObject::Linear);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapR(vtkTextureObject::ClampToEdge);
  return fitsSixteenBits(source.scalars, source.component)
    ? this->uploadSixteenBits(source, gpu.counters)
    : this->uploadFloats(source, gpu.counters);
}

bool ScalarTexture::uploadFloats(const ScalarSource& source, Counters& counters)
{
  vtkDataArray* scalars = source.scalars;
  const glm::ivec3& dimensions = source.layout.dimensions;
  this->Scale = 1.0;
  this->Shift = 0.0;
  this->Texture->SetInternalFormat(GL_R32F);
  if (scalars->GetDataType() == VTK_FLOAT && isStoredAsItIs(source))
  {
    return this->create(
      static_cast<float*>(scalars->GetVoidPointer(0)), VTK_FLOAT, 1.0f, dimensions, counters);
  }
  const auto converted = convertAll<float>(source, Floats());
  return this->create(converted.get(), VTK_FLOAT, 1.0f, dimensions, counters);
}

// Drivers in software read floats 40 % faster, since processors gather those with one instruction.
bool ScalarTexture::uploadSixteenBits(const ScalarSource& source, Counters& counters)
{
  vtkDataArray* scalars = source.scalars;
  const glm::ivec3& dimensions = source.layout.dimensions;
  const SixteenBits convert(scalars);
  this->Scale = convert.scale();
  this->Shift = convert.shift();
  this->Texture->SetInternalFormat(drawsInSoftware() ? GL_R32F : GL_R16);
  if (scalars->GetDataType() == VTK_UNSIGNED_SHORT && isStoredAsItIs(source))
  {
    return this->create(static_cast<std::uint16_t*>(scalars->GetVoidPointer(0)), VTK_UNSIGNED_SHORT,
      ShaderFromSixteenBits, dimensions, counters);
  }
  const auto converted = convertAll<std::uint16_t>(source, convert);
  return this->create(
    converted.get(), VTK_UNSIGNED_SHORT, ShaderFromSixteenBits, dimensions, counters);
}

StoredNumbers ScalarTexture::storedNumbers(
  vtkDataArray* scalars, const glm::ivec3& size, int component)
{
  const ValueLayout layout = layoutOf(size, false);
  const ScalarSource source{ scalars, layout, component, false };
  const std::size_t count = static_cast<std::size_t>(size.x) * size.y * size.z;
  StoredNumbers numbers;
  if (fitsSixteenBits(scalars, component))
  {
    const auto converted = convertAll<std::uint16_t>(source, SixteenBits(scalars));
    numbers.sixteenBits.assign(converted.get(), converted.get() + count);
  }
  else
  {
    const auto converted = convertAll<float>(source, Floats());
    numbers.floats.assign(converted.get(), converted.get() + count);
  }
  return numbers;
}

bool ScalarTexture::widenRanges(
  const glm::ivec3& first, const BrickRanges& others, const VisibleValues& visible)
{
  const auto isVisible = [&](
                           const glm::vec2& range) { return range.x <= range.y && visible(range); };
  bool appears = false;
  const glm::ivec3& count = this->Ranges.count;
  std::size_t next = 0;
  forEachIndex(first, first + others.count - 1, [&](const glm::ivec3& brick) {
    const glm::vec2& other = others.ranges[next++];
    glm::vec2& range =
      this->Ranges
        .ranges[(static_cast<std::size_t>(brick.z) * count.y + brick.y) * count.x + brick.x];
    const glm::vec2 wider(std::min(range.x, other.x), std::max(range.y, other.y));
    appears = appears || (wider != range && isVisible(wider) && !isVisible(range));
    range = wider;
  });
  return appears;
}

template <typename Stored>
bool ScalarTexture::create(Stored* stored, int type, float shaderFromStored,
  const glm::ivec3& dimensions, Counters& counters)
{
  this->Ranges = brickRanges(stored, dimensions, shaderFromStored);
  const glm::vec2 whole = this->Ranges.whole();
  const float range = whole.y - whole.x;
  this->Range = range > 0.0f && std::isfinite(range) ? range : 0.0f;
  this->Difference = usualDifference(this->Ranges);
  counters.volumeUploads += 1;
  counters.bytesUploaded +=
    static_cast<std::int64_t>(sizeof(Stored)) * dimensions.x * dimensions.y * dimensions.z;
  return this->Texture->Create3DFromRaw(dimensions.x, dimensions.y, dimensions.z, 1, type, stored);
}

void ScalarTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
    texturesGivenBack() += 1;
  }
  this->Texture = nullptr;
  this->Uploaded = nullptr;
}
}
