// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/Tissue.h"

#include "Representations/Picture/RayCaster.h"
#include "Representations/Skipping/RestPresence.h"

#include "vtkDataArray.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"
#include "vtkVolumeProperty.h"

#include <glm/vec2.hpp>

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr double CutWeight = 4.0; // from pictures: less leaves noise, more flattens the cortex

// The blend modes that VTK lights.
bool isLit(Blend blend)
{
  return blend == Blend::Composite || blend == Blend::Isosurface || blend == Blend::Slice;
}

// Texture coordinate of the colour map from a stored scalar: scale and shift.
glm::dvec2 transferFromStored(const TransferTexture& transfer, const StoredScalar& stored)
{
  return { stored.scale * transfer.scale(), stored.shift * transfer.scale() + transfer.shift() };
}

// Voxels as they are, or blended.
void setFilter(vtkTextureObject* texture, bool nearest)
{
  if (texture)
  {
    const int filter = nearest ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
    texture->SetMinificationFilter(filter);
    texture->SetMagnificationFilter(filter);
  }
}
}

bool Tissue::update(vtkOpenGLRenderWindow* window, const TissueRequest& request,
  RayCastScene& scene, Counters& counters, std::string& problem)
{
  const auto uploads = counters.volumeUploads;
  const ShownComponents shown = shownComponents(request.property, request.scalars);
  scene.options.blend = request.blend;
  scene.options.coloring = shown.coloring;
  scene.stepMm = request.stepMm;
  if (!this->Scalars.update(
        window, request.scalars, request.layout.dimensions, shown.scalar, counters, problem))
  {
    return false;
  }
  const bool newColours = this->Transfer.update(
    window, request.property, request.stepMm, request.blend, shown.coloring, counters);
  const std::vector<double> isovalues = isovaluesOf(request.property);
  const StoredScalar stored =
    mappedFurther({ this->Scalars.scale(), this->Scalars.shift() }, request.mapped);
  this->VisibilityChanged = this->VisibilityChanged || newColours ||
    uploads != counters.volumeUploads || stored.scale != this->Stored.scale ||
    stored.shift != this->Stored.shift ||
    (request.blend == Blend::Isosurface && isovalues != this->VisibleIsovalues);
  this->Stored = stored;
  this->VisibleBlend = request.blend;
  this->VisibleIsovalues = isovalues;
  if (!this->updateColors(window, request, scene, counters, problem) ||
    !this->updateSegment(window, request, scene, counters, problem) ||
    !this->updateGradients(window, request, scene, counters, problem))
  {
    return false;
  }
  scene.scalars = this->Scalars.texture();
  for (vtkTextureObject* voxels :
    { scene.scalars, scene.options.colors, scene.options.colorScalars })
  {
    setFilter(voxels, request.nearest);
  }
  setFilter(scene.normals, request.nearest && request.gradients == GradientSource::FullResolution);
  scene.transfer = this->Transfer.texture();
  // Between two voxels that are shown as they are there is nothing to take an average of.
  scene.transferSums = request.nearest ? nullptr : this->Transfer.sums();
  scene.opaqueTissue = this->Transfer.isOpaque();
  scene.transferFromScalar = transferFromStored(this->Transfer, this->Stored);
  scene.visibleScalars = this->Transfer.visibleValues(stored.scale, stored.shift).ends();
  scene.voxel = request.layout.textureFromGrid;
  this->describeCut(request, scene);
  scene.volumeLow = request.layout.low;
  scene.volumeHigh = request.layout.high;
  return true;
}

// Colours that do not come from the drawn scalar.
bool Tissue::updateColors(vtkOpenGLRenderWindow* window, const TissueRequest& request,
  RayCastScene& scene, Counters& counters, std::string& problem)
{
  RayCastOptions& options = scene.options;
  const glm::ivec3& dimensions = request.layout.dimensions;
  if (options.coloring == Coloring::Direct)
  {
    if (!this->Colors.update(window, request.scalars, dimensions, counters))
    {
      problem = "The GPU refused a 3D texture for the volume's own colours";
      return false;
    }
    options.colors = this->Colors.texture();
  }
  else if (options.coloring == Coloring::OtherScalar)
  {
    if (!this->ColorScalars.update(window, request.scalars, dimensions, 0, counters, problem))
    {
      return false;
    }
    options.colorScalars = this->ColorScalars.texture();
    options.transferFromColorScalar = transferFromStored(
      this->Transfer, { this->ColorScalars.scale(), this->ColorScalars.shift() });
  }
  return true;
}

// What keeps all but one segment from being drawn.
bool Tissue::updateSegment(vtkOpenGLRenderWindow* window, const TissueRequest& request,
  RayCastScene& scene, Counters& counters, std::string& problem)
{
  bool changed = false;
  if (!this->Segment.update(window, request.segment, counters, changed))
  {
    problem = "The GPU refused a 3D texture for the segment that is drawn alone";
    return false;
  }
  this->VisibilityChanged = this->VisibilityChanged || changed;
  scene.options.segment = this->Segment.texture();
  return true;
}

