// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWholeVolumeRepresentation.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/ImageParts.h"
#include "Filters/Attached/BendNumbers.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Scene/Remarks.h"
#include "Representations/Window/EvidenceLegend.h"
#include "Representations/Window/RankParts.h"
#include "Representations/Window/ReferencePart.h"
#include "Representations/Workarounds/ParaViewFaults.h"

#include "vtkCommunicator.h"
#include "vtkCompositeRepresentation.h"
#include "vtkCoordinate.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkOutlineSource.h"
#include "vtkPVLODVolume.h"
#include "vtkPVRenderView.h"
#include "vtkPVSession.h"
#include "vtkPVView.h"
#include "vtkProcessModule.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"
#include "vtkTracePointsRepresentation.h"
#include "vtkVolumeMapper.h"

#include <algorithm>
#include <cmath>

brainshiftGuardRequestsMacro(vtkWholeVolumeRepresentation);

namespace
{
constexpr int LegendFontSize = 14;
constexpr brainshift::Extent NoExtent{ 0, -1, 0, -1, 0, -1 };

constexpr brainshift::Box NoBox{ 1e300, -1e300, 1e300, -1e300, 1e300, -1e300 };
constexpr const char* Kept = ". The picture stays as it was, and strokes are kept";
constexpr const char* WayOut = ". If memory lacks, start more ranks or lower RankHalo; each change "
                               "of RankHalo tries parts again";

// Calls visit for each representation that a view shows.
template <typename Visit>
void forEachShown(vtkPVRenderView* view, const Visit& visit)
{
  for (int i = 0; view && i < view->GetNumberOfRepresentations(); ++i)
  {
    vtkDataRepresentation* shown = view->GetRepresentation(i);
    if (auto composite = vtkCompositeRepresentation::SafeDownCast(shown))
    {
      shown = composite->GetActiveRepresentation();
    }
    auto data = vtkPVDataRepresentation::SafeDownCast(shown);
    if (data && data->GetVisibility())
    {
      visit(data);
    }
  }
}

double bytesOf(vtkImageData* volume)
{
  return brainshift::bytesOfPoint(volume) * static_cast<double>(volume->GetNumberOfPoints());
}

// Whether several ranks may draw: all but a process that is client and server alone.
bool mayHaveRanks()
{
  vtkProcessModule* process = vtkProcessModule::GetProcessModule();
  auto session = vtkPVSession::SafeDownCast(process ? process->GetSession() : nullptr);
  constexpr vtkTypeUInt32 Both = vtkPVSession::CLIENT | vtkPVSession::DATA_SERVER;
  return !session || (session->GetProcessRoles() & Both) != Both || brainshift::severalRanks();
}
}

struct vtkWholeVolumeRepresentation::Taken
{
  brainshift::WholeVolume whole;
  brainshift::DrawnPart part; // bounds and cut: all of its volumes' view
  vtkSmartPointer<vtkImageData> voxels;
};

vtkWholeVolumeRepresentation::vtkWholeVolumeRepresentation()
  : Shared(std::make_unique<brainshift::SharedVolume>())
  , Reference(std::make_unique<brainshift::ReferencePart>())
  , Wanted(NoExtent)
{
  this->Legend->PickableOff();
  this->Legend->UseBoundsOff();
  this->Legend->VisibilityOff();
  this->Legend->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Legend->Room = [this](const glm::dvec2& view, double point) {
    return brainshift::placeLegend(this->Legend, view, point, this->Evidence->GetVisibility() != 0);
  };
  vtkTextProperty* text = this->Legend->GetTextProperty();
  text->SetFontSize(LegendFontSize);
  text->SetBold(true);
  text->SetShadow(true); // the background may be bright
  text->SetVerticalJustification(VTK_TEXT_TOP);
  this->Evidence = vtk::TakeSmartPointer(brainshift::EvidenceLegend::New());
  this->Evidence->VisibilityOff();
  this->Evidence->Ask = [this] {
    using Shown = brainshift::EvidenceLegend::Shown;
    vtkDataSet* drawn = this->VolumeMapper->GetDataSetInput(); // null where a server draws
    return drawn && !brainshift::carriesDeviations(drawn) ? Shown::Nothing
      : this->ComparesInColors()                          ? Shown::Stripes
                                                          : Shown::Tints;
  };
}

