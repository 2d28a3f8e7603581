// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Pointer/PointerText.h"

#include "Interaction/Commands/Translated.h"
#include "Interaction/Pointer/Pointer.h"

#include <QStringList>

#include <cmath>

namespace brainshift
{
namespace
{

bool isOld(const Pointer& pointer)
{
  return pointer.age().value_or(0.0) > Pointer::OldSeconds;
}

QString sentence(const std::string& problem)
{
  return problem.empty() ? QString() : QString::fromStdString(problem) + ".";
}

// What was lost on the way, if anything was.
QString lossText(const SourceState& state)
{
  QStringList parts;
  if (state.badChecksums > 0)
  {
    parts.append(tr("%1 damaged (checksum)").arg(state.badChecksums));
  }
  if (state.refused > 0)
  {
    parts.append(tr("%1 without a valid pose").arg(state.refused));
  }
  if (state.overrun > 0)
  {
    parts.append(tr("%1 skipped").arg(state.overrun));
  }
  return parts.isEmpty() ? QString() : "\n" + tr("Messages lost: %1").arg(parts.join(", "));
}

QString runningText(const Pointer& pointer)
{
  const SourceState& state = pointer.state();
  const auto age = pointer.age();
  if (!age)
  {
    return tr("Connected. No pose has come yet.");
  }
  const QString device = QString::fromStdString(state.device);
  if (!state.visible)
  {
    return tr("%1 is not visible. Last pose %2 s ago.").arg(device).arg(*age, 0, 'f', 1);
  }
  if (isOld(pointer))
  {
    return tr("No news of %1. Last pose %2 s ago.").arg(device).arg(*age, 0, 'f', 1);
  }
  return tr("%1: %2 Hz, %3 s old").arg(device).arg(state.rate, 0, 'f', 0).arg(*age, 0, 'f', 2);
}
}

QString connectionText(const Pointer& pointer)
{
  const SourceState& state = pointer.state();
  switch (state.phase)
  {
    case SourceState::Phase::Connecting:
      return state.problem.empty() ? tr("Connecting...")
                                   : tr("%1 Trying again.").arg(sentence(state.problem));
    case SourceState::Phase::Running:
      return runningText(pointer) + lossText(state);
    case SourceState::Phase::Ended:
      break;
  }
  return state.problem.empty() ? tr("Not connected") : sentence(state.problem) + lossText(state);
}

bool warnsOf(const Pointer& pointer)
{
  const SourceState& state = pointer.state();
  if (state.phase == SourceState::Phase::Running)
  {
    return pointer.age() && (!state.visible || isOld(pointer));
  }
  return !state.problem.empty() && !pointer.isReplay();
}

QString distanceText(const Pointer& pointer)
{
  if (!pointer.tip() || isOld(pointer))
  {
    return QStringLiteral("\u2013 mm");
  }
  if (!pointer.distance())
  {
    return pointer.distanceProblem().isEmpty() ? tr("no cortex here") : pointer.distanceProblem();
  }
  const double distance = pointer.distance().value_or(0.0);
  return tr(distance < 0.0 ? "%1 mm inside" : "%1 mm outside").arg(std::abs(distance), 0, 'f', 1);
}

QString placeText(const Pointer& pointer)
{
  if (!pointer.tip() || isOld(pointer))
  {
    return {};
  }
  const glm::dvec3 tip = pointer.tip().value_or(glm::dvec3(0.0));
  return tr("Tip at %1 %2 %3 mm").arg(tip.x, 0, 'f', 1).arg(tip.y, 0, 'f', 1).arg(tip.z, 0, 'f', 1);
}
}
