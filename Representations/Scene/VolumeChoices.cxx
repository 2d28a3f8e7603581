// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/VolumeChoices.h"

#include "vtkColorTransferFunction.h"
#include "vtkContourValues.h"
#include "vtkDataArray.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

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

std::vector<float> partPlanesOf(const std::vector<double>& part, const glm::dmat4& worldFromTexture)
{
  std::vector<float> planes;
  if (!part.empty())
  {
    clipByBox(
      { part[0], part[2], part[4] }, { part[1], part[3], part[5] }, worldFromTexture, planes);
  }
  return planes;
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

namespace
{
glm::dvec2 storedRange(const double range[2], const StoredScalar& stored)
{
  const double largest = std::numeric_limits<float>::max();
  const glm::dvec2 values = (glm::dvec2(range[0], range[1]) - stored.shift) / stored.scale;
  return glm::clamp(values, -largest, largest);
}

vtkPlane* slicePlaneOf(vtkVolumeProperty* property)
{
  return vtkPlane::SafeDownCast(property->GetSliceFunction());
}
}

DrawnComponents drawnComponents(vtkVolumeProperty* property, vtkDataArray* scalars)
{
  const int count = scalars->GetNumberOfComponents();
  if (!property->GetIndependentComponents() && count == 4)
  {
    return { 3, Coloring::Direct };
  }
  if (!property->GetIndependentComponents() && count == 2)
  {
    return { 1, Coloring::OtherScalar };
  }
  vtkColorTransferFunction* color = property->GetRGBTransferFunction();
  const bool one = count == 1 || color->GetVectorMode() == vtkScalarsToColors::COMPONENT;
  return { count == 1 ? 0 : one ? color->GetVectorComponent() : -1, Coloring::Mapped };
}

double numberOf(vtkDataArray* scalars, vtkIdType tuple, int component)
{
  if (component >= 0)
  {
    return scalars->GetComponent(tuple, component);
  }
  double squares = 0.0;
  for (int i = 0; i < scalars->GetNumberOfComponents(); ++i)
  {
    squares += scalars->GetComponent(tuple, i) * scalars->GetComponent(tuple, i);
  }
  return std::sqrt(squares);
}

Blend blendOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property)
{
  const int mode = mapper->GetBlendMode();
  const bool known = mode >= 0 && mode < BlendCount;
  const Blend blend = known ? static_cast<Blend>(mode) : Blend::Composite;
  return blend == Blend::Slice && !slicePlaneOf(property) ? Blend::Composite : blend;
}

std::vector<double> isovaluesOf(vtkVolumeProperty* property)
{
  vtkContourValues* contours = property->GetIsoSurfaceValues();
  std::vector<double> values(
    contours->GetValues(), contours->GetValues() + contours->GetNumberOfContours());
  values.resize(std::min<std::size_t>(values.size(), MaxIsovalues));
  std::sort(values.begin(), values.end());
  return values;
}

SceneBlending blendingOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property,
  vtkDataArray* scalars, const StoredScalar& stored, const glm::dmat4& worldFromTexture)
{
  SceneBlending blending;
  const Blend blend = blendOf(mapper, property);
  if (blend == Blend::Isosurface)
  {
    for (const double value : isovaluesOf(property))
    {
      blending.isovalues.push_back(static_cast<float>((value - stored.shift) / stored.scale));
    }
  }
  else if (blend == Blend::Average || blend == Blend::Additive)
  {
    double range[2];
    scalars->GetFiniteRange(range, drawnComponents(property, scalars).scalar);
    const double width = range[1] > range[0] ? range[1] - range[0] : 1.0;
    blending.fractionFromScalar = { stored.scale / width, (stored.shift - range[0]) / width };
    blending.averagedScalars = storedRange(mapper->GetAverageIPScalarRange(), stored);
  }
  else if (blend == Blend::Slice)
  {
    blending.slicePlane = texturePlane(slicePlaneOf(property), worldFromTexture);
  }
  return blending;
}

