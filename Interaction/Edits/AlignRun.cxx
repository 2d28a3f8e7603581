// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/AlignRun.h"

#include "Interaction/Views/Reports.h"

#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkPVDataInformation.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSession.h>
#include <vtkSMSourceProxy.h>

#include <QCoreApplication>

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <cstddef>
#include <vector>

namespace brainshift
{
namespace
{
constexpr std::size_t NumberOfFigures = 9; // of vtkRegistrationRun
constexpr std::size_t NumbersOfMotion = 16;

// Fields of the panel hold these digits of mm and degrees; it is below what an alignment can tell.
constexpr double Digits = 1e4;

QString tr(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}
}

RigidMotion motionOf(vtkSMProxy* compare)
{
  RigidMotion motion;
  vtkSMPropertyHelper(compare, "ReferenceRotation").Get(&motion.rotation[0], 3);
  vtkSMPropertyHelper(compare, "ReferenceTranslation").Get(&motion.translation[0], 3);
  vtkSMProxy* reference = vtkSMPropertyHelper(compare, "Reference").GetAsProxy();
  if (auto source = vtkSMSourceProxy::SafeDownCast(reference))
  {
    double bounds[6];
    source->GetDataInformation(vtkSMPropertyHelper(compare, "Reference").GetOutputPort())
      ->GetBounds(bounds);
    motion.middle =
      0.5 * glm::dvec3(bounds[0] + bounds[1], bounds[2] + bounds[3], bounds[4] + bounds[5]);
  }
  return motion;
}

QString AlignRun::begin(pqPipelineSource* compare)
{
  *this = {};
  if (compare->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return tr("%1 was not applied yet. Press Apply first.").arg(compare->getSMName());
  }
  SCOPED_UNDO_EXCLUDE();
  vtkSMSourceProxy::SafeDownCast(compare->getProxy())->UpdatePipeline();
  this->Start = motionOf(compare->getProxy());
  this->Proxy = makeReport(compare->getProxy(), "RegistrationRun");
  pointAt(this->Proxy, "Source", compare->getProxy());
  this->Proxy->UpdateVTKObjects();
  this->Proxy->InvokeCommand("BeginAlignment");
  const QString problem = textOf(this->Proxy, "Problem");
  return problem.isEmpty() ? QString() : problem + ".";
}

bool AlignRun::step()
{
  if (!this->Proxy || !this->Proxy->GetSession()->GetIsAlive())
  {
    return false;
  }
  this->Proxy->InvokeCommand("Step");
  const std::vector<double> numbers = answerOf(this->Proxy, "Figures");
  if (numbers.size() < NumberOfFigures)
  {
    return false;
  }
  AlignFigures& at = this->Figures;
  at.lines = static_cast<int>(numbers[1]);
  at.compared = numbers[3];
  at.information = numbers[4];
  at.informationBefore = numbers[5];
  at.shift = numbers[6];
  at.turn = numbers[7];
  at.done = numbers[8];
  return true;
}

RigidMotion AlignRun::motion() const
{
  const std::vector<double> rows = answerOf(this->Proxy, "Motion");
  if (rows.size() != NumbersOfMotion)
  {
    return this->Start;
  }
  const glm::dmat4 further = glm::transpose(glm::make_mat4(rows.data()));
  RigidMotion motion = followedBy(this->Start, glm::dmat3(further), glm::dvec3(further[3]));
  motion.rotation = glm::round(motion.rotation * Digits) / Digits;
  motion.translation = glm::round(motion.translation * Digits) / Digits;
  return motion;
}
}
