// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/SceneCuts.h"

#include "Representations/Gpu/ShaderSource.h"

#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkVolumeMapper.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace brainshift
{
namespace
{
std::vector<float> clipPlanesOf(vtkVolumeMapper* mapper, const glm::dmat4& worldFromTexture)
{
  std::vector<float> coefficients;
  for (int i = 0; i < std::min(clipPlaneCount(mapper), MaxClipPlanes); ++i)
  {
    const glm::dvec4 plane =
      texturePlane(mapper->GetClippingPlanes()->GetItem(i), worldFromTexture);
    for (int c = 0; c < 4; ++c)
    {
      coefficients.push_back(static_cast<float>(plane[c]));
    }
  }
  return coefficients;
}

// The box (texture coordinates) between a mapper's cropping planes, which are given in mm along the
// volume's axes.
void cropBox(vtkVolumeMapper* mapper, const DrawnValues& values, glm::dvec3& low, glm::dvec3& high)
{
  const Grid& grid = values.grid;
  const ValueLayout& layout = values.layout;
  const double* planes = mapper->GetCroppingRegionPlanes();
  const auto textureFromPlane = [&](const glm::dvec3& plane) {
    return (plane - grid.origin) / grid.spacing * layout.textureFromGrid + layout.textureOfGridZero;
  };
  low = textureFromPlane({ planes[0], planes[2], planes[4] });
  high = textureFromPlane({ planes[1], planes[3], planes[5] });
}

SceneCuts uncropped(
  vtkVolumeMapper* mapper, const glm::dmat4& worldFromTexture, const SceneField& field)
{
  SceneCuts cuts;
  cuts.clipPlanes = clipPlanesOf(mapper, worldFromTexture);
  cuts.spaceLow = field.spaceLow;
  cuts.spaceHigh = field.spaceHigh;
  return cuts;
}

// The six sides of a box as clipping planes. `otherFromTexture`: the coordinates of the box.
void clipByBox(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& otherFromTexture,
  std::vector<float>& planes)
{
  const glm::dmat4 covectors = glm::transpose(otherFromTexture);
  constexpr int numbersOfPlane = 4;
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    glm::dvec4 plane(0.0);
    plane[axis] = side % 2 ? -1.0 : 1.0;
    plane.w = side % 2 ? high[axis] : -low[axis];
    const glm::vec4 kept(covectors * plane);
    if (planes.size() < MaxClipPlanes * numbersOfPlane)
    {
      planes.insert(planes.end(), &kept[0], &kept[0] + numbersOfPlane);
    }
  }
}
}

// A plane is a covector: it transforms by the transpose.
glm::dvec4 texturePlane(vtkPlane* plane, const glm::dmat4& worldFromTexture)
{
  const double* n = plane->GetNormal();
  const double* o = plane->GetOrigin();
  return glm::transpose(worldFromTexture) *
    glm::dvec4(n[0], n[1], n[2], -(n[0] * o[0] + n[1] * o[1] + n[2] * o[2]));
}

int clipPlaneCount(vtkVolumeMapper* mapper)
{
  vtkPlaneCollection* planes = mapper->GetClippingPlanes();
  return planes ? planes->GetNumberOfItems() : 0;
}

// The middle region alone narrows the space. Each sample is compared with any other regions.
SceneCuts cutsOf(vtkVolumeMapper* mapper, const DrawnValues& values, const SceneFrame& frame,
  const SceneField& field)
{
  SceneCuts cuts = uncropped(mapper, frame.worldFromTexture, field);
  if (!mapper->GetCropping())
  {
    return cuts;
  }
  cropBox(mapper, values, cuts.regionLow, cuts.regionHigh);
  if (mapper->GetCroppingRegionFlags() == VTK_CROP_SUBVOLUME)
  {
    cuts.spaceLow = glm::max(cuts.spaceLow, cuts.regionLow);
    cuts.spaceHigh = glm::min(cuts.spaceHigh, cuts.regionHigh);
    cuts.cropLow = cuts.regionLow;
    cuts.cropHigh = cuts.regionHigh;
    return cuts;
  }
  cuts.regions = true;
  cuts.regionFlags = mapper->GetCroppingRegionFlags();
  return cuts;
}

SceneCuts cutsOfReference(vtkVolumeMapper* mapper, const RayCastScene& reference,
  const DrawnValues& volume, const glm::dmat4& worldFromVolumeTexture, bool& exact)
{
  const glm::dmat4& worldFromTexture = reference.frame.worldFromTexture;
  SceneCuts cuts = uncropped(mapper, worldFromTexture, reference.field);
  exact = !mapper->GetCropping() || mapper->GetCroppingRegionFlags() == VTK_CROP_SUBVOLUME;
  if (mapper->GetCropping() && exact)
  {
    glm::dvec3 low;
    glm::dvec3 high;
    cropBox(mapper, volume, low, high);
    clipByBox(low, high, glm::inverse(worldFromVolumeTexture) * worldFromTexture, cuts.clipPlanes);
  }
  return cuts;
}
}