namespace
{
bool wantsTable(vtkVolumeProperty* property)
{
  return property->GetTransferFunctionMode() == vtkVolumeProperty::TF_2D;
}

// VTK's own mappers make a function that is 1 everywhere where there was none.
bool wantsGradient(vtkVolumeProperty* property)
{
  if (wantsTable(property) || !property->HasGradientOpacity())
  {
    return false;
  }
  vtkPiecewiseFunction* factor = property->GetGradientOpacity();
  return std::strcmp(factor->GetType(), "Constant") != 0 || factor->GetValue(0.0) < 1.0;
}

// Why a 2D transfer function is not drawn; empty if it is.
std::string tableProblem(
  vtkVolumeMapper* mapper, vtkVolumeProperty* property, vtkDataArray* scalars)
{
  return blendOf(mapper, property) != Blend::Composite ? "it needs blend mode Composite"
    : drawnComponents(property, scalars).coloring != Coloring::Mapped
    ? "the array contains its own colours"
    : !property->GetTransferFunction2D() ? "the volume has no 2D transfer function"
                                         : "";
}
}

Opacity opacityOf(vtkVolumeMapper* mapper, vtkVolumeProperty* property, vtkDataArray* scalars)
{
  if (wantsTable(property))
  {
    return tableProblem(mapper, property, scalars).empty() ? Opacity::Table : Opacity::Scalar;
  }
  const bool composite = blendOf(mapper, property) == Blend::Composite;
  return wantsGradient(property) && composite ? Opacity::Gradient : Opacity::Scalar;
}

std::vector<std::string> unsupportedChoices(
  vtkVolumeMapper* mapper, vtkVolumeProperty* property, vtkDataArray* scalars)
{
  std::vector<std::string> sentences;
  const auto say = [&](bool unsupported, const std::string& sentence) {
    if (unsupported)
    {
      sentences.push_back(sentence);
    }
  };
  const int components = scalars->GetNumberOfComponents();
  const std::string problem = tableProblem(mapper, property, scalars);
  say(wantsTable(property) && !problem.empty(),
    "Use 2D Transfer Function is on, but " + problem +
      ": Deformed Volume uses the colour map and the opacity curve");
  say(wantsGradient(property) && opacityOf(mapper, property, scalars) == Opacity::Scalar,
    "Gradient opacity needs blend mode Composite: Deformed Volume uses the scalar's opacity");
  say(
    !property->GetIndependentComponents() && components != 1 && components != 2 && components != 4,
    "Colours and opacity given directly (Map Scalars off, or Multi Components Mapping) need 2 or 4 "
    "components; the array has " +
      std::to_string(components) + ": Deformed Volume uses the colour map");
  const int planes = clipPlaneCount(mapper);
  say(planes > MaxClipPlanes,
    std::to_string(planes) + " clipping planes are set; Deformed Volume cuts with the first " +
      std::to_string(MaxClipPlanes));
  const int mode = mapper->GetBlendMode();
  say(mode < 0 || mode >= BlendCount,
    "Blend mode " + std::to_string(mode) + " is not one of 0 to " + std::to_string(BlendCount - 1) +
      ": Deformed Volume composites");
  const int isovalues = property->GetIsoSurfaceValues()->GetNumberOfContours();
  say(mode == static_cast<int>(Blend::Isosurface) && isovalues > MaxIsovalues,
    std::to_string(isovalues) + " isosurface values are set; Deformed Volume shows the first " +
      std::to_string(MaxIsovalues));
  vtkImplicitFunction* slice = property->GetSliceFunction();
  say(mode == static_cast<int>(Blend::Slice) && !slicePlaneOf(property),
    std::string("Blend mode Slice needs a plane as Slice Type; there is ") +
      (slice ? slice->GetClassName() : "none") + ": Deformed Volume composites");
  return sentences;
}
}