// Another owner of the legend must not call this object.
vtkWholeVolumeRepresentation::~vtkWholeVolumeRepresentation()
{
  this->Evidence->Ask = nullptr;
  this->Legend->Room = nullptr;
}

int vtkWholeVolumeRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output)
{
  return brainshift::guarded(this, 0, [&] {
    brainshift::FailedUpdate failed(this, request);
    auto view = vtkPVRenderView::SafeDownCast(input->Get(vtkPVView::VIEW()));
    const Group group = this->GroupIn(view);
    const bool isFirst = group.front() == this;
    if (request == vtkPVView::REQUEST_UPDATE())
    {
      // First the data of this process, then that of all. The superclass finds both done and only
      // hands the data to the view.
      if (isFirst)
      {
        ChooseWhoDraws(view, group);
        ShareOut(group, input, output);
      }
    }
    else if (request == vtkPVView::REQUEST_RENDER() && isFirst)
    {
      brainshift::tellOfOtherRanks(this);
      if (AreBehind(group))
      {
        Overtake(group, input);
      }
    }
    failed.end();
    const int result = this->Superclass::ProcessViewRequest(request, input, output);
    if (result)
    {
      brainshift::deliverWithStandIns(this, request, input);
    }
    return result;
  });
}

// Whether a picture is drawn before the view brought the data of some volumes, the same on all
// ranks. Each of them comes here for every picture, with the first volume of its group.
bool vtkWholeVolumeRepresentation::AreBehind(const Group& group)
{
  const bool needsUpdate =
    std::any_of(group.begin(), group.end(), [](auto* one) { return one->GetNeedsUpdate(); });
  vtkMultiProcessController* ranks = brainshift::severalRanks();
  return ranks ? !brainshift::isTrueOnAny(ranks, !needsUpdate) : needsUpdate && mayHaveRanks();
}

// A client draws a stroke under the hand ahead of the view's update, for a far server answers each
// question of an update one round trip later. Its data comes here. Ranks keep their boxes, since
// the view has ordered the ranks by them.
void vtkWholeVolumeRepresentation::Overtake(const Group& group, vtkInformation* input)
{
  auto view = vtkPVView::SafeDownCast(input->Get(vtkPVView::VIEW()));
  vtkNew<vtkInformation> output;
  group.front()->KeepsBoxes = true; // of all volumes
  for (vtkWholeVolumeRepresentation* volume : group)
  {
    if (volume->ProcessViewRequest(vtkPVView::REQUEST_UPDATE(), input, output))
    {
      brainshift::deliverNow(volume, view);
    }
  }
  group.front()->KeepsBoxes = false;
}

long long vtkWholeVolumeRepresentation::GetVoxelBytes() const
{
  return std::llround((this->Part ? bytesOf(this->Part) : 0.0) + this->Shared->bytesReceived());
}

void vtkWholeVolumeRepresentation::SetRankHalo(double halo)
{
  halo = std::isfinite(halo) ? std::max(halo, 0.0) : 0.0;
  if (halo != this->RankHalo)
  {
    this->RankHalo = halo;
    this->Wanted = NoExtent;
    this->TriesParts = true;
    this->MarkModified();
  }
}

int vtkWholeVolumeRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int result = this->Superclass::RequestData(request, inputs, outputs);
  this->Part = vtkImageData::SafeDownCast(this->Cache);
  this->IsNew = true;
  this->WidenBounds();
  return result;
}

// Tissue may be outside the volume's own box: the camera must not cut it.
void vtkWholeVolumeRepresentation::WidenBounds()
{
  if (this->VolumeMapper->GetNumberOfInputConnections(0) > 0)
  {
    this->VolumeMapper->GetBounds(this->DataBounds);
  }
}

// The volumes of the view that are drawn bent, in the order in which they are updated. A view lists
// one that is part of a composite twice.
vtkWholeVolumeRepresentation::Group vtkWholeVolumeRepresentation::GroupIn(vtkPVRenderView* view)
{
  Group group;
  forEachShown(view, [&](vtkDataRepresentation* shown) {
    auto volume = vtkWholeVolumeRepresentation::SafeDownCast(shown);
    if (volume && std::find(group.begin(), group.end(), volume) == group.end())
    {
      group.push_back(volume);
    }
  });
  return std::find(group.begin(), group.end(), this) == group.end() ? Group{ this } : group;
}

