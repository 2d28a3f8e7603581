// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Representations/Field/TissueFacts.h"
#include "Representations/Gpu/WindowDevices.h"
#include "Representations/Picture/VolumeDevice.h"
#include "Representations/Scene/OverVolumes.h"
#include "Representations/Scene/Remarks.h"
#include "Representations/Window/RankParts.h"

#include "vtkDeformedVolumeMapper.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkSmartVolumeMapper.h"
#include "vtkTimerLog.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

class vtkSmartVolumeMapper;
class vtkVolumeMapper;

namespace brainshift
{
// VTK's software mapper, which draws a volume unbent if the GPU cannot draw it bent.

/// Gives the fallback what a mapper draws, and how.
void drawInSoftware(vtkVolumeMapper* mapper, vtkSmartVolumeMapper* fallback);

void drawInSoftware(vtkVolumeMapper* mapper, vtkSmartVolumeMapper* fallback)
{
  // What stopped our mapper would stop VTK's GPU mapper, too, in some cases by an abort.
  fallback->SetRequestedRenderModeToRayCast();
  fallback->SetInputConnection(mapper->GetInputConnection(0, 0));
  fallback->SetScalarMode(mapper->GetScalarMode());
  fallback->SelectScalarArray(mapper->GetArrayName());
  const int blend = mapper->GetBlendMode();
  const bool blends = blend == vtkVolumeMapper::MAXIMUM_INTENSITY_BLEND ||
    blend == vtkVolumeMapper::MINIMUM_INTENSITY_BLEND || blend == vtkVolumeMapper::ADDITIVE_BLEND;
  fallback->SetBlendMode(blends ? blend : vtkVolumeMapper::COMPOSITE_BLEND);
  fallback->SetCropping(mapper->GetCropping());
  fallback->SetCroppingRegionFlags(mapper->GetCroppingRegionFlags());
  fallback->SetCroppingRegionPlanes(mapper->GetCroppingRegionPlanes());
  fallback->SetClippingPlanes(mapper->GetClippingPlanes());
}
}

using namespace brainshift;

struct vtkDeformedVolumeMapper::State
{
  WindowDevices<VolumeDevice> Devices;
  Counters Count;
  SceneDeformation Deformation;  // of the input
  std::optional<DrawnPart> Part; // none: all of it

  bool TakesInput = false;
  unsigned long long SettingsTime = 0; // of the last change other than of the input

  vtkNew<vtkSmartVolumeMapper> Fallback;
  std::string Reported;       // the last problem
  std::set<std::string> Told; // remarks
};

vtkStandardNewMacro(vtkDeformedVolumeMapper);

vtkDeformedVolumeMapper::vtkDeformedVolumeMapper()
  : Internal(std::make_unique<State>())
{
}

vtkDeformedVolumeMapper::~vtkDeformedVolumeMapper() = default;

// ParaView hands over the same input anew with each stroke, which changes no setting.
void vtkDeformedVolumeMapper::SetInputConnection(int port, vtkAlgorithmOutput* input)
{
  this->Internal->TakesInput = true;
  this->Superclass::SetInputConnection(port, input);
  this->Internal->TakesInput = false;
}

void vtkDeformedVolumeMapper::Modified()
{
  this->Superclass::Modified();
  if (this->Internal && !this->Internal->TakesInput)
  {
    this->Internal->SettingsTime = this->GetMTime();
  }
}

// Reads the deformation if it changed.
void vtkDeformedVolumeMapper::UpdateDeformation(vtkImageData* image)
{
  std::string problem;
  if (!this->Internal->Deformation.update(image, problem))
  {
    vtkErrorMacro(<< problem << ". The volume is drawn undeformed.");
  }
}

double* vtkDeformedVolumeMapper::GetBounds()
{
  vtkVolumeMapper::GetBounds();
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  const std::optional<DrawnPart>& part = this->Internal->Part;
  if (image && part)
  {
    std::copy_n(part->bounds.data(), 6, this->Bounds);
  }
  else if (image)
  {
    this->UpdateDeformation(image);
    this->WidenByDeformation(image, this->Bounds);
  }
  return this->Bounds;
}

