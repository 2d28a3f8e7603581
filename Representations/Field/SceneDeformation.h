// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The deformation that a drawn volume carries: read when it changed, kept on the GPU of each
/// window.
#ifndef BrainShift_SceneDeformation_h
#define BrainShift_SceneDeformation_h

#include "Filters/Attached/DeformableVolume.h"
#include "Representations/Field/FieldTexture.h"
#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Scene/RayCastScene.h"
#include "Representations/Scene/SceneGeometry.h"

#include "vtkOpenGLRenderTimer.h"

class vtkImageData;
class vtkWindow;

namespace brainshift
{
struct GpuTask;

/// The deformation as all windows share it.
struct SceneDeformation
{
  bool deformed = false;         ///< Else all tissue stays.
  Lattice lattice;               ///< With Strength applied (effectiveLattice).
  std::vector<float> deviations; ///< See Deformation.
  FieldRequest request;
  SlabHull moved; ///< Where tissue may have moved, lattice coordinates.

  /// Reads the deformation of the image if it changed. False, with one sentence in `problem`, if it
  /// cannot: `deformed` is then false. It does not try again before the deformation changes.
  bool update(vtkImageData* image, std::string& problem);

  /// Reads the deformation of the image if it changed, or tries again what failed. Throws a Problem
  /// if it cannot.
  void require(vtkImageData* image);

  /// The exact maps of the lattice, made when they are first asked for.
  const PointMap& map();

  /// Widens bounds (mm; x, y, z, least and greatest each) by where tissue can go.
  void widen(double bounds[6]) const;

  /// Adds what the deformation takes of the GPU's memory.
  void addSizes(DrawnSizes& sizes) const;

  unsigned long long time = 0; ///< Of what was read.

private:
  void read(vtkImageData* image);

  std::string Problem;           // why the deformation was not read; empty: it was
  std::unique_ptr<PointMap> Map; // of the lattice; null: not asked for yet
};

/// The most that tissue may be drawn away from where the lattice puts it, mm: 0.05 mm or 0.05 of a
/// voxel's shortest side, whichever is larger. `spacing`: of the voxels, mm.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT double allowedMissMm(const glm::dvec3& spacing);

/// The offset field of one window.
class DeviceDeformation
{
public:
  /// What an update changed.
  struct Change
  {
    IndexBox computed;       ///< Nodes that were computed anew.
    FieldTexture::Bent bent; ///< Where the field has other values.
  };

  /// Computes the field if it changed, and fills the scene's field. In a still picture the field is
  /// exact to what allowedMissMm says. While the picture moves, what changed is trilinear between
  /// nodes. False, with a problem, if this GPU cannot.
  bool update(GpuTask& gpu, SceneDeformation& deformation, const DrawnValues& values,
    SceneField& field, Change& change);

  const FieldTexture& field() const { return this->Field; }

  /// Asks for the memory of a picture. If there is too little for corrections, it leaves them out
  /// and says so. False, with a problem, if there is too little for the rest, too.
  bool askForMemory(GpuTask& gpu, GpuMemory& memory, MemoryNeed need, double limitMiB);

  /// Replaces `microseconds` by the time of the GPU's last run from control points to offset field,
  /// if that is known.
  void askTime(std::int64_t& microseconds);

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool compute(GpuTask& gpu, SceneDeformation& deformation, const glm::vec3& offsetScale);
  void correct(GpuTask& gpu, SceneDeformation& deformation, const DrawnValues& values);

  FieldTexture Field;
  vtkOpenGLRenderTimer Timer;
  // The deformation and the unit that Field shows.
  unsigned long long FieldTime = 0;
  glm::vec3 OffsetScale{ 0.0f };
  bool Corrects = true;                 // there is memory for corrections ...
  std::int64_t MostCorrectionBytes = 0; // ... which have taken so much
};
}

#endif