// Why the volumes of a view cannot be drawn in parts; empty: they can. The actor's transform turns
// boxes.
std::string vtkWholeVolumeRepresentation::WhyWholeIn(vtkPVRenderView* view, const Group& group)
{
  std::string reason = view ? "" : "this view is no render view";
  forEachShown(view, [&](vtkDataRepresentation* shown) {
    if (vtkTracePointsRepresentation::SafeDownCast(shown))
    {
      reason = "Trace Points are shown beside it, and no rank knows which tissue is before them";
    }
    else if (vtkVolumeRepresentation::SafeDownCast(shown) &&
      !vtkWholeVolumeRepresentation::SafeDownCast(shown))
    {
      reason = "a volume that is no Deformed Volume is shown beside it. ParaView cannot tell which "
               "of the two is before the other: show both as Deformed Volume";
    }
  });
  for (vtkWholeVolumeRepresentation* volume : group)
  {
    reason = reason.empty() ? volume->WhyWhole() : reason;
    if (reason.empty() && !volume->Actor->GetMatrix()->IsIdentity())
    {
      reason = "a volume of the view has a transform";
    }
  }
  return reason;
}

// A client comes here, too: it and the server agree on what changed, or the view keeps what it has.
// Ranks that draw several volumes cut all of them by the same boxes, so a change of one concerns
// the others, and so does one that comes or goes.
void vtkWholeVolumeRepresentation::ChooseWhoDraws(vtkPVRenderView* view, const Group& group)
{
  const std::string reason = WhyWholeIn(view, group);
  bool changes = false;
  bool triesParts = false;
  for (vtkWholeVolumeRepresentation* volume : group)
  {
    const bool isOther = reason.empty() != volume->MayDrawPart || group != volume->Beside;
    triesParts = triesParts || isOther || volume->TriesParts;
    changes = changes || isOther || volume->GetNeedsUpdate();
    volume->WhyDrawnWhole = reason;
    volume->MayDrawPart = reason.empty();
    volume->TriesParts = false;
    volume->Beside = group;
  }
  for (vtkWholeVolumeRepresentation* volume : group)
  {
    volume->PartsRefused = volume->PartsRefused && !triesParts;
    if (changes && !volume->GetNeedsUpdate() && mayHaveRanks())
    {
      volume->MarkModified();
    }
  }
}

// Brings this process's part of each volume.
void vtkWholeVolumeRepresentation::Bring(
  const Group& group, vtkInformation* input, vtkInformation* output)
{
  for (vtkWholeVolumeRepresentation* volume : group)
  {
    brainshift::FailedUpdate failed(volume, vtkPVView::REQUEST_UPDATE());
    volume->Problem = brainshift::sentenceThrownBy("its pipeline", [&] {
      // NOLINTNEXTLINE(bugprone-parent-virtual-call): without the delivery of the class between
      volume->vtkVolumeRepresentation::ProcessViewRequest(
        vtkPVView::REQUEST_UPDATE(), input, output);
    });
    failed.end();
  }
}

// Every rank comes here for every update, even if its pipeline has failed: the others wait for it.
void vtkWholeVolumeRepresentation::ShareOut(
  const Group& group, vtkInformation* input, vtkInformation* output)
{
  vtkMultiProcessController* ranks = brainshift::severalRanks();
  if (!ranks)
  {
    return;
  }
  Bring(group, input, output);
  bool isNew = false;
  std::string problem;
  for (vtkWholeVolumeRepresentation* volume : group)
  {
    const bool changes = brainshift::isTrueOnAny(ranks, volume->IsNew || !volume->Problem.empty());
    const std::string lacks = changes && !volume->IsNew ? "its pipeline brought no data" : "";
    const std::string own = volume->Problem.empty() ? lacks : volume->Problem;
    problem = problem.empty() ? own : problem;
    isNew = isNew || changes;
    volume->IsNew = false;
  }
  if (!isNew)
  {
    return;
  }
  problem = brainshift::problemOnAny(ranks, problem);
  if (problem.empty())
  {
    TakeVoxels(group);
  }
  else
  {
    KeepPicture(group, problem + Kept);
  }
}

