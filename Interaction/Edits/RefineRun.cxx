// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/RefineRun.h"

#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"

#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMSession.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>

#include <QCoreApplication>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace brainshift
{
namespace
{
constexpr int Ultrasound = 2; // of the property Similarity

constexpr std::size_t NumberOfFigures = 9; // of vtkRegistrationRun

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

// A Compare Volumes that is there only until the run has read its output.
vtkSmartPointer<vtkSMProxy> comparisonFor(
  pqPipelineSource* deformation, const RefineSettings& settings)
{
  vtkSMProxy* proxy = deformation->getProxy();
  auto made =
    vtk::TakeSmartPointer(proxy->GetSessionProxyManager()->NewProxy("filters", "CompareVolumes"));
  made->PrototypeOn(); // a question is no step to undo
  setInput(made, "Input", deformation);
  setInput(made, "Reference", settings.reference);
  setInput(made, "Cavity", settings.cavity);
  made->UpdateVTKObjects();
  return made;
}

// Why it cannot begin, as far as the client knows.
QString refusal(pqPipelineSource* deformation, const RefineSettings& settings)
{
  if (deformation->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return tr("%1 was not applied yet. Press Apply first.").arg(deformation->getSMName());
  }
  if (!settings.reference)
  {
    return tr("There is no reference. Open the volume that %1 should agree with.")
      .arg(deformation->getSMName());
  }
  if (settings.reference->getServer() != deformation->getServer())
  {
    return tr("%1 lies on another server than %2.")
      .arg(settings.reference->getSMName(), deformation->getSMName());
  }
  return {};
}
}

bool isComparison(pqPipelineSource* source)
{
  return source && std::strcmp(source->getProxy()->GetXMLName(), "CompareVolumes") == 0;
}

QList<pqPipelineSource*> comparisonsOf(pqPipelineSource* deformation)
{
  QList<pqPipelineSource*> reached{ deformation };
  QList<pqPipelineSource*> found;
  for (int next = 0; next < reached.size(); ++next)
  {
    for (pqPipelineSource* consumer : reached[next]->getAllConsumers())
    {
      // What another one bends again lies elsewhere; and a comparison may take it as its reference.
      if (reached.contains(consumer) || isDeformation(consumer) ||
        deformationUpstream(consumer) != deformation)
      {
        continue;
      }
      reached.append(consumer);
      if (isComparison(consumer))
      {
        found.append(consumer);
      }
    }
  }
  return found;
}

QString RefineRun::begin(pqPipelineSource* deformation, const RefineSettings& settings)
{
  *this = {};
  const QString refused = refusal(deformation, settings);
  if (!refused.isEmpty())
  {
    return refused;
  }
  SCOPED_UNDO_EXCLUDE();
  vtkSmartPointer<vtkSMProxy> compared = settings.reference->getProxy();
  if (!isComparison(settings.reference))
  {
    compared = comparisonFor(deformation, settings);
  }
  vtkSMSourceProxy::SafeDownCast(compared)->UpdatePipeline();
  this->Proxy = makeReport(deformation->getProxy(), "RegistrationRun");
  pointAt(this->Proxy, "Source", compared);
  vtkSMPropertyHelper(this->Proxy, "Similarity").Set(settings.similarity);
  this->Figures.isBySweep = settings.similarity == Ultrasound;
  vtkSMPropertyHelper(this->Proxy, "Stiffness").Set(settings.stiffness);
  this->Proxy->UpdateVTKObjects();
  this->Proxy->InvokeCommand("BeginRefinement");
  const QString problem = textOf(this->Proxy, "Problem");
  this->Start = answerOf(this->Proxy, "ControlPoints");
  this->Points = this->Start;
  return problem.isEmpty() ? QString() : problem + ".";
}

bool RefineRun::step()
{
  if (!this->Proxy || !this->Proxy->GetSession()->GetIsAlive())
  {
    return false;
  }
  this->Proxy->InvokeCommand("Step");
  const std::vector<double> numbers = answerOf(this->Proxy, "Figures");
  this->Points = answerOf(this->Proxy, "ControlPoints");
  if (numbers.size() < NumberOfFigures || this->Points.size() != this->Start.size())
  {
    return false;
  }
  RefineFigures& at = this->Figures;
  const bool isMoved = static_cast<int>(numbers[1]) > at.steps; // else it prepared a level
  at.steps = static_cast<int>(numbers[1]);
  at.compared = numbers[3];
  at.disagreement = numbers[4];
  at.disagreementBefore = numbers[5];
  at.share = numbers[7];
  at.done = numbers[8];
  if (isMoved)
  {
    this->Shares.append(
      at.disagreementBefore > 0.0 ? at.disagreement / at.disagreementBefore : 1.0);
    this->measureChange();
  }
  return true;
}

void RefineRun::measureChange()
{
  const std::vector<double>& before = this->Start;
  double largest = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < before.size(); i += 3)
  {
    const double change = std::hypot(this->Points[i] - before[i],
      this->Points[i + 1] - before[i + 1], this->Points[i + 2] - before[i + 2]);
    largest = std::max(largest, change);
    sum += change;
  }
  this->Figures.largestChange = largest;
  this->Figures.meanChange = before.empty() ? 0.0 : 3.0 * sum / static_cast<double>(before.size());
}
}
