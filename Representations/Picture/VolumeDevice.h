// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Everything that one window keeps of a deformed volume, and how a picture of it is made.
#ifndef BrainShift_VolumeDevice_h
#define BrainShift_VolumeDevice_h

#include "Representations/Bricks/StreamedBricks.h"
#include "Representations/Field/EvidenceTexture.h"
#include "Representations/Field/SceneDeformation.h"
#include "Representations/Picture/Picture.h"
#include "Representations/Picture/SelectionCover.h"
#include "Representations/Tissue/DeviceTissue.h"
#include "Representations/Tissue/FinestLevel.h"
#include "Representations/Tissue/ResectionTextures.h"
#include "Representations/Tissue/SceneReference.h"

#include <array>

class vtkVolumeMapper;
class vtkWindow;

namespace brainshift
{
struct GpuTask;

/// What is to be drawn.
struct VolumeRequest
{
  vtkVolumeMapper* mapper = nullptr; ///< Gives blend mode, clipping and cropping.
  TissueRequest tissue;
  SceneReference reference;
  bool showsEvidence = false;
  Resection resection;
  bool waits = false;             ///< A picture is saved: with all bricks that its rays ask for.
  double memoryLimitMiB = 0.0;    ///< 0: all that the driver gives.
  std::vector<double> part;       ///< Between these bounds (mm) of the deformed frame; empty: all.
  std::vector<double> partTissue; ///< The same, as far as the volume's tissue goes.
  glm::dvec3 wholeLow{ 0.0 }; ///< With a part: the whole volume's box, in the grid of its voxels.
  glm::dvec3 wholeHigh{ 0.0 };
  PictureWish wish; ///< Position and size are filled in by draw.
};

/// Textures, programs and images of one window.
class VolumeDevice
{
public:
  /// Draws the volume with its deformation. False, with a problem, if this GPU cannot.
  bool draw(
    GpuTask& gpu, const DrawnVolume& drawn, SceneDeformation& deformation, VolumeRequest request);

  /// Excludes all behind the tissue of the last picture from a selection, if there is a picture.
  /// False if the shader does not compile.
  bool coverSelection(GpuTask& gpu, vtkRenderer* renderer);

  CastImages& images() { return this->Picture.images(); }

  /// Bricks of a finer level.
  const StreamedBricks& bricks() const { return this->Bricks; }

  /// Adds to the counters what is held on the GPU, which may make it wait.
  void addHeldBytes(Counters& counters);

  void Release(vtkWindow* window); // named as WindowDevices wants it

private:
  bool askForMemory(GpuTask& gpu, const SceneDeformation& deformation, VolumeRequest& request);
  bool drawTissue(GpuTask& gpu, const DrawnVolume& drawn, SceneDeformation& deformation,
    const VolumeRequest& request);
  bool castTissue(GpuTask& gpu, const DrawnVolume& drawn, SceneDeformation& deformation,
    const VolumeRequest& request);
  void askForBricks(
    const GpuTask& gpu, const DrawnVolume& drawn, const PictureWish& wish, RayCastScene& scene);
  bool uploadVolume(GpuTask& gpu, const DrawnVolume& drawn, SceneDeformation& deformation,
    const VolumeRequest& request, RayCastScene& scene);
  TissueRequest planBricks(
    GpuTask& gpu, const DrawnVolume& drawn, const VolumeRequest& request, const MemoryNeed& need);
  bool uploadReference(
    GpuTask& gpu, const DrawnVolume& drawn, const VolumeRequest& request, RayCastScene& scene);
  void compare(GpuTask& gpu, const DrawnVolume& drawn, const VolumeRequest& request,
    RayCastScene& scene, RayCastScene& alone);
  void leaveOutReference(GpuTask& gpu);

  DeviceTissue Tissue;
  DeviceReference Reference;
  DeviceDeformation Deformation;
  EvidenceTexture Evidence;
  ResectionTextures Resected;
  brainshift::Picture Picture;
  SelectionCover Cover;
  GpuMemory Memory;
  FinestLevel Level;
  StreamedBricks Bricks;
  std::array<ViewStamp, 2> Views; // of each eye, for the bricks
};
}

#endif