// Parts if all volumes can be drawn so, and all ranks have memory for them.
void vtkWholeVolumeRepresentation::TakeVoxels(const Group& all)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  Group group;
  for (vtkWholeVolumeRepresentation* volume : all)
  {
    if (brainshift::isTrueOnAny(ranks, volume->Part))
    {
      group.push_back(volume);
    }
    else
    {
      volume->Drawn = nullptr;
      KeepPicture({ volume }, {});
    }
  }
  if (group.empty()) // on all ranks
  {
    return;
  }
  std::string reason;
  std::string problem = brainshift::sentenceThrownBy("its volume", [&] {
    for (vtkWholeVolumeRepresentation* volume : group)
    {
      reason = reason.empty() ? volume->WhyPartIsWhole() : reason;
    }
  });
  problem = brainshift::problemOnAny(ranks, problem);
  const bool drawsParts = !brainshift::isTrueOnAny(ranks, !reason.empty());
  if (problem.empty() && !drawsParts)
  {
    group.front()->WarnOfFirstRank(reason);
  }
  problem = problem.empty() && drawsParts ? WhyBentUnlike(group) : problem;
  if (!problem.empty())
  {
    KeepPicture(group, problem + Kept + WayOut);
    return;
  }
  problem = TakeExtents(group, drawsParts);
  const std::string ofParts = drawsParts ? problem : "";
  if (!ofParts.empty())
  {
    for (vtkWholeVolumeRepresentation* volume : group)
    {
      volume->PartsRefused = true;
    }
    problem = TakeExtents(group, false);
  }
  if (!problem.empty())
  {
    KeepPicture(group, problem + Kept + WayOut);
  }
  else if (!ofParts.empty())
  {
    group.front()->ReportOnce(ofParts + ". The first rank draws the whole volume" + WayOut);
  }
}

// Why the parts of the ranks would not fit together, the same on all; empty: they would.
std::string vtkWholeVolumeRepresentation::WhyBentUnlike(const Group& group)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  std::string problem; // the same on all ranks
  for (vtkWholeVolumeRepresentation* volume : group)
  {
    problem = problem.empty() ? brainshift::bendProblem(ranks, volume->Part) : problem;
  }
  return problem;
}

// Why this rank cannot draw a part; empty: it can.
std::string vtkWholeVolumeRepresentation::WhyPartIsWhole()
{
  return !this->MayDrawPart ? this->WhyDrawnWhole
    : !this->Part           ? "a rank has no voxels of it"
    : this->PartsRefused    ? "a rank had no memory for its part"
                            : this->WhyDataIsWhole();
}

void vtkWholeVolumeRepresentation::WarnOfFirstRank(const std::string& reason)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  const bool isNew = reason != this->WarnedOf;
  this->WarnedOf = reason;
  if (isNew && !reason.empty() && !this->PartsRefused && ranks->GetLocalProcessId() == 0)
  {
    brainshift::warn(this,
      "The first of " + std::to_string(ranks->GetNumberOfProcesses()) +
        " MPI ranks holds and draws the whole volume: " + reason);
  }
}

// Takes the voxels that this rank draws of each volume. Why one of the ranks cannot, the same on
// all; empty: all could. All volumes are cut by the same boxes, because ParaView orders ranks.
std::string vtkWholeVolumeRepresentation::TakeExtents(const Group& group, bool drawsParts)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  const bool isFirst = ranks->GetLocalProcessId() == 0;
  std::string problem;
  std::vector<Taken> taken(group.size());
  brainshift::Box bounds = NoBox;
  for (std::size_t i = 0; i < group.size(); ++i)
  {
    taken[i] = group[i]->Measure(drawsParts, problem);
    bounds = brainshift::around(bounds, taken[i].part.tissue);
  }
  const brainshift::Box box = ShareWork(group, bounds, drawsParts, problem);
  for (std::size_t i = 0; i < group.size(); ++i)
  {
    vtkWholeVolumeRepresentation* volume = group[i];
    brainshift::DrawnPart& part = taken[i].part;
    part.bounds = box;
    part.cut = brainshift::withoutOuterSides(box, bounds);
    volume->Want(taken[i].whole, drawsParts ? &part : nullptr, problem);
    taken[i].voxels =
      volume->Shared->share(ranks, volume->Part, taken[i].whole, volume->Wanted, problem);
    if (!taken[i].voxels)
    {
      std::for_each(group.begin(), group.end(), [](auto* one) { one->Wanted = NoExtent; });
      return problem;
    }
  }
  for (std::size_t i = 0; i < group.size(); ++i)
  {
    group[i]->IsDrawnElsewhere = !drawsParts && !isFirst;
    taken[i].part.ranges = group[i]->Shared->ranges();
    group[i]->SetDrawnPart(drawsParts ? &taken[i].part : nullptr);
    group[i]->Drawn = taken[i].voxels;
    if (drawsParts)
    {
      group[i]->Reference->cut(
        taken[i].voxels, group[i]->ReadFor(taken[i].part.cut), group[i]->RankHalo);
      group[i]->Reported.clear(); // the same is new when it comes again
    }
    else
    {
      *group[i]->Reference = brainshift::ReferencePart();
    }
    group[i]->Draw(taken[i].voxels);
  }
  return {};
}

