// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/CursorProbe.h"

#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"

#include <pqDataRepresentation.h>
#include <pqRenderView.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMViewProxy.h>

#include <cmath>

namespace brainshift
{
namespace
{
constexpr std::size_t Numbers = 19; // see vtkDeformedVolumeReport::GetFacts

glm::dvec3 tripleAt(const std::vector<double>& numbers, std::size_t first)
{
  return { numbers[first], numbers[first + 1], numbers[first + 2] };
}

std::optional<double> knownAt(const std::vector<double>& numbers, std::size_t first)
{
  return numbers[first] == 0.0 ? std::nullopt : std::optional<double>(numbers[first + 1]);
}

// What a colour map of categories calls a value; empty without a name.
QString nameOf(double value, vtkSMProxy* display)
{
  vtkSMProxy* colors = vtkSMPropertyHelper(display, "LookupTable", /*quiet*/ true).GetAsProxy();
  if (!colors || vtkSMPropertyHelper(colors, "IndexedLookup", true).GetAsInt() == 0)
  {
    return {};
  }
  const vtkSMPropertyHelper pairs(colors, "Annotations", true); // value, name, value, name ...
  for (unsigned int i = 0; i + 1 < pairs.GetNumberOfElements(); i += 2)
  {
    if (QString(pairs.GetAsString(i)).toDouble() == value)
    {
      return pairs.GetAsString(i + 1);
    }
  }
  return {};
}

// A label by what the data calls it, and its number. Zero is the background, by whatever name, and
// a mask of fractions has no labels.
QString labelText(double label, const QString& name)
{
  constexpr int Longest = 60; // letters; a file may hold any
  const QString words = name.simplified();
  if (label == 0.0 || label != std::floor(label) || (words.isEmpty() && label < 0.0))
  {
    return {};
  }
  const QString number = QString::number(label, 'f', 0);
  if (words.isEmpty())
  {
    return number;
  }
  const QString shown = words.size() > Longest ? words.left(Longest) + QChar(0x2026) : words;
  return QString("%1 (%2)").arg(shown, number);
}

CursorTissue tissueOf(
  const std::vector<double>& facts, const QString& labelName, vtkSMProxy* display)
{
  CursorTissue tissue;
  tissue.deformed = tripleAt(facts, 1);
  tissue.rest = tripleAt(facts, 4);
  tissue.bent = facts[7] != 0.0;
  tissue.jacobian = facts[8];
  tissue.intensity = knownAt(facts, 9);
  tissue.reference = knownAt(facts, 11);
  tissue.deviation = knownAt(facts, 17);
  tissue.label = tissue.intensity ? nameOf(*tissue.intensity, display) : QString();
  const std::optional<double> label = knownAt(facts, 13);
  tissue.label = tissue.label.isEmpty() && label ? labelText(*label, labelName) : tissue.label;
  const int chosen = vtkSMPropertyHelper(display, "WorldAxes", true).GetAsInt();
  tissue.axes = static_cast<WorldAxes>(chosen ? chosen : static_cast<int>(facts[15]));
  return tissue;
}
}

void CursorProbe::forget()
{
  this->Report = nullptr;
  this->View = nullptr;
}

std::optional<CursorTissue> CursorProbe::tissueAt(
  pqRenderView* view, int x, int y, const std::function<bool(pqDataRepresentation*)>& counts)
{
  if (view != this->View || !this->Report)
  {
    this->View = view;
    this->Report = makeReport(view->getProxy(), "DeformedVolumeReport");
    pointAt(this->Report, "View", view->getProxy());
  }
  std::optional<CursorTissue> nearest;
  double nearestMm = 0.0;
  if (view->getViewProxy()->GetNeedsUpdate())
  {
    return nearest;
  }
  const int pixel[2] = { x, y };
  vtkSMPropertyHelper(this->Report, "Pixel").Set(pixel, 2);
  for (pqRepresentation* representation : view->getRepresentations())
  {
    auto display = qobject_cast<pqDataRepresentation*>(representation);
    if (!display || !display->isVisible() || !(showsSlices(display) || showsVolume(display)) ||
      (counts && !counts(display)))
    {
      continue;
    }
    pointAt(this->Report, "Representation", display->getProxy());
    askAnew(this->Report, "Pixel");
    const std::vector<double> facts = answerOf(this->Report, "Facts");
    if (facts.size() == Numbers && facts[0] != 0.0 && (!nearest || facts[16] < nearestMm))
    {
      const QString name = facts[13] != 0.0 ? textOf(this->Report, "LabelName") : QString();
      nearest = tissueOf(facts, name, display->getProxy());
      nearestMm = facts[16];
    }
  }
  return nearest;
}
}
