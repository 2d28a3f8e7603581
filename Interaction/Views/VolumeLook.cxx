// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/VolumeLook.h"

#include "Interaction/Views/Reports.h"

#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqSettings.h>

#include <vtkDataObject.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMRenderViewProxy.h>

#include <QMap>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

namespace brainshift
{
namespace
{
const glm::dvec3 FirstDirection = glm::normalize(glm::dvec3(0.62, 0.68, 0.40));
const glm::dvec3 Up(0.0, 0.0, 1.0);
constexpr double Filled = 0.92;   // of the view's height or width
constexpr double BoxShare = 0.25; // of the box's corners in the size of tissue

QString textOf(vtkSMProxy* report, const char* property)
{
  return QString::fromUtf8(vtkSMPropertyHelper(report, property).GetAsString());
}

// Half the size of tissue along a direction of unit length: a little more than that of the
// ellipsoid in its box, for a head has a neck.
double reachOf(const glm::dvec3& half, const glm::dvec3& along)
{
  const glm::dvec3 parts = glm::abs(half * along);
  return glm::mix(glm::length(parts), parts.x + parts.y + parts.z, BoxShare);
}

// The colours that looks gave, by the number of the colour map.
QMap<vtkTypeUInt32, std::vector<double>>& given()
{
  static QMap<vtkTypeUInt32, std::vector<double>> colors;
  return colors;
}

// ParaView would fit the curve to the data again, where values mean tissue.
void keepValues(vtkSMProxy* curve)
{
  vtkSMPropertyHelper(curve, "AutomaticRescaleRangeMode", true).Set(-1);
  vtkSMPropertyHelper(curve, "ScalarRangeInitialized", true).Set(1);
}
}

VolumeLook makeVolumeLook(pqDataRepresentation* display, const QString& name)
{
  VolumeLook look;
  vtkSMProxy* representation = display->getProxy();
  const vtkSMPropertyHelper input(representation, "Input");
  const vtkSMPropertyHelper array(representation, "ColorArrayName", true);
  const vtkSmartPointer<vtkSMProxy> report = makeReport(representation, "VolumeLookReport");
  if (!report || !input.GetAsProxy() || !array.GetInputArrayNameToProcess())
  {
    return look;
  }
  pointAt(report, "Source", input.GetAsProxy());
  vtkSMPropertyHelper(report, "Port").Set(static_cast<int>(input.GetOutputPort()));
  vtkSMPropertyHelper(report, "Association")
    .Set(array.GetInputArrayAssociation() == vtkDataObject::CELL ? 1 : 0);
  vtkSMPropertyHelper(report, "ArrayName").Set(array.GetInputArrayNameToProcess());
  vtkSMPropertyHelper(report, "Look").Set(name.toUtf8().constData());
  report->UpdateVTKObjects();
  report->InvokeCommand("Measure");
  report->UpdatePropertyInformation();
  look.kind = textOf(report, "Kind");
  look.names = textOf(report, "Names").split('\n', Qt::SkipEmptyParts);
  look.colors = vtkSMPropertyHelper(report, "Colors").GetDoubleArray();
  look.opacities = vtkSMPropertyHelper(report, "Opacities").GetDoubleArray();
  look.drawsSegment = vtkSMPropertyHelper(report, "DrawsSegment").GetAsInt() != 0;
  look.bounds = vtkSMPropertyHelper(report, "TissueBounds").GetDoubleArray();
  look.name = look.colors.empty() ? QString() : name.isEmpty() ? look.names.value(0) : name;
  return look;
}

void applyLook(pqDataRepresentation* display, const VolumeLook& look)
{
  vtkSMProxy* representation = display->getProxy();
  vtkSMProxy* colors = vtkSMPropertyHelper(representation, "LookupTable", true).GetAsProxy();
  vtkSMProxy* opacities =
    vtkSMPropertyHelper(representation, "ScalarOpacityFunction", true).GetAsProxy();
  if (!colors || !opacities || look.colors.empty())
  {
    return;
  }
  keepValues(colors);
  vtkSMPropertyHelper(colors, "ColorSpace").Set("RGB");
  vtkSMPropertyHelper(colors, "RGBPoints")
    .Set(look.colors.data(), static_cast<unsigned int>(look.colors.size()));
  colors->UpdateVTKObjects();
  given()[colors->GetGlobalID()] = look.colors;
  std::vector<double> points;
  for (std::size_t i = 0; i + 1 < look.opacities.size(); i += 2)
  {
    points.insert(points.end(), { look.opacities[i], look.opacities[i + 1], 0.5, 0.0 });
  }
  keepValues(opacities);
  vtkSMPropertyHelper(opacities, "Points")
    .Set(points.data(), static_cast<unsigned int>(points.size()));
  opacities->UpdateVTKObjects();
  vtkSMPropertyHelper(representation, "Shade", true).Set(1);
  vtkSMPropertyHelper(representation, "DrawSegment", true).Set(look.drawsSegment ? 1 : 0);
  representation->UpdateVTKObjects();
}

bool isLook(vtkSMProxy* colors)
{
  return given().value(colors->GetGlobalID()) ==
    vtkSMPropertyHelper(colors, "RGBPoints").GetDoubleArray();
}

QString chosenLook(const QString& kind)
{
  return pqApplicationCore::instance()->settings()->value("BrainShift/Look/" + kind).toString();
}

void rememberLook(const QString& kind, const QString& name)
{
  pqApplicationCore::instance()->settings()->setValue("BrainShift/Look/" + kind, name);
}

void aimAt(vtkSMRenderViewProxy* view, const std::vector<double>& bounds)
{
  if (bounds.size() != 6 || bounds[0] > bounds[1])
  {
    return;
  }
  const glm::dvec3 low(bounds[0], bounds[2], bounds[4]);
  const glm::dvec3 high(bounds[1], bounds[3], bounds[5]);
  const glm::dvec3 middle = 0.5 * (low + high);
  const glm::dvec3 half = glm::max(0.5 * (high - low), glm::dvec3(1e-9));
  const glm::dvec3 right = glm::normalize(glm::cross(Up, FirstDirection));
  const std::vector<int> size = vtkSMPropertyHelper(view, "ViewSize").GetIntArray();
  const double wide =
    size.size() == 2 && size[1] > 0 ? static_cast<double>(size[0]) / size[1] : 1.0;
  // Half the height of the picture at the tissue's middle.
  const double scale =
    std::max(reachOf(half, glm::cross(FirstDirection, right)), reachOf(half, right) / wide) /
    Filled;
  const double angle = vtkSMPropertyHelper(view, "CameraViewAngle").GetAsDouble();
  const double distance =
    scale / glm::tan(glm::radians(0.5 * angle)) + BoxShare * reachOf(half, FirstDirection);
  const glm::dvec3 position = middle + distance * FirstDirection;
  vtkSMPropertyHelper(view, "CameraFocalPoint").Set(&middle.x, 3);
  vtkSMPropertyHelper(view, "CameraPosition").Set(&position.x, 3);
  vtkSMPropertyHelper(view, "CameraViewUp").Set(&Up.x, 3);
  vtkSMPropertyHelper(view, "CameraParallelScale").Set(scale);
  vtkSMPropertyHelper(view, "CenterOfRotation").Set(&middle.x, 3);
  view->UpdateVTKObjects();
}
}