// This rank's part of the bounds of all tissue. The parts stay where they are while their work is
// balanced, so that strokes move few voxels. What fails becomes the problem.
brainshift::Box vtkWholeVolumeRepresentation::ShareWork(
  const Group& group, const brainshift::Box& bounds, bool drawsParts, std::string& problem)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  vtkWholeVolumeRepresentation* first = group.front();
  // Parts that are kept need no counts.
  const bool counted = drawsParts && (!first->KeepsBoxes || first->RankBoxes.empty());
  brainshift::TissueCounts counts;
  counts.box = bounds;
  if (counted) // on all ranks, or on none
  {
    for (vtkWholeVolumeRepresentation* volume : group)
    {
      const auto count = [&] { volume->CountVisible(volume->Part, counts); };
      problem =
        problem.empty() ? brainshift::sentenceThrownBy("its part of the volume", count) : problem;
    }
    const std::vector<long long> own = counts.cells;
    ranks->AllReduce(own.data(), counts.cells.data(), own.size(), vtkCommunicator::SUM_OP);
  }
  std::vector<brainshift::Box> parts = brainshift::balancedParts(
    first->RankBoxes, first->AllBoxes, ranks->GetNumberOfProcesses(), counts, first->KeepsBoxes);
  if (counted)
  {
    const auto held = first->Part ? brainshift::boxAround(brainshift::gridOf(first->Part)) : NoBox;
    parts = brainshift::nearestParts(parts, brainshift::boxesOfAll(ranks, held));
  }
  for (vtkWholeVolumeRepresentation* volume : group)
  {
    volume->RankBoxes = parts;
    volume->AllBoxes = bounds;
  }
  return parts[ranks->GetLocalProcessId()];
}

// The whole volume, and where its tissue can be, the same on each rank. What fails becomes the
// problem.
vtkWholeVolumeRepresentation::Taken vtkWholeVolumeRepresentation::Measure(
  bool drawsParts, std::string& problem)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  brainshift::Extent all{};
  std::copy_n(this->WholeExtent, 6, all.begin());
  Taken taken;
  taken.whole = this->Shared->wholeOf(ranks, this->Part, all);
  taken.part.whole = taken.whole;
  brainshift::Box tissue = brainshift::boxAround(taken.whole.grid);
  if (drawsParts && problem.empty())
  {
    problem = brainshift::sentenceThrownBy(
      "its part of the deformation", [&] { this->WidenByTissue(this->Part, tissue.data()); });
  }
  taken.part.tissue = brainshift::boxOfAll(ranks, tissue);
  return taken;
}

// The voxels that this rank wants; part: null if the first rank draws all. A rank that lacks voxels
// of its part wants them, and those of the halo around it. What fails becomes the problem.
void vtkWholeVolumeRepresentation::Want(
  const brainshift::WholeVolume& whole, const brainshift::DrawnPart* part, std::string& problem)
{
  const bool drewPart = this->DrawsPart;
  this->DrawsPart = part;
  if (!part)
  {
    const bool isFirst = vtkMultiProcessController::GetGlobalController()->GetLocalProcessId() == 0;
    this->Wanted = isFirst ? whole.extent : NoExtent;
  }
  else if (problem.empty())
  {
    this->Wanted = drewPart ? this->Wanted : NoExtent; // else the first rank would keep all
    problem = brainshift::sentenceThrownBy(
      "its part of the deformation", [&] { this->WantVoxelsOf(whole, part->bounds); });
  }
}

