// SPDX-License-Identifier: BSD-3-Clause
// The deformation that a drawn volume carries: read when it changed, kept on the GPU of each
// window.
#ifndef BrainShift_SceneDeformation_h
#define BrainShift_SceneDeformation_h

#include "Representations/Gpu/Counters.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Representations/Field/FieldTexture.h"
#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Scene/SceneGeometry.h"

#include "vtkOpenGLRenderTimer.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>

class vtkImageData;
class vtkOpenGLRenderWindow;
class vtkWindow;

namespace brainshift
{
struct RayCastScene;

// What all windows share.
struct SceneDeformation
{
  bool deformed = false; // else all tissue stays
  Lattice lattice;       // effective
  FieldRequest request;
  SlabHull moved; // where tissue may have moved

  // Reads it if it changed. False, with one sentence in `problem`, if it is malformed: `deformed`
  // is then false.
  bool update(vtkImageData* image, std::string& problem);

  // Widens bounds (mm) by where tissue can go.
  void widen(double bounds[6]) const;

  // Adds what it takes of the GPU's memory.
  void addSizes(DrawnSizes& sizes) const;

  unsigned long long time = 0; // of what was read
};

// One window's offset field.
class DeviceDeformation
{
public:
  // Nodes of the field that an update computed anew, and where it gave other values.
  struct Change
  {
    IndexBox computed;
    FieldTexture::Bent bent;
  };
  // Makes the field current and fills in what the scene says of it. On failure returns false and
  // says why in `problem`.
  bool update(vtkOpenGLRenderWindow* window, SceneDeformation& deformation, const Grid& grid,
    const ValueLayout& layout, RayCastScene& scene, Change& change, Counters& counters,
    std::string& problem);

  const FieldTexture& field() const { return this->Field; }

  // Replaces `microseconds` by the GPU's last run from control points to offset field, if known.
  void askTime(std::int64_t& microseconds);

  void releaseGraphicsResources(vtkWindow* window);

private:
  FieldTexture Field;
  vtkOpenGLRenderTimer Timer;
  // The deformation and the unit that Field shows.
  unsigned long long FieldTime = 0;
  glm::vec3 OffsetScale{ 0.0f };
};
}

#endif
