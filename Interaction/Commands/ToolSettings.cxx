// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Commands/ToolSettings.h"

#include <pqApplicationCore.h>
#include <pqSettings.h>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
double clamped(double value, const ToolSettings::Range& range)
{
  return std::clamp(value, range.least, range.most);
}

QString keyOf(const char* name)
{
  return QString("BrainShift/%1").arg(name);
}

void restore(const char* name, double& kept)
{
  bool isNumber = false;
  const double value =
    pqApplicationCore::instance()->settings()->value(keyOf(name)).toDouble(&isNumber);
  if (isNumber && std::isfinite(value) && value > 0.0)
  {
    kept = value;
  }
}
}

ToolSettings* ToolSettings::instance()
{
  static ToolSettings* settings = new ToolSettings; // a child of the application, which deletes it
  return settings;
}

ToolSettings::ToolSettings()
  : QObject(pqApplicationCore::instance())
{
  this->setObjectName("BrainShiftToolSettings");
  restore("Radius", this->Radius);
  restore("MajorRadius", this->MajorRadius);
  restore("MinorRadius", this->MinorRadius);
  restore("Sigma", this->Sigma);
  restore("MillimetresPerClick", this->PerClick);
}

double ToolSettings::radius() const
{
  return clamped(this->Radius, this->radiusRange());
}

double ToolSettings::majorRadius() const
{
  return clamped(this->MajorRadius, this->radiusRange());
}

double ToolSettings::minorRadius() const
{
  return clamped(this->MinorRadius, this->radiusRange());
}

double ToolSettings::sigma() const
{
  return clamped(this->Sigma, this->sigmaRange());
}

double ToolSettings::millimetresPerClick() const
{
  return clamped(this->PerClick, this->millimetresPerClickRange());
}

ToolSettings::Range ToolSettings::radiusRange() const
{
  // Below half the spacing a sphere can fit between the control points and move none.
  const double least = std::min(this->Spacing, this->Diagonal) / 2.0;
  return { least, this->Diagonal / 2.0 };
}

ToolSettings::Range ToolSettings::sigmaRange() const
{
  return { 0.05, 2.0 };
}

ToolSettings::Range ToolSettings::millimetresPerClickRange() const
{
  return { this->Diagonal / 4000.0, this->Diagonal / 20.0 };
}

void ToolSettings::suggestRanges(double diagonal, double spacing)
{
  if (diagonal > 0.0 && spacing > 0.0 && (diagonal != this->Diagonal || spacing != this->Spacing))
  {
    this->Diagonal = diagonal;
    this->Spacing = spacing;
    Q_EMIT this->changed();
  }
}

void ToolSettings::setTool(Tool tool)
{
  if (tool != this->ToolInHand)
  {
    this->ToolInHand = tool;
    this->HeldAxis = AxisHold::None;
    Q_EMIT this->changed();
  }
}

void ToolSettings::setAxisHold(AxisHold axis)
{
  if (axis != this->HeldAxis)
  {
    this->HeldAxis = axis;
    Q_EMIT this->changed();
  }
}

void ToolSettings::setGround(Ground ground)
{
  if (ground != this->GroundNow)
  {
    this->GroundNow = ground;
    Q_EMIT this->changed();
  }
}

void ToolSettings::setShownInstead(const QString& name)
{
  if (name != this->ShownInstead)
  {
    this->ShownInstead = name;
    Q_EMIT this->changed();
  }
}

void ToolSettings::setRequest(const QString& request)
{
  if (request != this->Request)
  {
    this->Request = request;
    Q_EMIT this->changed();
  }
}

void ToolSettings::keep(const char* name, double& kept, double value, const Range& range)
{
  if (std::isfinite(value) && clamped(value, range) != kept)
  {
    kept = clamped(value, range);
    pqApplicationCore::instance()->settings()->setValue(keyOf(name), kept);
    Q_EMIT this->changed();
  }
}

void ToolSettings::setRadius(double millimetres)
{
  this->keep("Radius", this->Radius, millimetres, this->radiusRange());
}

void ToolSettings::setMajorRadius(double millimetres)
{
  this->keep("MajorRadius", this->MajorRadius, millimetres, this->radiusRange());
}

void ToolSettings::setMinorRadius(double millimetres)
{
  this->keep("MinorRadius", this->MinorRadius, millimetres, this->radiusRange());
}

void ToolSettings::setSigma(double fraction)
{
  this->keep("Sigma", this->Sigma, fraction, this->sigmaRange());
}

void ToolSettings::setMillimetresPerClick(double millimetres)
{
  this->keep("MillimetresPerClick", this->PerClick, millimetres, this->millimetresPerClickRange());
}
}
