// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// ParaView's colour map and opacity curve as one texture, with opacities for the step.
#ifndef BrainShift_TransferTexture_h
#define BrainShift_TransferTexture_h

#include "Representations/Gpu/GpuTask.h"
#include "Representations/Gpu/ShaderSource.h"
#include "Representations/Scene/SceneGeometry.h"
#include "Representations/Skipping/RestPresence.h"

#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

class vtkDataArray;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkVolumeProperty;
class vtkWindow;

namespace brainshift
{
// Colours that a volume brings along: the first three of four numbers of each voxel.

/// The colours of one volume on the GPU of one window.
class ColorTexture
{
public:
  ColorTexture();
  ~ColorTexture();

  /// Uploads the array if it changed since the last call. Whole numbers are clamped to 0 to 255,
  /// real numbers to 0 to 1. False if the GPU refuses.
  bool update(vtkOpenGLRenderWindow* window, vtkDataArray* array, const ValueLayout& layout,
    Counters& counters);

  vtkTextureObject* texture() const { return this->Texture; }
  void releaseGraphicsResources(vtkWindow* window);

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  vtkWeakPointer<vtkDataArray> Uploaded;
  unsigned long long UploadedTime = 0;
  glm::ivec3 UploadedPerTexel{ 0 };
};

struct GpuTask;
struct VisibleColumns;

/// TransferRows rows of TransferEntries colours. The opacities of the first row hold for the step
/// that was asked for, those of each further row for twice the step of the row before.
class TransferTexture
{
public:
  TransferTexture();
  ~TransferTexture();

  /// Uploads the maps if they, the unit distance, the step or a mode changed; true if it did.
  /// Opacities are those of a step if samples are blended (Composite) or added (Additive), else as
  /// given. With Coloring::Direct all entries go to the opacity curve.
  bool update(
    GpuTask& gpu, vtkVolumeProperty* property, double stepMm, Blend blend, Coloring coloring);

  /// Holds, in place of the maps, opacity 1 for each scalar that a 2D transfer function
  /// makes visible, and 0 for the others. `steps`: as many of the table's as a sample is long. True
  /// if it uploaded anything.
  bool update(GpuTask& gpu, const VisibleColumns& columns, double steps);

  ///@{
  /// Texture coordinate = scalar * scale + shift. Beyond the ends the end colours hold.
  double scale() const;
  double shift() const;
  ///@}

  /// The values that have an opacity above 0; scalar = value * scale + shift.
  VisibleValues visibleValues(double scale, double shift) const;

  /// Whether all scalars above a visible one are visible, too.
  bool visibleUpwards() const;

  /// Whether all scalars below a visible one are visible, too.
  bool visibleDownwards() const;

  /// Of one step at any value.
  float largestOpacity() const { return this->LargestOpacity; }

  vtkTextureObject* texture() const { return this->Texture; }

  /// What Shaders/Tissue/averaged.glsl takes averages from. Null unless the map rises to opaque so
  /// fast that samples a step apart miss most of the rise.
  vtkTextureObject* sums() const { return this->Sums; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  void upload(GpuTask& gpu, std::vector<float>& texels);
  void makeSums(
    vtkOpenGLRenderWindow* window, const std::vector<float>& texels, Counters& counters);

  vtkSmartPointer<vtkTextureObject> Texture;
  vtkSmartPointer<vtkTextureObject> Sums;
  unsigned long long ColorTime = 0; // of the maps as uploaded; VTK's times are unique
  unsigned long long OpacityTime = 0;
  double StepMm = 0.0;
  double UnitMm = 0.0;
  Blend Blending = Blend::Composite;
  Coloring ColorSource = Coloring::Mapped;
  unsigned long long ColumnsTime = 0; // 0: it holds the maps
  std::vector<int> VisibleBefore;     // visible entries with lower indices; one more than entries
  float LargestOpacity = 0.0f;
  double Range[2] = { 0.0, 1.0 }; // scalars of the first and the last texel
};
}

#endif
