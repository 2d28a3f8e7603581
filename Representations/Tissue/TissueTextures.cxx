// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/TissueTextures.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkVolumeProperty.h"

#include <cmath>

namespace brainshift
{
namespace
{
constexpr double CutWeight = 4.0; // chosen by eye: less leaves noise, more flattens the cortex

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

// mm. How far apart VTK's mapper takes samples of a picture that does not move: half the mean voxel
// side, and less in small volumes. Opacities of a 2D transfer function are for such a step.
double stockStepOn(const Grid& grid, const glm::ivec3& points)
{
  const glm::dvec3 cells(points - 1);
  const double side = std::pow(cells.x * cells.y * cells.z, 0.333);
  const double fraction = side < 100.0 ? 0.01 + 0.99 * side / 100.0 : 1.0;
  return fraction * (grid.spacing.x + grid.spacing.y + grid.spacing.z) / 6.0;
}

double opacityStepOf(const TissueRequest& request)
{
  return request.opacity == Opacity::Table ? stockStepOn(request.values.grid, request.wholePoints)
                                           : request.stepMm;
}

// Texels a side that a texture of the whole volume would have.
glm::ivec3 wholeTexels(const TissueRequest& request)
{
  const ValueLayout& layout = request.values.layout;
  const glm::ivec3 beyond = request.wholePoints - request.values.grid.dimensions;
  return layout.dimensions + (beyond + layout.perTexel - 1) / layout.perTexel;
}

// Nearest: voxels are drawn as they are. Else neighbours are blended.
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

bool TissueTextures::update(GpuTask& gpu, const TissueRequest& request, SceneTissue& tissue)
{
  return CategoryScalars::areWanted(request.property)
    ? this->updateMapped(gpu, this->withCategories(gpu, request), tissue)
    : this->updateMapped(gpu, request, tissue);
}

// Categories take the place of the values where the colour map asks for them and can be drawn so.
TissueRequest TissueTextures::withCategories(GpuTask& gpu, const TissueRequest& request)
{
  TissueRequest drawn = request;
  vtkDataArray* scalars = request.values.scalars;
  const DrawnComponents components = drawnComponents(request.property, scalars);
  const bool isLength = components.scalar < 0;
  const bool needsValues = request.blend == Blend::Isosurface || request.blend == Blend::Average ||
    request.blend == Blend::Additive;
  if (components.coloring != Coloring::Mapped)
  {
    return drawn; // the colours are the voxels' own
  }
  const char* reason = request.compared ? "a reference is drawn with the volume"
    : needsValues ? "blend modes Isosurface, Average and Additive need continuous values"
    : isLength    ? "the array's magnitude is drawn"
    : this->Categories.update(scalars, components.scalar, request.property)
    ? nullptr
    : "it has more than 4095 annotations, the most that can be drawn";
  if (reason)
  {
    gpu.remarks.push_back(std::string("Interpret Values As Categories is on, but ") + reason +
      ": the colour map is used as a continuous one");
    return drawn;
  }
  drawn.values.scalars = this->Categories.numbers();
  drawn.property = this->Categories.property();
  drawn.nearest = true;
  drawn.labels = true;
  drawn.opacity = Opacity::Scalar;
  return drawn;
}

bool TissueTextures::updateMapped(GpuTask& gpu, const TissueRequest& request, SceneTissue& tissue)
{
  tissue = SceneTissue();
  const auto uploads = gpu.counters.volumeUploads;
  vtkDataArray* scalars = request.values.scalars;
  const DrawnComponents drawn = drawnComponents(request.property, scalars);
  tissue.blend = request.blend;
  tissue.coloring.source = drawn.coloring;
  tissue.stepMm = request.stepMm;
  if (!this->Scalars.update(gpu, scalars, request.values.layout, drawn.scalar, request.labels))
  {
    return false;
  }
  if (!this->Steepness.update(gpu, request.property, request.opacity, request.range))
  {
    return gpu.fail("The GPU refused a texture for the 2D transfer function or gradient opacity");
  }
  const bool newColours = this->updateTransfer(gpu, request, drawn.coloring);
  this->noteVisibility(request, newColours || uploads != gpu.counters.volumeUploads);
  if (!this->updateColors(gpu, request, tissue.coloring) ||
    !this->updateSegment(gpu, request, tissue) || !this->updateGradients(gpu, request, tissue))
  {
    return false;
  }
  tissue.scalars = this->Scalars.texture();
  for (vtkTextureObject* voxels :
    { tissue.scalars, tissue.coloring.colors, tissue.coloring.scalars })
  {
    setFilter(voxels, request.nearest);
  }
  setFilter(tissue.normals, request.nearest && request.gradients == GradientSource::FullResolution);
  this->describe(request, tissue);
  return true;
}

// The colour map, or what a 2D transfer function makes visible.
bool TissueTextures::updateTransfer(GpuTask& gpu, const TissueRequest& request, Coloring coloring)
{
  return request.opacity == Opacity::Table
    ? this->Transfer.update(gpu, this->Steepness.columns(), request.stepMm / opacityStepOf(request))
    : this->Transfer.update(gpu, request.property, request.stepMm, request.blend, coloring);
}

// Remembers which scalars can be seen, and whether that changed.
void TissueTextures::noteVisibility(const TissueRequest& request, bool uploaded)
{
  const std::vector<double> isovalues = isovaluesOf(request.property);
  const StoredScalar stored =
    mappedFurther({ this->Scalars.scale(), this->Scalars.shift() }, request.mapped);
  this->VisibilityChanged = this->VisibilityChanged || uploaded ||
    stored.scale != this->Stored.scale || stored.shift != this->Stored.shift ||
    (request.blend == Blend::Isosurface && isovalues != this->VisibleIsovalues);
  this->Stored = stored;
  this->VisibleBlend = request.blend;
  this->VisibleIsovalues = isovalues;
}

// The figures of the scene beside the textures of voxels.
void TissueTextures::describe(const TissueRequest& request, SceneTissue& tissue) const
{
  const ValueLayout& layout = request.values.layout;
  tissue.transfer = this->Transfer.texture();
  // Voxels that are drawn as they are leave nothing between two of them to take an average of.
  tissue.transferSums = request.nearest ? nullptr : this->Transfer.sums();
  tissue.largestOpacity = this->Transfer.largestOpacity();
  tissue.transferFromScalar = transferFromStored(this->Transfer, this->Stored);
  tissue.visibleScalars =
    this->Transfer.visibleValues(this->Stored.scale, this->Stored.shift).ends();
  tissue.voxel = 1.0 / glm::dvec3(layout.dimensions);
  tissue.volumeLow = layout.low;
  tissue.volumeHigh = layout.high;
  // Light at the segment's edge: how much the gradients, as they are read, would change if the
  // scalars fell there to the least that is visible.
  const double mapStart = -tissue.transferFromScalar.y / tissue.transferFromScalar.x;
  const double least = std::max<double>(tissue.visibleScalars.x, mapStart);
  const double scale = CutWeight * (tissue.normals ? this->Normals.scale() : 1.0);
  tissue.segment.cutGradient = { scale, -scale * least };
  tissue.segment.voxel = tissue.voxel;
  tissue.steepness = this->steepnessFor(request);
}

// VTK takes differences over N / (N - 1) voxels, N along that axis, as if these were one. Texels of
// several voxels give the steepness that the voxels would have.
SceneSteepness TissueTextures::steepnessFor(const TissueRequest& request) const
{
  SceneSteepness steepness;
  steepness.opacity = request.opacity;
  steepness.entries = this->Steepness.texture();
  steepness.stepMm = opacityStepOf(request);
  const glm::dvec3& side = request.values.grid.spacing;
  const double width = request.range.y > request.range.x ? request.range.y - request.range.x : 1.0;
  const ValueLayout& layout = request.values.layout;
  const glm::ivec3 whole = wholeTexels(request);
  steepness.step =
    glm::dvec3(whole) / glm::dvec3(layout.dimensions) / glm::dvec3(glm::max(whole - 1, 1));
  steepness.fromGradient = steepness.step / glm::dvec3(layout.perTexel) *
    (side.x + side.y + side.z) / (3.0 * side) * this->Stored.scale / (SteepestFraction * width);
  const glm::dvec2 entry = this->Steepness.entryFromFraction();
  steepness.entryFromScalar = { this->Stored.scale / width * entry.x,
    (this->Stored.shift - request.range.x) / width * entry.x + entry.y };
  steepness.entryFromSteepness = this->Steepness.entryFromSteepness();
  return steepness;
}

// Colours that do not come from the drawn scalar.
bool TissueTextures::updateColors(
  GpuTask& gpu, const TissueRequest& request, SceneColoring& coloring)
{
  vtkDataArray* scalars = request.values.scalars;
  const ValueLayout& layout = request.values.layout;
  if (coloring.source == Coloring::Direct)
  {
    if (!this->Colors.update(gpu.window, scalars, layout, gpu.counters))
    {
      return gpu.refuse("The GPU refused a 3D texture for the volume's own colours");
    }
    coloring.colors = this->Colors.texture();
  }
  else if (coloring.source == Coloring::OtherScalar)
  {
    if (!this->ColorScalars.update(gpu, scalars, layout, 0, request.labels))
    {
      return false;
    }
    coloring.scalars = this->ColorScalars.texture();
    coloring.transferFromScalar = transferFromStored(
      this->Transfer, { this->ColorScalars.scale(), this->ColorScalars.shift() });
  }
  return true;
}

// The segment that alone is drawn.
bool TissueTextures::updateSegment(GpuTask& gpu, const TissueRequest& request, SceneTissue& tissue)
{
  bool changed = false;
  const Grid texels = gridOfTexels(request.values.grid, request.values.layout);
  if (!this->Segment.update(gpu, request.segment, texels, changed))
  {
    return gpu.refuse("The GPU refused a 3D texture for the segment that is drawn alone");
  }
  this->VisibilityChanged = this->VisibilityChanged || changed;
  tissue.segment.fractions = this->Segment.texture();
  return true;
}

// Light, and gradients in a texture if the user wants them there.
bool TissueTextures::updateGradients(
  GpuTask& gpu, const TissueRequest& request, SceneTissue& tissue)
{
  vtkVolumeProperty* property = request.property;
  tissue.shaded = property->GetShade() != 0 && isLit(request.blend);
  tissue.material = glm::dvec4(property->GetAmbient(), property->GetDiffuse(),
    property->GetSpecular(), property->GetSpecularPower());
  // Gradients that opacities need serve light, too.
  if (!tissue.shaded || request.gradients == GradientSource::OnTheFly ||
    request.opacity != Opacity::Scalar)
  {
    return true;
  }
  vtkTextureObject* scalars = this->Scalars.texture();
  setFilter(scalars, false); // half resolution blends neighbours
  const bool half = request.gradients == GradientSource::HalfResolution;
  if (!this->Normals.update(
        gpu, scalars, request.values.layout.dimensions, half, this->Scalars.difference()))
  {
    return false;
  }
  tissue.normals = this->Normals.texture();
  return true;
}

// Most bricks that finer voxels widen could be seen before.
void TissueTextures::widenRanges(const glm::ivec3& first, const BrickRanges& others)
{
  const VisibleValues mapped = this->Transfer.visibleValues(this->Stored.scale, this->Stored.shift);
  const bool isMapped = this->VisibleBlend != Blend::Isosurface && !this->Segment.texture();
  const bool appears = this->Scalars.widenRanges(first, others, mapped);
  this->VisibilityChanged = this->VisibilityChanged || appears || !isMapped;
}

std::vector<float> TissueTextures::summedVisibility() const
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
  // A crossing is between two samples. The segment may hold both samples but not the crossing, so
  // its bricks are not tested. The filter's rounding may find a surface where no voxel reaches the
  // isovalue.
  const double rounding = 1e-5 * this->Scalars.range();
  const auto visible = [&](const glm::vec2& range) {
    return std::any_of(surfaces.begin(), surfaces.end(),
      [&](double stored) { return stored >= range.x - rounding && stored <= range.y + rounding; });
  };
  return brainshift::summedVisibility(this->Scalars.ranges(), visible);
}

std::vector<vtkTextureObject*> TissueTextures::otherTextures() const
{
  return { this->ColorScalars.texture(), this->Colors.texture(), this->Transfer.texture(),
    this->Transfer.sums(), this->Normals.texture(), this->Segment.texture(),
    this->Steepness.texture() };
}

bool TissueTextures::skippingIsExact(Blend blend) const
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

void TissueTextures::releaseGraphicsResources(vtkWindow* window)
{
  this->Scalars.releaseGraphicsResources(window);
  this->ColorScalars.releaseGraphicsResources(window);
  this->Colors.releaseGraphicsResources(window);
  this->Transfer.releaseGraphicsResources(window);
  this->Steepness.releaseGraphicsResources(window);
  this->Normals.releaseGraphicsResources(window);
  this->Segment.releaseGraphicsResources(window);
}

void addTissueSizes(const TissueRequest& request, DrawnSizes& sizes)
{
  constexpr int DirectColorBytes = 4;
  vtkDataArray* scalars = request.values.scalars;
  const DrawnComponents drawn = drawnComponents(request.property, scalars);
  sizes.voxels = request.values.layout.dimensions;
  sizes.scalarBytes = ScalarTexture::bytesOf(scalars, drawn.scalar);
  sizes.colorBytes = drawn.coloring == Coloring::Direct ? DirectColorBytes
    : drawn.coloring == Coloring::OtherScalar           ? ScalarTexture::bytesOf(scalars, 0)
                                                        : 0;
  sizes.gradients = request.property->GetShade() != 0 && isLit(request.blend) &&
    request.gradients != GradientSource::OnTheFly && request.opacity == Opacity::Scalar;
  sizes.segmentBytes = request.segment.segmentation.labels ? SegmentTexture::bytesOfVoxel() : 0;
  sizes.halfResolution = request.gradients == GradientSource::HalfResolution;
}
}