void vtkDeformedVolumeMapper::WidenByTissue(vtkImageData* image, double bounds[6])
{
  this->Internal->Deformation.require(image);
  this->WidenByDeformation(image, bounds);
}

void vtkDeformedVolumeMapper::WidenByDeformation(vtkImageData* image, double bounds[6])
{
  this->Internal->Deformation.widen(bounds);
  widenByReference(image, bounds);
}

const Lattice* vtkDeformedVolumeMapper::GetLattice(vtkImageData* image)
{
  if (!image)
  {
    return nullptr;
  }
  this->Internal->Deformation.require(image);
  const SceneDeformation& deformation = this->Internal->Deformation;
  return deformation.deformed ? &deformation.lattice : nullptr;
}

void vtkDeformedVolumeMapper::SetDrawnPart(const DrawnPart* part)
{
  std::optional<DrawnPart>& known = this->Internal->Part;
  const bool isSame = part ? known && *known == *part : !known;
  if (!isSame)
  {
    known = part ? std::optional(*part) : std::nullopt;
    this->Modified();
  }
}

const double* vtkDeformedVolumeMapper::GetTissueOfAllRanks() const
{
  const std::optional<DrawnPart>& part = this->Internal->Part;
  return part ? part->tissue.data() : nullptr;
}

void vtkDeformedVolumeMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  this->GetInputAlgorithm()->Update();
  vtkNew<vtkTimerLog> timer;
  timer->StartTimer();
  guarded(this, [&] {
    if (!renderer->GetSelector())
    {
      this->DrawAnyhow(renderer, volume);
    }
    else if (!selectsPoints(renderer))
    {
      this->CoverSelection(renderer);
    }
  });
  timer->StopTimer();
  this->TimeToDraw = timer->GetElapsedTime();
}

void vtkDeformedVolumeMapper::DrawAnyhow(vtkRenderer* renderer, vtkVolume* volume)
{
  std::string problem;
  bool drawn = false;
  const std::string thrown = thrownBy([&] { drawn = this->Draw(renderer, volume, problem); });
  if (!thrown.empty())
  {
    problem = "Deformed Volume " + thrown;
  }
  reportOnce(this, drawn ? std::string() : problem,
    "VTK's software mapper draws the volume undeformed", this->Internal->Reported);
  if (!drawn)
  {
    drawInSoftware(this, this->Internal->Fallback);
    this->Internal->Fallback->Render(renderer, volume);
  }
}

void vtkDeformedVolumeMapper::CoverSelection(vtkRenderer* renderer)
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  VolumeDevice* device = this->Internal->Devices.find(window);
  GpuTask gpu(window, this->Internal->Count);
  if (device && !device->coverSelection(gpu, renderer))
  {
    vtkErrorMacro(
      "The selection's shader does not compile. Selections include what the volume hides.");
  }
}

namespace
{
// Lets a request draw one rank's part. `held`: the voxels that this rank has.
void askForPart(const DrawnPart& part, vtkImageData* held, VolumeRequest& request)
{
  request.part.assign(part.cut.begin(), part.cut.end());
  request.partTissue.assign(part.bounds.begin(), part.bounds.end());
  const Extent& whole = part.whole.extent;
  const int* extent = held->GetExtent();
  const glm::dvec3 first(extent[0], extent[2], extent[4]);
  request.wholeLow = glm::dvec3(whole[0], whole[2], whole[4]) - first;
  request.wholeHigh = glm::dvec3(whole[1], whole[3], whole[5]) - first;
}
}