// Light, and gradients in a texture where it wants them there.
bool Tissue::updateGradients(vtkOpenGLRenderWindow* window, const TissueRequest& request,
  RayCastScene& scene, Counters& counters, std::string& problem)
{
  vtkVolumeProperty* property = request.property;
  scene.shaded = property->GetShade() != 0 && isLit(request.blend);
  scene.material = glm::dvec4(property->GetAmbient(), property->GetDiffuse(),
    property->GetSpecular(), property->GetSpecularPower());
  if (!scene.shaded || request.gradients == GradientSource::OnTheFly)
  {
    return true;
  }
  setFilter(this->Scalars.texture(), false); // half resolution blends neighbours
  if (!this->Normals.update(window, this->Scalars.texture(), request.layout.dimensions,
        request.gradients == GradientSource::HalfResolution, this->Scalars.difference(), counters))
  {
    problem = "The gradients' shader does not compile or their texture cannot be made on this GPU";
    return false;
  }
  scene.normals = this->Normals.texture();
  return true;
}

// What light needs to know of the segment's edge: how much the scalars' gradients, as they are
// read, would change if the scalars fell there to the least that is visible.
void Tissue::describeCut(const TissueRequest& request, RayCastScene& scene)
{
  const double mapStart = -scene.transferFromScalar.y / scene.transferFromScalar.x;
  const double least = std::max<double>(scene.visibleScalars.x, mapStart);
  const double scale = CutWeight * (scene.normals ? this->Normals.scale() : 1.0);
  scene.options.cutGradient = { scale, -scale * least };
  scene.options.segmentVoxel = request.layout.textureFromGrid;
}

std::vector<float> Tissue::summedVisibility() const
{
  const VisibleValues mapped = this->Transfer.visibleValues(this->Stored.scale, this->Stored.shift);
  if (this->VisibleBlend != Blend::Isosurface)
  {
    return this->Segment.texture()
      ? brainshift::summedVisibility(this->Segment.within(this->Scalars.ranges()), mapped)
      : brainshift::summedVisibility(this->Scalars.ranges(), mapped);
  }
  std::vector<double> surfaces; // visible isovalues, as stored
  for (const double isovalue : this->VisibleIsovalues)
  {
    const double stored = (isovalue - this->Stored.shift) / this->Stored.scale;
    if (mapped(glm::vec2(stored)))
    {
      surfaces.push_back(stored);
    }
  }
  // A crossing lies between two samples, of which the segment may hold both but not the crossing:
  // so its bricks are not asked. The filter's rounding may find a surface where no voxel reaches
  // its value.
  const double rounding = 1e-5 * this->Scalars.range();
  const auto visible = [&](const glm::vec2& range) {
    return std::any_of(surfaces.begin(), surfaces.end(),
      [&](double stored) { return stored >= range.x - rounding && stored <= range.y + rounding; });
  };
  return brainshift::summedVisibility(this->Scalars.ranges(), visible);
}

std::vector<vtkTextureObject*> Tissue::otherTextures() const
{
  return { this->ColorScalars.texture(), this->Colors.texture(), this->Transfer.texture(),
    this->Transfer.sums(), this->Normals.texture(), this->Segment.texture() };
}

bool Tissue::skippingIsExact(Blend blend) const
{
  switch (blend)
  {
    case Blend::Composite:
    case Blend::Isosurface:
      return true;
    case Blend::Maximum:
      return this->Transfer.visibleUpwards(); // what is skipped is less than what is seen
    case Blend::Minimum:
      return this->Transfer.visibleDownwards();
    default:
      return false;
  }
}

void Tissue::releaseGraphicsResources(vtkWindow* window)
{
  this->Scalars.releaseGraphicsResources(window);
  this->ColorScalars.releaseGraphicsResources(window);
  this->Colors.releaseGraphicsResources(window);
  this->Transfer.releaseGraphicsResources(window);
  this->Normals.releaseGraphicsResources(window);
  this->Segment.releaseGraphicsResources(window);
}

void addTissueSizes(const TissueRequest& request, DrawnSizes& sizes)
{
  constexpr int DirectColorBytes = 4;
  const ShownComponents shown = shownComponents(request.property, request.scalars);
  sizes.voxels = request.layout.dimensions;
  sizes.scalarBytes = ScalarTexture::bytesOf(request.scalars, shown.scalar);
  sizes.colorBytes = shown.coloring == Coloring::Direct ? DirectColorBytes
    : shown.coloring == Coloring::OtherScalar           ? ScalarTexture::bytesOf(request.scalars, 0)
                                                        : 0;
  sizes.gradients = request.property->GetShade() != 0 && isLit(request.blend) &&
    request.gradients != GradientSource::OnTheFly;
  sizes.segmentBytes = request.segment.segmentation.labels ? SegmentTexture::bytesOfVoxel() : 0;
  sizes.halfResolution = request.gradients == GradientSource::HalfResolution;
}
}
