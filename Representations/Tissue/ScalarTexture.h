// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The scalars of a volume as a texture, and how a stored value relates to the scalar.
#ifndef BrainShift_ScalarTexture_h
#define BrainShift_ScalarTexture_h

#include "Representations/Gpu/GpuTask.h"
#include "Representations/Scene/SceneGeometry.h"
#include "Representations/Skipping/RestPresence.h"

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <memory>
#include <string>

class vtkDataArray;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
struct GpuTask;

/// What a texture of scalars is made of, see ScalarTexture::update.
struct ScalarSource
{
  vtkDataArray* scalars;
  const ValueLayout& layout;
  int component;
  bool labels;
};

/// Sixteen bits as the shader reads them.
constexpr float ShaderFromSixteenBits = 1.0f / 65535.0f;

/// Numbers as a texture of scalars stores them. One of the lists is empty.
struct StoredNumbers
{
  std::vector<std::uint16_t> sixteenBits;
  std::vector<float> floats;

  bool empty() const { return this->sixteenBits.empty() && this->floats.empty(); }
  std::int64_t bytes() const
  {
    return static_cast<std::int64_t>(2 * this->sixteenBits.size() + 4 * this->floats.size());
  }
};

/// One number of each voxel: 32-bit floats, or 16-bit integers where these hold the values exactly.
class ScalarTexture
{
public:
  ScalarTexture();
  ~ScalarTexture();

  /// Uploads the array if it changed since the last call. `component`: which number of the voxel;
  /// -1: the length of the vector. `labels`: a texel of several voxels has their most frequent
  /// number, not their mean. False, with a problem, if the GPU refuses. A refused array is tried
  /// again once it changes or another texture was given back.
  bool update(GpuTask& gpu, vtkDataArray* scalars, const ValueLayout& layout, int component,
    bool labels = false);

  /// Counts textures that were given back, in all windows: what was refused before may fit now.
  static int givenBack();

  /// The numbers of a part of a volume, `size` voxels a side, as a texture of such an array has
  /// them.
  static StoredNumbers storedNumbers(vtkDataArray* scalars, const glm::ivec3& size, int component);

  /// Lets the ranges of bricks from `first` on hold others, too. Returns whether one of them is
  /// visible now and was not before.
  bool widenRanges(
    const glm::ivec3& first, const BrickRanges& others, const VisibleValues& visible);

  /// Bytes of one value on the GPU of the current context.
  static int bytesOf(vtkDataArray* scalars, int component);

  /// Ranges of the stored values, as the shader reads them, in bricks of the rest volume.
  const BrickRanges& ranges() const { return this->Ranges; }

  /// The greatest stored value minus the least.
  float range() const { return this->Range; }

  /// The usualDifference (RestPresence.h) of the stored values.
  float difference() const { return this->Difference; }

  ///@{
  /// scalar = stored * scale + shift
  double scale() const { return this->Scale; }
  double shift() const { return this->Shift; }
  ///@}

  vtkTextureObject* texture() const { return this->Texture; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  bool upload(GpuTask& gpu, const ScalarSource& source);
  bool uploadFloats(const ScalarSource& source, Counters& counters);
  bool uploadSixteenBits(const ScalarSource& source, Counters& counters);
  template <typename Stored>
  bool create(Stored* stored, int type, float shaderFromStored, const glm::ivec3& dimensions,
    Counters& counters);
  template <typename Stored, typename Convert>
  static std::unique_ptr<Stored[]> convertAll(const ScalarSource& source, const Convert& convert);

  vtkSmartPointer<vtkTextureObject> Texture;
  vtkWeakPointer<vtkDataArray> Uploaded;
  unsigned long long UploadedTime = 0;
  int UploadedComponent = 0;
  glm::ivec3 UploadedPerTexel{ 0 };
  bool UploadedLabels = false;
  std::string Refusal; // of the same array; empty: none
  int RefusedAt = 0;   // textures that were given back before
  BrickRanges Ranges;
  float Range = 0.0f;
  float Difference = 0.0f;
  double Scale = 1.0;
  double Shift = 0.0;
};
}

#endif