bool vtkDeformedVolumeMapper::Draw(vtkRenderer* renderer, vtkVolume* volume, std::string& problem)
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  if (!window || !image)
  {
    problem = "Deformed Volume draws image data in an OpenGL window only";
    return false;
  }
  window->MakeCurrent();
  const DrawnValues values = drawnValuesOf(this, image);
  problem = problemOf([&] { requirePosition(values.grid, "The volume's "); });
  if (!problem.empty())
  {
    return false;
  }
  if (!values.scalars)
  {
    return true; // nothing to draw yet
  }
  State& state = *this->Internal;
  this->UpdateDeformation(image);
  VolumeRequest request;
  request.mapper = this;
  request.tissue = this->TissueOf(image, volume->GetProperty(), values);
  request.reference = this->ReferenceOf(image, request.tissue);
  request.tissue.compared = request.reference.exists();
  request.reference.tissue.compared = request.tissue.compared;
  this->ComparePlainly(request);
  request.showsEvidence = this->DrawsEvidence(request.tissue.blend);
  request.resection = readResection(image);
  request.memoryLimitMiB = this->MemoryLimit;
  request.waits = this->WaitsForDetail;
  request.wish.adaptive = this->AdaptiveQuality;
  request.wish.keep = this->KeepPicture || OverVolumes::areVisibleIn(renderer);
  request.wish.countSamples = this->CountSamples;
  if (state.Part)
  {
    askForPart(*state.Part, image, request);
  }
  request.wish.occlusion = { this->OcclusionDarkness(), this->OcclusionRadiusOn(image, volume) };
  request.wish.rate = window->GetDesiredUpdateRate();
  request.wish.settingsTime = state.SettingsTime;
  GpuTask gpu(window, state.Count);
  const bool drawn =
    state.Devices.of(window).draw(gpu, { renderer, volume }, state.Deformation, request);
  for (const std::string& remark : gpu.remarks)
  {
    this->TellOnce(remark);
  }
  std::for_each(gpu.warnings.begin(), gpu.warnings.end(),
    [this](const std::string& warning) { warn(this, warning); });
  problem = gpu.problem;
  return drawn;
}

// A pixel of other blend modes shows no single place.
bool vtkDeformedVolumeMapper::DrawsEvidence(Blend blend)
{
  const bool draws =
    blend == Blend::Composite || blend == Blend::Isosurface || blend == Blend::Slice;
  if (this->ShowEvidence && !draws)
  {
    this->TellOnce(
      "Show Evidence needs blend mode Composite, Isosurface or Slice: nothing is marked");
  }
  return this->ShowEvidence && draws;
}

TissueRequest vtkDeformedVolumeMapper::TissueOf(
  vtkImageData* image, vtkVolumeProperty* property, const DrawnValues& values)
{
  for (const std::string& sentence : unsupportedChoices(this, property, values.scalars))
  {
    this->TellOnce(sentence);
  }
  TissueRequest tissue;
  tissue.property = property;
  tissue.values = values;
  tissue.wholePoints = values.grid.dimensions;
  if (const std::optional<DrawnPart>& part = this->Internal->Part)
  {
    const Extent& whole = part->whole.extent;
    tissue.wholePoints =
      glm::ivec3(whole[1], whole[3], whole[5]) - glm::ivec3(whole[0], whole[2], whole[4]) + 1;
  }
  tissue.stepMm = this->StepOn(tissue);
  tissue.usualStep = this->SampleDistance <= 0.0;
  tissue.blend = blendOf(this, property);
  tissue.opacity = opacityOf(this, property, values.scalars);
  tissue.range =
    rangeOf(this->Internal->Part, image, values, drawnComponents(property, values.scalars).scalar);
  tissue.gradients = static_cast<GradientSource>(this->NormalTexture);
  tissue.labels = isLabelMap(image);
  tissue.nearest = tissue.labels || property->GetInterpolationType() == VTK_NEAREST_INTERPOLATION;
  tissue.skips = this->EmptySpaceSkipping;
  if (this->DrawSegment)
  {
    std::string remark;
    tissue.segment = requestSegment(image, this->DrawnLabels, remark);
    this->TellOnce(remark);
  }
  return tissue;
}