void vtkWholeVolumeRepresentation::Draw(vtkImageData* volume)
{
  this->Cache = volume;
  this->VolumeMapper->SetInputData(volume);
  if (this->IsDrawnElsewhere || volume->GetNumberOfPoints() == 0)
  {
    vtkMath::UninitializeBounds(this->DataBounds);
    return;
  }
  this->DataSize = static_cast<decltype(this->DataSize)>(bytesOf(volume) / 1024.0);
  this->OutlineSource->SetBounds(volume->GetBounds());
  this->OutlineSource->Update();
  this->WidenBounds(); // ParaView orders ranks by these
}

void vtkWholeVolumeRepresentation::KeepPicture(const Group& group, const std::string& sentence)
{
  for (vtkWholeVolumeRepresentation* volume : group)
  {
    volume->Wanted = NoExtent;
    volume->IsDrawnElsewhere = volume->IsDrawnElsewhere || !volume->Drawn;
    volume->Draw(volume->Drawn ? volume->Drawn : vtkSmartPointer<vtkImageData>::New());
  }
  if (!sentence.empty())
  {
    group.front()->ReportOnce(sentence);
  }
}

// The first rank reports for all: users see what it says.
void vtkWholeVolumeRepresentation::ReportOnce(const std::string& sentence)
{
  const bool isNew = sentence != this->Reported;
  this->Reported = sentence;
  if (isNew && vtkMultiProcessController::GetGlobalController()->GetLocalProcessId() == 0)
  {
    vtkErrorMacro(<< sentence << ".");
  }
}

void vtkWholeVolumeRepresentation::WantVoxelsOf(
  const brainshift::WholeVolume& whole, const brainshift::Box& part)
{
  brainshift::followBox(
    this->Wanted, whole, this->LatticeOf(this->Part), this->ReadFor(part), this->RankHalo);
}

// The box (mm) in which voxels are read for a part of the deformed frame.
brainshift::Box vtkWholeVolumeRepresentation::ReadFor(const brainshift::Box& part) const
{
  return brainshift::widened(part, this->Part ? this->ReadsBesideMm(this->Part) : 0.0);
}

void vtkWholeVolumeRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  const char* text = this->Legend->GetInput();
  this->Legend->SetVisibility(visible && text && *text);
  this->Evidence->SetVisibility(visible && this->ShowEvidence);
}

void vtkWholeVolumeRepresentation::SetShowEvidence(bool show)
{
  this->ShowEvidence = show;
  this->Evidence->SetVisibility(this->GetVisibility() && show);
}

void vtkWholeVolumeRepresentation::SetLegend(const char* text)
{
  this->Legend->SetInput(text ? text : "");
  this->Legend->SetVisibility(this->GetVisibility() && text && *text);
}

void vtkWholeVolumeRepresentation::MarkModifiedOnRanks()
{
  if (mayHaveRanks())
  {
    this->MarkModified();
  }
}

bool vtkWholeVolumeRepresentation::CarriesComparison() const
{
  vtkDataSet* drawn = this->VolumeMapper->GetDataSetInput();
  const brainshift::ReferenceVolume reference =
    drawn ? brainshift::readReference(drawn) : brainshift::ReferenceVolume();
  return reference.voxels && reference.show == brainshift::ReferenceShow::Both;
}

bool vtkWholeVolumeRepresentation::AddToView(vtkView* view)
{
  brainshift::watchServer();
  if (auto renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetNonCompositedRenderer()->AddViewProp(this->Legend);
    renderView->GetNonCompositedRenderer()->AddViewProp(this->Evidence);
  }
  return this->Superclass::AddToView(view);
}

bool vtkWholeVolumeRepresentation::RemoveFromView(vtkView* view)
{
  if (auto renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetNonCompositedRenderer()->RemoveViewProp(this->Legend);
    renderView->GetNonCompositedRenderer()->RemoveViewProp(this->Evidence);
  }
  return this->Superclass::RemoveFromView(view);
}

void vtkWholeVolumeRepresentation::UpdateMapperParameters()
{
  this->Superclass::UpdateMapperParameters();
  if (this->IsDrawnElsewhere)
  {
    this->Actor->SetVisibility(false);
  }
}

void vtkWholeVolumeRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* legend = this->Legend->GetInput();
  os << indent << "Legend: " << (legend ? legend : "") << "\n";
  os << indent << "ShowEvidence: " << this->ShowEvidence << "\n";
  os << indent << "IsDrawnElsewhere: " << this->IsDrawnElsewhere << "\n";
  os << indent << "DrawsPart: " << this->DrawsPart << "\n";
  os << indent << "RankHalo: " << this->RankHalo << "\n";
}
