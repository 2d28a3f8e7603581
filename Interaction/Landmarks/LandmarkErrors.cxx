// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Landmarks/LandmarkErrors.h"

#include "Interaction/Landmarks/LandmarkList.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/ViewProbe.h"

#include <pqPipelineSource.h>

#include <cmath>

namespace brainshift
{
namespace
{
constexpr double Noticed = 0.5; // mm and degrees: landmarks are found again to within this
}

LandmarkErrors* LandmarkErrors::of(pqPipelineSource* deformation)
{
  if (!isDeformation(deformation))
  {
    return nullptr;
  }
  auto found = deformation->findChild<LandmarkErrors*>(QString(), Qt::FindDirectChildrenOnly);
  return found ? found : new LandmarkErrors(deformation);
}

LandmarkErrors::LandmarkErrors(pqPipelineSource* deformation)
  : QObject(deformation)
  , Deformation(deformation)
  , Editor(RefineEditor::of(deformation))
{
  this->connect(this->Editor, &RefineEditor::changed, this, &LandmarkErrors::follow);
}

void LandmarkErrors::follow()
{
  const LiveRun::State now = this->Editor->state();
  const LiveRun::State last = std::exchange(this->Last, now);
  const bool wasActive = last == LiveRun::State::Running || last == LiveRun::State::Paused;
  if (now == LiveRun::State::Running && !wasActive)
  {
    this->Errors.clear();
    const LandmarkList* landmarks = LandmarkList::of(this->Deformation);
    this->AtStart = landmarks->rows();
    this->ShiftAtStart = landmarks->figures().shift;
    this->DegreesAtStart = landmarks->figures().rotationDegrees;
  }
  else if (now != last && (now == LiveRun::State::Kept || now == LiveRun::State::Finished))
  {
    this->measure();
  }
}

// The fit left the motion out, and the refinement began without it.
QString LandmarkErrors::note() const
{
  if (this->Errors.isEmpty() ||
    !(this->ShiftAtStart > Noticed || this->DegreesAtStart > Noticed)) // also rejects NaN
  {
    return {};
  }
  return tr("The fit before left out a rigid motion of %1 mm and %2 degrees. If the landmarks were "
            "measured in another position of the reference, the errors contain this motion.")
    .arg(this->ShiftAtStart, 0, 'f', 1)
    .arg(this->DegreesAtStart, 0, 'f', 1);
}

void LandmarkErrors::measure()
{
  std::vector<glm::dvec3> rest;
  rest.reserve(this->AtStart.size());
  for (const LandmarkRow& row : this->AtStart)
  {
    rest.push_back(row.rest);
  }
  const std::vector<glm::dvec3> drawn =
    LatticeProbe(this->Deformation->getProxy()).sameTissue(rest, /*toRest*/ false);
  this->Errors.clear();
  for (std::size_t i = 0; i < drawn.size() && i < rest.size(); ++i)
  {
    const LandmarkRow& row = this->AtStart[i];
    const QString number = QString::number(i + 1);
    LandmarkError error;
    error.name = row.name.isEmpty() || row.name == number ? number : number + " " + row.name;
    error.wasInFit = row.on;
    error.before = glm::distance(row.drawn, row.measured);
    error.now = glm::distance(drawn[i], row.measured);
    if (std::isfinite(error.before) && std::isfinite(error.now))
    {
      this->Errors.append(error);
    }
  }
}
}