// mm. MPI ranks take equal steps through parts of any size.
double vtkDeformedVolumeMapper::StepOn(const TissueRequest& tissue)
{
  const glm::dvec3& side = tissue.values.grid.spacing;
  const double asked =
    this->SampleDistance > 0.0 ? this->SampleDistance : 0.5 * std::min({ side.x, side.y, side.z });
  const double longest = glm::length(side * glm::dvec3(tissue.wholePoints));
  const double step = std::clamp(asked, longest / MostSamplesOfRay, longest);
  if (step > asked)
  {
    std::ostringstream remark;
    remark << "Sample Distance is " << asked << " mm; a ray of " << roundedText(longest)
           << " mm takes at most " << MostSamplesOfRay << " samples, so it is drawn with "
           << roundedText(step) << " mm";
    this->TellOnce(remark.str());
  }
  return step;
}

// A part does not know what tissue of others is beside it.
double vtkDeformedVolumeMapper::OcclusionDarkness()
{
  if (!this->Internal->Part || this->AmbientOcclusion <= 0.0)
  {
    return this->AmbientOcclusion;
  }
  this->TellOnce("Ambient Occlusion is off: several MPI ranks draw the volume, and none of them "
                 "sees the tissue of the others");
  return 0.0;
}

// mm, world.
double vtkDeformedVolumeMapper::OcclusionRadiusOn(vtkImageData* image, vtkVolume* volume)
{
  if (this->OcclusionRadius > 0.0)
  {
    return this->OcclusionRadius;
  }
  constexpr double usualFraction = 0.02; // of the diagonal: 8 mm for a head
  const double scale = std::cbrt(std::abs(volume->GetMatrix()->Determinant()));
  return usualFraction * scale * image->GetLength();
}

// None if the data carries no reference or it is not to be drawn.
SceneReference vtkDeformedVolumeMapper::ReferenceOf(
  vtkImageData* image, const TissueRequest& tissue)
{
  SceneReference reference =
    referenceOf(image, tissue, { this->ReferenceRange[0], this->ReferenceRange[1] });
  constexpr double usualVoxels = 2.0;
  const glm::dvec3& side = tissue.values.grid.spacing;
  reference.agreementMm = this->AgreementDistance > 0.0
    ? this->AgreementDistance
    : usualVoxels * std::min({ side.x, side.y, side.z });
  reference.colors = colorPair(static_cast<brainshift::ComparisonColors>(this->ComparisonColors));
  if (!reference.exists() || reference.show == ReferenceShow::Reference)
  {
    return reference;
  }
  const bool compared = reference.show == ReferenceShow::Both && this->Comparison != NoComparison;
  if (compared && tissue.blend != Blend::Composite)
  {
    this->TellOnce(
      "A comparison in two colours needs blend mode Composite: the volume is drawn alone");
  }
  return compared && tissue.blend == Blend::Composite ? reference : SceneReference();
}

// The two colours of a comparison have no colours of their own to look up with gradients.
void vtkDeformedVolumeMapper::ComparePlainly(VolumeRequest& request)
{
  if (!request.reference.exists() || request.reference.isAlone() ||
    request.tissue.opacity == Opacity::Scalar)
  {
    return;
  }
  this->TellOnce("A comparison shows neither gradient opacity nor a 2D transfer function: they use "
                 "the opacity curve");
  request.tissue.opacity = Opacity::Scalar;
  request.reference.tissue.opacity = Opacity::Scalar;
}

void vtkDeformedVolumeMapper::TellOnce(const std::string& sentence)
{
  tellOnce(this, sentence, this->Internal->Told);
}

bool vtkDeformedVolumeMapper::Pick(vtkRenderer* renderer, int x, int y, double position[3])
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  VolumeDevice* device = this->Internal->Devices.find(window);
  const int* size = renderer->GetSize();
  vtkDataSet* image = this->GetDataSetInput();
  if (!image || image->GetNumberOfPoints() == 0) // another MPI rank draws all of it now
  {
    return false;
  }
  if (!device || x < 0 || y < 0 || x >= size[0] || y >= size[1])
  {
    return false;
  }
  window->MakeCurrent();
  glm::dvec4 hit;
  const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / glm::dvec2(size[0], size[1]);
  if (!device->images().hitAt(window, place, hit))
  {
    return false;
  }
  std::copy_n(&hit[0], 3, position);
  return true;
}

