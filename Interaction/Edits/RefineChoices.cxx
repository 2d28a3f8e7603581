// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/RefineChoices.h"

#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"

#include <pqPipelineSource.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>

#include <QCoreApplication>
#include <QStringList>

#include <cstring>

namespace brainshift
{
namespace
{
QString tr(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}

void setInput(vtkSMProxy* filter, const char* name, pqPipelineSource* source)
{
  if (source)
  {
    vtkSMPropertyHelper(filter, name).Set(source->getProxy());
  }
}
}

bool isComparison(pqPipelineSource* source)
{
  return source && std::strcmp(source->getProxy()->GetXMLName(), "CompareVolumes") == 0;
}

QList<pqPipelineSource*> comparisonsOf(pqPipelineSource* deformation)
{
  QList<pqPipelineSource*> visited{ deformation };
  QList<pqPipelineSource*> found;
  for (int next = 0; next < visited.size(); ++next)
  {
    for (pqPipelineSource* consumer : visited[next]->getAllConsumers())
    {
      // A second deformation moves the tissue again; and a comparison may have it as its reference.
      if (visited.contains(consumer) || isDeformation(consumer) ||
        deformationUpstream(consumer) != deformation)
      {
        continue;
      }
      visited.append(consumer);
      if (isComparison(consumer))
      {
        found.append(consumer);
      }
    }
  }
  return found;
}

QList<SimilarityChoice> similaritiesFor(pqPipelineSource* source)
{
  const vtkSmartPointer<vtkSMProxy> run = makeReport(source->getProxy(), "RegistrationRun");
  const QStringList labels = textOf(run, "SimilarityLabels").split('\n');
  const QStringList tooltips = textOf(run, "SimilarityTooltips").split('\n');
  QList<SimilarityChoice> choices;
  for (qsizetype i = 0; i < labels.size() && i < tooltips.size(); ++i)
  {
    choices.append({ labels[i], tooltips[i] });
  }
  return choices;
}

QString whyNot(pqPipelineSource* deformation, const RefineSettings& settings)
{
  if (deformation->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return tr("%1 was not applied yet. Press Apply first.").arg(deformation->getSMName());
  }
  if (!settings.reference)
  {
    return tr("There is no reference. Open the volume that %1 should match.")
      .arg(deformation->getSMName());
  }
  if (settings.reference->getServer() != deformation->getServer())
  {
    return tr("%1 is on another server than %2.")
      .arg(settings.reference->getSMName(), deformation->getSMName());
  }
  return {};
}

vtkSmartPointer<vtkSMProxy> comparisonFor(
  pqPipelineSource* deformation, const RefineSettings& settings)
{
  if (isComparison(settings.reference))
  {
    return settings.reference->getProxy();
  }
  vtkSMProxy* proxy = deformation->getProxy();
  auto made =
    vtk::TakeSmartPointer(proxy->GetSessionProxyManager()->NewProxy("filters", "CompareVolumes"));
  made->PrototypeOn(); // so that it is no step to undo
  setInput(made, "Input", deformation);
  setInput(made, "Reference", settings.reference);
  setInput(made, "Cavity", settings.cavity);
  made->UpdateVTKObjects();
  return made;
}
}
