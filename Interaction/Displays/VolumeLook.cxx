// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/VolumeLook.h"

#include "Filters/Looks/FirstCamera.h"
#include "Interaction/Views/Reports.h"
#include "Interaction/Workarounds/Sessions.h"

#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqSettings.h>

#include <vtkDataObject.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>

#include <QMap>

#include <limits>
#include <sstream>

namespace brainshift
{
namespace
{
// Annotation of a colour map, which state files keep: the points that a preset has set.
constexpr const char* Given = "BrainShift.Look";

std::string pointsOf(vtkSMProxy* colors)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  for (const double number : vtkSMPropertyHelper(colors, "RGBPoints").GetDoubleArray())
  {
    text << number << ' ';
  }
  return text.str();
}

// ParaView would fit the curve to the data again, where values mean tissue.
void keepValues(vtkSMProxy* curve)
{
  vtkSMPropertyHelper(curve, "AutomaticRescaleRangeMode", true).Set(-1);
  vtkSMPropertyHelper(curve, "ScalarRangeInitialized", true).Set(1);
}
}

namespace
{
// On the array that a display is coloured by, before it measures; null if there is none.
vtkSmartPointer<vtkSMProxy> reportOn(pqDataRepresentation* display)
{
  vtkSMProxy* representation = display->getProxy();
  const vtkSMPropertyHelper input(representation, "Input");
  const vtkSMPropertyHelper array(representation, "ColorArrayName", true);
  const vtkSmartPointer<vtkSMProxy> report = makeReport(representation, "VolumeLookReport");
  if (!report || !input.GetAsProxy() || !array.GetInputArrayNameToProcess())
  {
    return nullptr;
  }
  pointAt(report, "Source", input.GetAsProxy());
  vtkSMPropertyHelper(report, "Port").Set(static_cast<int>(input.GetOutputPort()));
  vtkSMPropertyHelper(report, "Association")
    .Set(array.GetInputArrayAssociation() == vtkDataObject::CELL ? 1 : 0);
  vtkSMPropertyHelper(report, "ArrayName").Set(array.GetInputArrayNameToProcess());
  return report;
}
}

VolumeLook makeVolumeLook(pqDataRepresentation* display, const QString& name)
{
  VolumeLook look;
  const vtkSmartPointer<vtkSMProxy> report = reportOn(display);
  if (!report)
  {
    return look;
  }
  vtkSMPropertyHelper(report, "Look").Set(name.toUtf8().constData());
  report->UpdateVTKObjects();
  report->InvokeCommand("Measure");
  pull(report);
  look.kind = textOf(report, "Kind");
  look.names = textOf(report, "Names").split('\n', Qt::SkipEmptyParts);
  look.colors = vtkSMPropertyHelper(report, "Colors").GetDoubleArray();
  look.opacities = vtkSMPropertyHelper(report, "Opacities").GetDoubleArray();
  look.drawsSegment = vtkSMPropertyHelper(report, "DrawsSegment").GetAsInt() != 0;
  look.tissue = vtkSMPropertyHelper(report, "TissuePoints").GetDoubleArray();
  look.name = look.colors.empty() ? QString() : name.isEmpty() ? look.names.value(0) : name;
  return look;
}

std::vector<double> tissueWindow(pqDataRepresentation* display)
{
  const vtkSmartPointer<vtkSMProxy> report = reportOn(display);
  if (!report)
  {
    return {};
  }
  report->UpdateVTKObjects();
  report->InvokeCommand("MeasureWindow");
  return answerOf(report, "Window");
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
  colors->SetAnnotation(Given, pointsOf(colors).c_str());
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
  return colors->HasAnnotation(Given) && colors->GetAnnotation(Given) == pointsOf(colors);
}

namespace
{
// Without the values: ParaView changes their range by itself.
std::vector<double> colorsAlone(vtkSMProxy* colors)
{
  std::vector<double> points = vtkSMPropertyHelper(colors, "RGBPoints").GetDoubleArray();
  for (std::size_t i = 0; i < points.size(); i += 4)
  {
    points[i] = 0.0;
  }
  return points;
}

QMap<vtkTypeUInt32, std::vector<double>>& unchosen()
{
  return keptBySession<VolumeLook, QMap<vtkTypeUInt32, std::vector<double>>>();
}
}

void noteUnchosen(vtkSMProxy* colors)
{
  unchosen()[colors->GetGlobalID()] = colorsAlone(colors);
}

bool isUnchosen(vtkSMProxy* colors)
{
  return unchosen().value(colors->GetGlobalID()) == colorsAlone(colors);
}

QString chosenLook(const QString& kind)
{
  return pqApplicationCore::instance()->settings()->value("BrainShift/Look/" + kind).toString();
}

void rememberLook(const QString& kind, const QString& name)
{
  pqApplicationCore::instance()->settings()->setValue("BrainShift/Look/" + kind, name);
}

void aimAt(vtkSMRenderViewProxy* view, const std::vector<double>& tissue)
{
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i + 2 < tissue.size(); i += 3)
  {
    points.emplace_back(tissue[i], tissue[i + 1], tissue[i + 2]);
  }
  if (points.empty())
  {
    return;
  }
  const std::vector<int> size = vtkSMPropertyHelper(view, "ViewSize").GetIntArray();
  const double aspect =
    size.size() == 2 && size[1] > 0 ? static_cast<double>(size[0]) / size[1] : 1.0;
  const FirstCamera camera =
    firstCamera(points, aspect, vtkSMPropertyHelper(view, "CameraViewAngle").GetAsDouble());
  vtkSMPropertyHelper(view, "CameraFocalPoint").Set(&camera.focalPoint.x, 3);
  vtkSMPropertyHelper(view, "CameraPosition").Set(&camera.position.x, 3);
  vtkSMPropertyHelper(view, "CameraViewUp").Set(&camera.up.x, 3);
  vtkSMPropertyHelper(view, "CameraParallelScale").Set(camera.parallelScale);
  vtkSMPropertyHelper(view, "CenterOfRotation").Set(&camera.focalPoint.x, 3);
  view->UpdateVTKObjects();
}
}