void vtkDeformedVolumeMapper::DescribeTissue(
  vtkWindow* window, const double deformedMm[3], TissueFacts& facts)
{
  if (auto image = vtkImageData::SafeDownCast(this->GetDataSetInput()))
  {
    this->UpdateDeformation(image);
    const VolumeDevice* device = this->Internal->Devices.find(window);
    facts = factsAt(image, drawnValuesOf(this, image), this->Internal->Deformation,
      { deformedMm[0], deformedMm[1], deformedMm[2] }, [&](const glm::dvec3& place) {
        return device ? device->bricks().numberAt(window, place) : std::optional<double>();
      });
  }
}

void vtkDeformedVolumeMapper::FindSameTissue(const double place[3], bool toRest, double found[3])
{
  if (auto image = vtkImageData::SafeDownCast(this->GetDataSetInput()))
  {
    this->UpdateDeformation(image);
  }
  const glm::dvec3 same =
    sameTissue(this->Internal->Deformation, { place[0], place[1], place[2] }, toRest);
  std::copy_n(&same[0], 3, found);
}

const FirstHits* vtkDeformedVolumeMapper::GetHits(vtkWindow* window)
{
  VolumeDevice* device = this->Internal->Devices.find(window);
  return device ? device->images().drawnHits() : nullptr;
}

void vtkDeformedVolumeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Devices.release(window);
  this->Internal->Fallback->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

const Counters& vtkDeformedVolumeMapper::CountDetail()
{
  Counters& count = this->Internal->Count;
  resetDetail(count);
  this->Internal->Devices.visitAnyhow(
    [&](const VolumeDevice& device) { device.bricks().count(count); });
  return count;
}

// What the GPU holds is asked for here and not in every picture: the driver's answers may make it
// wait for the GPU.
const Counters& vtkDeformedVolumeMapper::GetCounters()
{
  Counters& count = this->Internal->Count;
  count.gpuScalarBytes = 0;
  count.gpuOtherBytes = 0;
  this->CountDetail();
  this->Internal->Devices.visit([&](VolumeDevice& device) { device.addHeldBytes(count); });
  return count;
}

void vtkDeformedVolumeMapper::AddDrawnLabel(int label)
{
  this->DrawnLabels.push_back(label);
  this->Modified();
}

void vtkDeformedVolumeMapper::ClearDrawnLabels()
{
  this->DrawnLabels.clear();
  this->Modified();
}

void vtkDeformedVolumeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SampleDistance: " << this->SampleDistance << "\n"
     << indent << "EmptySpaceSkipping: " << this->EmptySpaceSkipping << "\n"
     << indent << "AdaptiveQuality: " << this->AdaptiveQuality << "\n"
     << indent << "KeepPicture: " << this->KeepPicture << "\n"
     << indent << "WaitsForDetail: " << this->WaitsForDetail << "\n"
     << indent << "CountSamples: " << this->CountSamples << "\n"
     << indent << "DrawSegment: " << this->DrawSegment << "\n"
     << indent << "ShowEvidence: " << this->ShowEvidence << "\n"
     << indent << "DrawnLabels: " << this->DrawnLabels.size() << "\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << "\n"
     << indent << "NormalTexture: " << this->NormalTexture << "\n"
     << indent << "Comparison: " << this->Comparison << "\n"
     << indent << "ComparisonColors: " << this->ComparisonColors << "\n"
     << indent << "ReferenceRange: " << this->ReferenceRange[0] << " " << this->ReferenceRange[1]
     << "\n"
     << indent << "AgreementDistance: " << this->AgreementDistance << "\n"
     << indent << "AmbientOcclusion: " << this->AmbientOcclusion << "\n"
     << indent << "OcclusionRadius: " << this->OcclusionRadius << "\n";
}
