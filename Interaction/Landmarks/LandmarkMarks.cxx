// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Landmarks/LandmarkMarks.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Landmarks/LandmarkList.h"
#include "Interaction/Landmarks/LandmarkPicker.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>

#include <vtkCamera.h>
#include <vtkLandmarkMarks.h>
#include <vtkPVRenderView.h>
#include <vtkRenderer.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double NearSliceMm = 2.5; // a mark farther away would point at other tissue
constexpr int Flat = 1;             // InteractionMode of a 2D view

using Style = LandmarkMark::Style;

vtkRenderer* rendererOf(pqRenderView* view)
{
  auto shown = vtkPVRenderView::SafeDownCast(view->getViewProxy()->GetClientSideView());
  return shown ? shown->GetNonCompositedRenderer() : nullptr;
}

// Whether its editor draws what changes: a picture at full quality would stop the hand.
bool isUnderHand(pqPipelineSource* source)
{
  const StrokeEditor* strokes = StrokeEditor::of(source);
  const FitEditor* fit = FitEditor::of(source);
  return (strokes && strokes->isEditing()) || (fit && fit->isEditing());
}

// The slice that a 2D view shows. In other views everything is near.
class ShownSlice
{
public:
  explicit ShownSlice(pqRenderView* view)
  {
    if (vtkSMPropertyHelper(view->getProxy(), "InteractionMode").GetAsInt() != Flat)
    {
      return;
    }
    for (pqRepresentation* representation : view->getRepresentations())
    {
      auto display = qobject_cast<pqDataRepresentation*>(representation);
      if (display && display->isVisible() && showsSlices(display))
      {
        glm::dvec3 position(0.0);
        vtkSMPropertyHelper(display->getProxy(), "SlicePosition").Get(&position[0], 3);
        const double* ahead =
          view->getRenderViewProxy()->GetActiveCamera()->GetDirectionOfProjection();
        this->Plane = { position, glm::dvec3(ahead[0], ahead[1], ahead[2]) };
      }
    }
  }

  // Nothing for a position that is far away, or not known.
  std::optional<glm::dvec3> shown(const glm::dvec3& position) const
  {
    const double away =
      this->Plane ? glm::dot(position - this->Plane->first, this->Plane->second) : 0.0;
    return std::abs(away) <= NearSliceMm && std::isfinite(position.x) ? std::optional(position)
                                                                      : std::nullopt;
  }

private:
  std::optional<std::pair<glm::dvec3, glm::dvec3>> Plane; // a point of it, unit normal
};

bool showsOtherVolume(pqPipelineSource* deformation, pqRenderView* view)
{
  const QList<pqRepresentation*> shown = view->getRepresentations();
  return std::any_of(shown.begin(), shown.end(), [deformation](pqRepresentation* representation) {
    auto display = qobject_cast<pqDataRepresentation*>(representation);
    return display && showsOther(deformation, display);
  });
}

void addMarks(const LandmarkList& list, pqRenderView* view, std::vector<LandmarkMark>& marks)
{
  pqDataRepresentation* display = bentDisplay(list.source(), view);
  const bool bent = display && !isMoved(display); // else marks would be beside its tissue
  if (!list.areMarksShown() || !(bent || showsOtherVolume(list.source(), view)))
  {
    return;
  }
  const ShownSlice slice(view);
  for (std::size_t i = 0; i < list.rows().size(); ++i)
  {
    const LandmarkRow& row = list.rows()[i];
    LandmarkMark mark;
    mark.tissue = bent ? slice.shown(row.drawn) : std::nullopt;
    mark.measured = slice.shown(row.measured);
    const bool isPlaced = mark.measured && std::isfinite(row.fitted.x);
    mark.fitted = isPlaced ? std::optional(row.fitted) : std::nullopt;
    mark.text = std::to_string(i + 1);
    mark.style = !row.on                            ? Style::Off
      : static_cast<int>(i) == list.figures().worst ? Style::Worst
                                                    : Style::Usual;
    marks.push_back(mark);
  }
  const LandmarkPicker* picker = LandmarkPicker::instance();
  const std::optional<LandmarkPicker::Half>& picked = picker->half();
  if (bent && picker->deformation() == list.source() && picked)
  {
    LandmarkMark half;
    half.tissue = slice.shown(picked->drawn);
    half.text = std::to_string(list.rows().size() + 1) + "?";
    marks.push_back(half);
  }
}
}

LandmarkMarks::LandmarkMarks(QObject* parent)
  : QObject(parent)
{
  this->Soon.setSingleShot(true);
  this->Soon.setInterval(0);
  this->connect(&this->Soon, &QTimer::timeout, this, &LandmarkMarks::refresh);
  this->connect(
    LandmarkPicker::instance(), &LandmarkPicker::changed, this, [this] { this->Soon.start(); });
  pqServerManagerModel* model = serverManagerModel();
  this->connect(model, &pqServerManagerModel::sourceAdded, this, &LandmarkMarks::watchSource);
  this->connect(model, &pqServerManagerModel::sourceRemoved, this, [this] { this->Soon.start(); });
  this->connect(model, &pqServerManagerModel::viewAdded, this, &LandmarkMarks::watchView);
  this->connect(model, &pqServerManagerModel::preViewRemoved, this, [this](pqView* view) {
    auto shown = qobject_cast<pqRenderView*>(view);
    const auto marks = this->Marks.take(shown);
    vtkRenderer* renderer = marks ? rendererOf(shown) : nullptr;
    if (renderer)
    {
      renderer->RemoveViewProp(marks);
    }
  });
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    this->watchSource(source);
  }
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watchView(view);
  }
}

LandmarkMarks::~LandmarkMarks() = default;

void LandmarkMarks::watchSource(pqPipelineSource* source)
{
  if (LandmarkList* list = LandmarkList::of(source))
  {
    this->connect(list, &LandmarkList::changed, &this->Soon, qOverload<>(&QTimer::start));
  }
}

void LandmarkMarks::watchView(pqView* added)
{
  if (auto view = qobject_cast<pqRenderView*>(added))
  {
    // Slices may have moved, or something else is shown.
    this->connect(view, &pqView::beginRender, this, [this, view] { this->mark(view); });
  }
}

void LandmarkMarks::mark(pqRenderView* view)
{
  std::vector<LandmarkMark> marks;
  pqServerManagerModel* model = serverManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (const LandmarkList* list = LandmarkList::of(source))
    {
      addMarks(*list, view, marks);
    }
  }
  if (!this->Marks.contains(view) && !marks.empty())
  {
    if (vtkRenderer* renderer = rendererOf(view))
    {
      this->Marks[view] = vtkSmartPointer<vtkLandmarkMarks>::New();
      renderer->AddViewProp(this->Marks[view]);
    }
  }
  if (vtkLandmarkMarks* shown = this->Marks.value(view))
  {
    shown->SetMarks(marks);
  }
}

void LandmarkMarks::refresh()
{
  pqServerManagerModel* model = serverManagerModel();
  const QList<pqPipelineSource*> sources = model->findItems<pqPipelineSource*>();
  const bool underHand = std::any_of(sources.begin(), sources.end(), isUnderHand);
  for (pqRenderView* view : model->findItems<pqRenderView*>())
  {
    const auto timeOf = [&] {
      const auto marks = this->Marks.value(view);
      return marks ? marks->GetMTime() : 0;
    };
    const vtkMTimeType before = timeOf();
    this->mark(view);
    if (timeOf() != before && !underHand)
    {
      view->render();
    }
  }
}
}
