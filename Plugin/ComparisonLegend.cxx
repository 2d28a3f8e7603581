// SPDX-License-Identifier: BSD-3-Clause
#include "Plugin/ComparisonLegend.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqDataRepresentation.h>
#include <pqOutputPort.h>
#include <pqPipelineFilter.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkCommand.h>
#include <vtkCompareVolumes.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QRegularExpression>
#include <QStringList>

#include <cstring>

namespace brainshift
{
namespace
{
constexpr int LongestName = 32; // characters; a view of slices is narrow

// The two colours of a comparison, and the one where both volumes agree.
struct ColorWords
{
  QString volume;
  QString reference;
  QString both;
};

ColorWords colorWords(bool blueAndOrange)
{
  using Legend = ComparisonLegend;
  return blueAndOrange ? ColorWords{ Legend::tr("blue"), Legend::tr("orange"), Legend::tr("grey") }
                       : ColorWords{ Legend::tr("red"), Legend::tr("green"), Legend::tr("yellow") };
}

bool isComparison(pqPipelineSource* source)
{
  return std::strcmp(source->getProxy()->GetXMLName(), "CompareVolumes") == 0;
}

pqPipelineSource* inputOf(pqPipelineSource* source, const char* port)
{
  auto filter = qobject_cast<pqPipelineFilter*>(source);
  pqOutputPort* input = filter ? filter->getInput(port, 0) : nullptr;
  return input ? input->getSource() : nullptr;
}

// ParaView's name of a filter and a number say nothing about the volume.
bool isNamedByParaView(pqPipelineSource* source)
{
  static const QRegularExpression number("\\d+$");
  static const QRegularExpression between("[^A-Za-z]");
  const QString name = QString(source->getSMName()).remove(number).remove(between);
  return name == QString(source->getProxy()->GetXMLName()).remove(between) ||
    name == QString(source->getProxy()->GetXMLLabel()).remove(between);
}

// The name of the nearest source that a file or a person has named.
QString nameOf(pqPipelineSource* source)
{
  for (pqPipelineSource* next = source; next && isNamedByParaView(source);
    next = inputOf(source, "Input"))
  {
    source = next;
  }
  const QString name = source ? source->getSMName() : QString();
  const int half = LongestName / 2;
  return name.size() <= LongestName ? name : name.left(half) + QChar(0x2026) + name.right(half - 1);
}

bool isBent(pqPipelineSource* source)
{
  while (source && !isDeformation(source))
  {
    source = inputOf(source, "Input");
  }
  return source != nullptr;
}

// Explains the colours of the volumes with these names. `way`: see
// vtkDeformedSlicesMapper::ComparisonType; Deformed Volume has the first two of them.
QString legendOf(int way, const ColorWords& colors, const QString& volume, const QString& reference)
{
  using Legend = ComparisonLegend;
  switch (way)
  {
    case 1:
      return Legend::tr("%1: %2\n%3: %4\n%5: both")
        .arg(colors.volume, volume, colors.reference, reference, colors.both);
    case 2:
      return Legend::tr("squares in turn:\n%1\n%2").arg(volume, reference);
    case 3:
      return Legend::tr("%1\nminus %2").arg(volume, reference);
    case 4:
      return Legend::tr("grey: %1\n%2: edges of %3").arg(volume, colors.reference, reference);
    case 5:
      return Legend::tr("on the sides of the line:\n%1\n%2").arg(volume, reference);
    case 6:
      return Legend::tr("grey: %1\n%2: %3 disagrees\ndark: outside %3")
        .arg(volume, colors.volume, reference);
    default:
      return {};
  }
}

QString textOf(pqPipelineSource* comparison, int way, const ColorWords& colors)
{
  pqPipelineSource* input = inputOf(comparison, "Input");
  const QString volume =
    (isBent(input) ? ComparisonLegend::tr("%1 (bent)") : ComparisonLegend::tr("%1 (volume)"))
      .arg(nameOf(input));
  const QString reference =
    ComparisonLegend::tr("%1 (reference)").arg(nameOf(inputOf(comparison, "Reference")));
  switch (vtkSMPropertyHelper(comparison->getProxy(), "Show").GetAsInt())
  {
    case vtkCompareVolumes::Deformed:
      return volume;
    case vtkCompareVolumes::Reference:
      return reference;
    default:
      return legendOf(way, colors, volume, reference);
  }
}

// True if the property has changed.
bool write(vtkSMProxy* display, const char* name, const QString& text)
{
  const char* written = vtkSMPropertyHelper(display, name).GetAsString();
  if (text == QString(written))
  {
    return false;
  }
  vtkSMPropertyHelper(display, name).Set(text.toUtf8().constData());
  return true;
}

bool writeInto(pqDataRepresentation* shown, pqPipelineSource* comparison)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMProxy* display = shown->getProxy();
  constexpr int composite = 0; // in other blend modes the volume is drawn alone
  const bool blends = vtkSMPropertyHelper(display, "BlendMode", true).GetAsInt() == composite;
  const int volumeWay = blends ? vtkSMPropertyHelper(display, "VolumeComparison").GetAsInt() : 0;
  const int sliceWay = vtkSMPropertyHelper(display, "SliceComparison").GetAsInt();
  const ColorWords colors = colorWords(vtkSMPropertyHelper(display, "ComparisonColors").GetAsInt());
  const bool volume = write(display, "VolumeLegend", textOf(comparison, volumeWay, colors));
  const bool slices = write(display, "SliceLegend", textOf(comparison, sliceWay, colors));
  display->UpdateVTKObjects();
  return volume || slices;
}
}

ComparisonLegend::ComparisonLegend(QObject* parent)
  : QObject(parent)
{
  pqServerManagerModel* model = serverManagerModel();
  QObject::connect(model, &pqServerManagerModel::sourceAdded, this, &ComparisonLegend::watch);
  QObject::connect(model, &pqServerManagerModel::nameChanged, this, &ComparisonLegend::refresh);
  QObject::connect(model,
    qOverload<pqPipelineSource*, pqPipelineSource*, int>(&pqServerManagerModel::connectionAdded),
    this, &ComparisonLegend::refresh);
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    this->watch(source);
  }
}

void ComparisonLegend::watch(pqPipelineSource* source)
{
  if (!isComparison(source))
  {
    return;
  }
  this->Connector->Connect(source->getProxy(), vtkCommand::UpdateEvent, this, SLOT(refresh()));
  QObject::connect(source, &pqPipelineSource::representationAdded, this,
    [this](pqPipelineSource*, pqDataRepresentation* display) { this->follow(display); });
  for (pqDataRepresentation* display : source->getRepresentations(nullptr))
  {
    this->follow(display);
  }
}

void ComparisonLegend::follow(pqDataRepresentation* display)
{
  if (display->getProxy()->GetProperty("SliceLegend"))
  {
    this->Connector->Connect(display->getProxy(), vtkCommand::UpdateEvent, this, SLOT(refresh()));
    this->refresh();
  }
}

void ComparisonLegend::refresh()
{
  pqServerManagerModel* model = serverManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (!isComparison(source))
    {
      continue;
    }
    for (pqDataRepresentation* display : source->getRepresentations(nullptr))
    {
      if (display->getProxy()->GetProperty("SliceLegend") && writeInto(display, source) &&
        display->isVisible() && display->getView())
      {
        display->getView()->render();
      }
    }
  }
}
}
