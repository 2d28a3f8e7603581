// SPDX-License-Identifier: BSD-3-Clause
// What the rays look up in the rest volume, on the GPU: scalars, colours, opacity, gradients.
#ifndef BrainShift_Tissue_h
#define BrainShift_Tissue_h

#include "Representations/Tissue/ColorTexture.h"
#include "Representations/Gpu/Counters.h"
#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Tissue/NormalTexture.h"
#include "Representations/Picture/RayCastOptions.h"
#include "Representations/Tissue/ScalarTexture.h"
#include "Representations/Scene/SceneGeometry.h"
#include "Representations/Tissue/SegmentTexture.h"
#include "Representations/Tissue/TransferTexture.h"

#include <glm/vec3.hpp>

#include <string>
#include <utility>
#include <vector>

class vtkDataArray;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkVolumeProperty;
class vtkWindow;

namespace brainshift
{
struct RayCastScene;

// Where the gradients that light needs come from; numbers as in vtkDeformedVolumeMapper.
enum class GradientSource
{
  HalfResolution = 0,
  FullResolution = 1,
  OnTheFly = 2,
};

struct TissueRequest
{
  vtkVolumeProperty* property = nullptr;
  vtkDataArray* scalars = nullptr;
  ValueLayout layout;
  double stepMm = 1.0;
  Blend blend = Blend::Composite;
  GradientSource gradients = GradientSource::FullResolution;
  bool nearest = false; // voxels as they are, not blended
  SegmentRequest segment;
  StoredScalar mapped; // value for colours and opacities: scalar * scale + shift
};

class Tissue
{
public:
  // Makes the textures current and fills in what the scene says of them. On failure returns false
  // and says why in `problem`.
  bool update(vtkOpenGLRenderWindow* window, const TissueRequest& request, RayCastScene& scene,
    Counters& counters, std::string& problem);

  // Whether updates since the last call changed which scalars can be seen, or where they are.
  bool takeVisibilityChange() { return std::exchange(this->VisibilityChanged, false); }
  const glm::ivec3& restBricks() const { return this->Scalars.ranges().count; }
  std::vector<float> summedVisibility() const; // of the rest bricks, see RestPresence.h

  // Whether samples that cannot be seen leave a picture as it is: not where they count all the
  // same.
  bool skippingIsExact(Blend blend) const;

  vtkTextureObject* scalars() const { return this->Scalars.texture(); }
  std::vector<vtkTextureObject*> otherTextures() const; // null: not in use

  const StoredScalar& stored() const { return this->Stored; }

  // A sentence if the segment that is drawn holds nothing; else empty.
  const std::string& remark() const { return this->Segment.remark(); }

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool updateColors(vtkOpenGLRenderWindow* window, const TissueRequest& request,
    RayCastScene& scene, Counters& counters, std::string& problem);
  void describeCut(const TissueRequest& request, RayCastScene& scene);
  bool updateSegment(vtkOpenGLRenderWindow* window, const TissueRequest& request,
    RayCastScene& scene, Counters& counters, std::string& problem);
  bool updateGradients(vtkOpenGLRenderWindow* window, const TissueRequest& request,
    RayCastScene& scene, Counters& counters, std::string& problem);

  ScalarTexture Scalars;
  ScalarTexture ColorScalars; // where another number of the voxel gives the colour
  ColorTexture Colors;        // where the voxel brings its colour along
  TransferTexture Transfer;
  NormalTexture Normals;
  SegmentTexture Segment;
  StoredScalar Stored; // value for colours and opacities from what Scalars holds
  Blend VisibleBlend = Blend::Composite;
  std::vector<double> VisibleIsovalues; // those that are looked for
  bool VisibilityChanged = false;
};

// Adds what the tissue takes of the GPU's memory.
void addTissueSizes(const TissueRequest& request, DrawnSizes& sizes);
}

#endif
