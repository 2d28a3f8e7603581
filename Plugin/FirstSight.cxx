// SPDX-License-Identifier: BSD-3-Clause
#include "Plugin/FirstSight.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Displays/VolumeLook.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Workarounds/Sessions.h"

#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPipelineFilter.h>
#include <pqView.h>

#include <vtkPVDataInformation.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkSMSourceProxy.h>

#include <QHash>
#include <QVariant>

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr const char* Tissue = "BrainShiftTissue"; // Qt property of a source

std::vector<double> numbersOf(vtkSMProxy* view, const char* property)
{
  return vtkSMPropertyHelper(view, property).GetDoubleArray();
}

glm::dvec3 tripleOf(vtkSMProxy* view, const char* property)
{
  const std::vector<double> numbers = numbersOf(view, property);
  return { numbers[0], numbers[1], numbers[2] };
}

struct Camera
{
  explicit Camera(vtkSMProxy* view)
    : from(tripleOf(view, "CameraPosition"))
    , to(tripleOf(view, "CameraFocalPoint"))
    , up(tripleOf(view, "CameraViewUp"))
    , scale(vtkSMPropertyHelper(view, "CameraParallelScale").GetAsDouble())
  {
  }

  bool operator==(const Camera& other) const
  {
    return this->looksAs(other) && this->from == other.from && this->to == other.to &&
      this->scale == other.scale;
  }

  // Whether the directions are the same.
  bool looksAs(const Camera& other) const
  {
    constexpr double turned = 1e-9;
    return this->up == other.up &&
      glm::dot(glm::normalize(this->to - this->from), glm::normalize(other.to - other.from)) >
      1.0 - turned;
  }

  // ParaView looks along -z, with y up, until the user turns the camera.
  bool isUnturned() const
  {
    const glm::dvec3 away = glm::abs(this->from - this->to);
    return this->from.z >= this->to.z && std::max(away.x, away.y) <= 1e-6 * away.z &&
      this->up.y == 1.0;
  }

  glm::dvec3 from;
  glm::dvec3 to;
  glm::dvec3 up;
  double scale;
};

// As it was left here, by the number of the view.
QHash<vtkTypeUInt32, Camera>& cameras()
{
  return keptBySession<Camera, QHash<vtkTypeUInt32, Camera>>();
}

// The corners of the box of a volume.
std::vector<double> cornersOf(pqDataRepresentation* display)
{
  const vtkSMPropertyHelper input(display->getProxy(), "Input");
  auto source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  double box[6] = { 0, -1, 0, -1, 0, -1 };
  if (source)
  {
    source->GetDataInformation(input.GetOutputPort())->GetBounds(box);
  }
  std::vector<double> points;
  for (int corner = 0; corner < 8 && box[0] <= box[1]; ++corner)
  {
    points.insert(points.end(),
      { box[corner & 1], box[2 + ((corner >> 1) & 1)], box[4 + ((corner >> 2) & 1)] });
  }
  return points;
}

std::vector<double> tissueOf(pqDataRepresentation* display)
{
  pqServerManagerModel* model = serverManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    const auto points = source->property(Tissue).value<QList<double>>();
    if (!points.isEmpty() && isMadeOf(sourceOf(display), source))
    {
      return { points.begin(), points.end() };
    }
  }
  return cornersOf(display);
}

QList<pqDataRepresentation*> visibleVolumes(pqView* view)
{
  QList<pqDataRepresentation*> volumes;
  for (pqRepresentation* representation : view->getRepresentations())
  {
    auto display = qobject_cast<pqDataRepresentation*>(representation);
    if (display && display->isVisible() && showsVolume(display))
    {
      volumes.append(display);
    }
  }
  return volumes;
}

// The middle of the tissue, or the point that the camera turns about within its box, is in the
// picture, the eye is outside the box, and the tissue is more than a dot.
bool isInSight(vtkSMProxy* view, const std::vector<double>& tissue)
{
  glm::dvec3 low(HUGE_VAL);
  glm::dvec3 high(-HUGE_VAL);
  for (std::size_t i = 0; i + 2 < tissue.size(); i += 3)
  {
    const glm::dvec3 point(tissue[i], tissue[i + 1], tissue[i + 2]);
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const auto isInBox = [&](const glm::dvec3& point) {
    return glm::all(glm::lessThan(low, point)) && glm::all(glm::lessThan(point, high));
  };
  const Camera camera(view);
  const glm::dvec3 ahead = glm::normalize(camera.to - camera.from);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
  const glm::dvec3 middle = (low + high) / 2.0 - camera.from;
  const double depth = glm::dot(middle, ahead);
  const double angle = glm::radians(vtkSMPropertyHelper(view, "CameraViewAngle").GetAsDouble());
  const bool isFlat = vtkSMPropertyHelper(view, "CameraParallelProjection").GetAsInt() != 0;
  const double half = isFlat ? camera.scale : depth * std::tan(angle / 2.0); // mm, of the height
  const std::vector<int> size = vtkSMPropertyHelper(view, "ViewSize").GetIntArray();
  const double aspect = size[1] > 0 ? static_cast<double>(size[0]) / size[1] : 1.0;
  constexpr double dot = 0.02; // of the view's height
  const bool isMiddleSeen = std::abs(glm::dot(middle, right)) < half * aspect &&
    std::abs(glm::dot(middle, glm::cross(right, ahead))) < half;
  return depth > 0.0 && glm::length(high - low) > dot * 2.0 * half && !isInBox(camera.from) &&
    (isMiddleSeen || isInBox(camera.to));
}
}

pqPipelineSource* sourceOf(pqDataRepresentation* display)
{
  return serverManagerModel()->findItem<pqPipelineSource*>(
    vtkSMPropertyHelper(display->getProxy(), "Input").GetAsProxy());
}

bool isMadeOf(pqPipelineSource* source, pqPipelineSource* other)
{
  auto filter = qobject_cast<pqPipelineFilter*>(source);
  const QList<pqOutputPort*> inputs = filter ? filter->getAllInputs() : QList<pqOutputPort*>();
  return source == other || std::any_of(inputs.begin(), inputs.end(), [&](pqOutputPort* input) {
    return isMadeOf(input->getSource(), other);
  });
}

void noteTissue(pqDataRepresentation* display, const std::vector<double>& points)
{
  if (pqPipelineSource* source = sourceOf(display))
  {
    source->setProperty(Tissue, QVariant::fromValue(QList<double>(points.begin(), points.end())));
  }
}

void bringIntoSight(pqDataRepresentation* display)
{
  auto view = vtkSMRenderViewProxy::SafeDownCast(display->getView()->getProxy());
  const QList<pqDataRepresentation*> volumes = visibleVolumes(display->getView());
  if (!view || !volumes.contains(display))
  {
    return;
  }
  const Camera now(view);
  const auto left = cameras().constFind(view->GetGlobalID());
  const bool isOurs =
    left != cameras().constEnd() && (now == *left || (volumes.size() == 1 && now.looksAs(*left)));
  if (isOurs || now.isUnturned())
  {
    std::vector<double> all;
    for (pqDataRepresentation* volume : volumes)
    {
      const std::vector<double> tissue = tissueOf(volume);
      all.insert(all.end(), tissue.begin(), tissue.end());
    }
    aimAt(view, all);
    cameras().insert(view->GetGlobalID(), Camera(view));
  }
  else if (!isInSight(view, tissueOf(display)))
  {
    view->ResetCamera();
  }
}
}
