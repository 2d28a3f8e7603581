// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Tools/ToolPanel.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Commands/Commands.h"
#include "Interaction/Commands/Tools.h"
#include "Panel/Parts/Advice.h"
#include "Panel/Parts/ReachDrawing.h"
#include "Panel/Parts/ValueSlider.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QStringList>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace brainshift
{
namespace
{
using AxisHold = ToolSettings::AxisHold;
using Ground = ToolSettings::Ground;

QString millimetres(double value)
{
  return tr("%1 mm").arg(value, 0, 'g', 3);
}

bool isOfTool(const CommandRow& row, Tool tool)
{
  return std::find(row.tools.begin(), row.tools.end(), tool) != row.tools.end();
}

// The tool in hand has precedence over the slices for its own gestures.
bool isTakenByTool(const CommandRow& row, Tool tool)
{
  return row.mouse != Mouse::None &&
    commandOfMouse(Scope::Tool, tool, row.mouse, row.modifiers & Qt::ShiftModifier,
      row.modifiers & Qt::ControlModifier) != Command::None;
}

QString hintOf(const CommandRow& row, const ToolSettings& settings)
{
  QString hint = tr(row.hint);
  if (row.number)
  {
    hint = hint.arg(millimetres((settings.*row.number)()));
  }
  return tr("%1: %2.").arg(keysText(row), hint);
}

// One hint for each command. With a tool in hand there is room for one only: how to step through
// the slices.
QStringList sliceHints(const ToolSettings& settings)
{
  const Tool tool = settings.tool();
  QStringList hints;
  Command last = Command::None;
  for (const CommandRow& row : commandTable())
  {
    const bool fits = tool == Tool::None || row.command == Command::StepSlices;
    if (row.scope == Scope::Slices && *row.hint && fits && row.command != last &&
      !isTakenByTool(row, tool))
    {
      hints.append(hintOf(row, settings));
      last = row.command;
    }
  }
  return hints;
}

QString heldAxis(AxisHold axis)
{
  switch (axis)
  {
    case AxisHold::X:
      return tr("Held to X.");
    case AxisHold::Y:
      return tr("Held to Y.");
    case AxisHold::Z:
      return tr("Held to Z.");
    case AxisHold::None:
      break;
  }
  return {};
}
}

QString mouseHint(const ToolSettings& settings, ToolSettings::Ground ground)
{
  const Tool tool = settings.tool();
  QStringList hints;
  if (!settings.request().isEmpty())
  {
    return settings.request();
  }
  if (tool != Tool::None && !settings.shownInstead().isEmpty())
  {
    return tr(
      "%1. This view shows %2, which is not the selected volume. Click in the view to work on %2.")
      .arg(nameOf(tool), settings.shownInstead());
  }
  if (tool != Tool::None)
  {
    hints.append(
      (ground == Ground::Volume ? tr("%1.") : tr("%1 within the slice.")).arg(nameOf(tool)));
    for (const CommandRow& row : commandTable())
    {
      if (row.scope == Scope::Tool && *row.hint && isOfTool(row, tool))
      {
        hints.append(hintOf(row, settings));
      }
    }
  }
  else if (ground != Ground::FlatSlices)
  {
    return tr("No tool is in hand. The mouse moves the camera.");
  }
  if (ground == Ground::FlatSlices)
  {
    hints += sliceHints(settings);
  }
  hints.append(toolRow(tool).holdsAxes ? heldAxis(settings.axisHold()) : QString());
  hints.removeAll(QString());
  return hints.join(' ');
}

namespace
{
// The tool in hand has a frame: on dark palettes a pressed button hardly differs from others.
class ToolButton : public QToolButton
{
public:
  using QToolButton::QToolButton;

protected:
  void paintEvent(QPaintEvent* event) override
  {
    this->QToolButton::paintEvent(event);
    if (this->isChecked())
    {
      QPainter painter(this);
      painter.setRenderHint(QPainter::Antialiasing);
      painter.setPen(QPen(this->palette().color(QPalette::Highlight), 2.0));
      painter.drawRoundedRect(QRectF(this->rect()).adjusted(1.0, 1.0, -1.0, -1.0), 3.0, 3.0);
    }
  }
};

// None for a tool that takes single points.
Reach reachOf(const ToolSettings& settings)
{
  const StrokeShape shape = shapeOf(settings.tool());
  Reach reach;
  reach.weight = [sigma = settings.sigma()](double distance) { return falloff(distance, sigma); };
  if (shape == StrokeShape::Sphere)
  {
    reach.along = reach.across = settings.radius();
  }
  else if (shape == StrokeShape::Ellipsoid)
  {
    reach.hasAxis = true;
    reach.along = settings.majorRadius();
    reach.across = settings.minorRadius();
  }
  return reach;
}
}

struct ToolPanel::Value
{
  const char* name; // of the slider
  const char* label;
  int decimals;
  const char* tip;
  double (ToolSettings::*value)() const;
  ToolSettings::Range (ToolSettings::*range)() const;
  void (ToolSettings::*set)(double);
};

const QList<ToolPanel::Value>& ToolPanel::values()
{
  static const QList<Value> all{
    { "BrainShiftRadius", QT_TR_NOOP("Radius (mm)"), 1,
      QT_TR_NOOP("Tissue within this distance of the cursor moves, less towards the edge."),
      &ToolSettings::radius, &ToolSettings::radiusRange, &ToolSettings::setRadius },
    { "BrainShiftMajorRadius", QT_TR_NOOP("Radius along (mm)"), 1,
      QT_TR_NOOP("Distance from the centre of the stamp to its edge along the push (the major "
                 "radius). The push points to the point of interest."),
      &ToolSettings::majorRadius, &ToolSettings::radiusRange, &ToolSettings::setMajorRadius },
    { "BrainShiftMinorRadius", QT_TR_NOOP("Radius across (mm)"), 1,
      QT_TR_NOOP(
        "Distance from the centre of the stamp to its edge across the push (the minor radius)."),
      &ToolSettings::minorRadius, &ToolSettings::radiusRange, &ToolSettings::setMinorRadius },
    { "BrainShiftSigma", QT_TR_NOOP("Fullness (\u00d7 radius)"), 2,
      QT_TR_NOOP(
        "Width of the hill that the tissue forms. A small number makes a sharp peak at the centre, "
        "a large number a broad hill. The edge is always soft. (Sigma: the width of the Gaussian "
        "as a fraction of the radius.)"),
      &ToolSettings::sigma, &ToolSettings::sigmaRange, &ToolSettings::setSigma },
    { "BrainShiftMillimetresPerClick", QT_TR_NOOP("Per click (mm)"), 2,
      QT_TR_NOOP("One click of the mouse wheel pulls or pushes the tissue this far."),
      &ToolSettings::millimetresPerClick, &ToolSettings::millimetresPerClickRange,
      &ToolSettings::setMillimetresPerClick },
  };
  return all;
}

ToolPanel::ToolPanel(QWidget* parent)
  : QWidget(parent)
  , Drawing(new ReachDrawing(this))
  , Hint(new QLabel(this))
  , Warning(new QWidget(this))
  , WarningText(new QLabel(this->Warning))
{
  this->setObjectName("Tools");
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  this->addButtons(column);
  this->addSliders(column);
  this->Drawing->setObjectName("BrainShiftReach");
  column->addWidget(this->Drawing);
  this->addWarning(column);
  this->Hint->setObjectName("BrainShiftHint"); // last: the status line shows these words as well
  this->Hint->setWordWrap(true);
  column->addWidget(this->Hint);
  this->connect(ToolSettings::instance(), &ToolSettings::changed, this, &ToolPanel::refresh);
  this->refresh();
}

void ToolPanel::addButtons(QBoxLayout* column)
{
  auto row = new QHBoxLayout;
  for (const ToolRow& tool : toolTable())
  {
    auto button = new ToolButton(this);
    button->setObjectName("BrainShift" + tool.id());
    button->setText(nameOf(tool.tool));
    button->setIcon(QIcon(tool.icon()));
    button->setIconSize({ 24, 24 });
    button->setToolTip(tool.tip());
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    button->setFocusPolicy(Qt::StrongFocus);
    button->setCheckable(true);
    this->connect(button, &QToolButton::clicked, this,
      [tool = tool.tool](bool on) { ToolSettings::instance()->setTool(on ? tool : Tool::None); });
    row->addWidget(button);
    this->Buttons.append(button);
  }
  column->addLayout(row);
}

void ToolPanel::addSliders(QBoxLayout* column)
{
  int labelWidth = 0;
  for (const Value& value : values())
  {
    auto slider = new ValueSlider(value.name, tr(value.label), value.decimals, this);
    slider->setToolTip(tr(value.tip));
    this->connect(slider, &ValueSlider::valueEdited, this,
      [set = value.set](double number) { (ToolSettings::instance()->*set)(number); });
    column->addWidget(slider);
    this->Sliders.append(slider);
    labelWidth = std::max(labelWidth, slider->labelWidth());
  }
  for (ValueSlider* slider : this->Sliders)
  {
    slider->setLabelWidth(labelWidth);
  }
}

void ToolPanel::addWarning(QBoxLayout* column)
{
  this->Warning->setObjectName("Warning");
  auto row = new QHBoxLayout(this->Warning);
  row->setContentsMargins(0, 0, 0, 0);
  auto sign = new QLabel(this->Warning);
  sign->setPixmap(QIcon(":/BrainShift/warning.svg").pixmap(20, 20));
  row->addWidget(sign, 0, Qt::AlignTop);
  this->WarningText->setObjectName("BrainShiftWarning");
  this->WarningText->setWordWrap(true);
  row->addWidget(this->WarningText, 1);
  column->addWidget(this->Warning);
}

void ToolPanel::setLatticeSpacing(double spacing)
{
  if (spacing != this->LatticeSpacing)
  {
    this->LatticeSpacing = spacing;
    this->refresh();
  }
}

void ToolPanel::setReady(bool ready)
{
  if (ready != this->Ready)
  {
    this->Ready = ready;
    this->refresh();
  }
}

void ToolPanel::refresh()
{
  const ToolSettings& settings = *ToolSettings::instance();
  for (int i = 0; i < this->Buttons.size(); ++i)
  {
    this->Buttons[i]->setEnabled(this->Ready);
    this->Buttons[i]->setChecked(toolTable()[i].tool == settings.tool());
  }
  const auto& shown = toolRow(settings.tool()).numbers;
  for (int i = 0; i < this->Sliders.size(); ++i)
  {
    const Value& value = values()[i];
    const ToolSettings::Range range = (settings.*value.range)();
    this->Sliders[i]->setRange(range.least, range.most);
    this->Sliders[i]->setValue((settings.*value.value)());
    this->Sliders[i]->setVisible(std::find(shown.begin(), shown.end(), value.value) != shown.end());
  }
  const Reach reach = reachOf(settings);
  this->Drawing->setReach(reach);
  this->Drawing->setVisible(reach.along > 0.0);
  this->Hint->setText(this->Ready ? mouseHint(settings, ToolSettings::Ground::Volume)
                                  : tr("Press Apply to show the volume. Then choose a tool."));
  const QString warning = this->advice();
  this->WarningText->setText(warning);
  this->Warning->setVisible(!warning.isEmpty());
}

QString ToolPanel::advice() const
{
  const ToolSettings& settings = *ToolSettings::instance();
  switch (shapeOf(settings.tool()))
  {
    case StrokeShape::Sphere:
      return radiusAdvice(tr("The radius"), settings.radius(), this->LatticeSpacing);
    case StrokeShape::Ellipsoid:
    {
      const bool minorIsLess = settings.minorRadius() <= settings.majorRadius();
      return minorIsLess ? radiusAdvice(tr("The radius across the push"), settings.minorRadius(),
                             this->LatticeSpacing)
                         : radiusAdvice(tr("The radius along the push"), settings.majorRadius(),
                             this->LatticeSpacing);
    }
    default:
      return {};
  }
}
}
