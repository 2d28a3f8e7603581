// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Strokes/StrokeList.h"

#include "Common/Problem.h"
#include "Interaction/Commands/Tools.h"
#include "Interaction/Displays/SharedSettings.h"
#include "Panel/Parts/Advice.h"

#include <vtkSMDoubleVectorProperty.h>

#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double LeastLength = 0.01; // mm; at 0 a stroke would lose its direction
constexpr double MostLength = 10000.0;

// It goes along its axis, in both directions.
bool isAimed(const Stroke& stroke)
{
  return shapeOf(stroke.tool) == StrokeShape::Ellipsoid;
}

bool hasNumber(const Stroke& stroke, int column)
{
  switch (column)
  {
    case StrokeModel::AmountColumn:
      return true;
    case StrokeModel::MajorColumn:
      return shapeOf(stroke.tool) != StrokeShape::Point;
    case StrokeModel::MinorColumn:
      return isAimed(stroke);
    default:
      return false;
  }
}

double numberIn(const Stroke& stroke, int column)
{
  switch (column)
  {
    case StrokeModel::MajorColumn:
      return stroke.major;
    case StrokeModel::MinorColumn:
      return stroke.minor;
    default:
      return amountOf(stroke);
  }
}

double leastNumber(const Stroke& stroke, int column)
{
  const bool bothWays = column == StrokeModel::AmountColumn && isAimed(stroke);
  return bothWays ? -MostLength : LeastLength;
}

// Unit vector along which the amount is counted. Zero if the stroke has no direction.
glm::dvec3 directionOf(const Stroke& stroke)
{
  const glm::dvec3 along = isAimed(stroke) ? -stroke.axis : stroke.vector;
  const double length = glm::length(along);
  return length > 0.0 ? along / length : glm::dvec3(0.0);
}
}

double amountOf(const Stroke& stroke)
{
  return glm::dot(stroke.vector, directionOf(stroke));
}

Stroke withAmount(Stroke stroke, double amount)
{
  stroke.vector = amount * directionOf(stroke);
  return stroke;
}

StrokeModel::StrokeModel(vtkSMDoubleVectorProperty* strokes, Write write, QObject* parent)
  : ListModel(
      {
        { tr("Stroke"), tr("Number and tool. The check mark enables the stroke."), true },
        { tr("Amount"),
          tr("The displacement at the centre (mm). A positive Stamp pulls, a negative Stamp "
             "pushes.") },
        { tr("Reached"),
          tr("Achieved displacement of the tissue at the centre (mm), at full Strength") },
        { tr("Along"), tr("Stamp: the radius along the push (mm). Soft: the radius (mm).") },
        { tr("Across"), tr("Stamp: the radius across the push (mm)") },
        { tr("Position"), tr("The position of the stroke: x, y, z (mm, world axes)"), true },
      },
      parent)
  , Property(strokes)
  , WriteStrokes(std::move(write))
{
  this->update();
}

void StrokeModel::update()
{
  std::string problem;
  this->strokes(problem);
  this->Problem = QString::fromStdString(problem);
  this->Strokes = problem.empty()
    ? static_cast<int>(this->Property->GetNumberOfElements()) / NumbersPerStroke
    : 0;
  this->announce();
  Q_EMIT this->updated();
}

void StrokeModel::setLatticeSpacing(double spacing)
{
  if (this->LatticeSpacing != spacing)
  {
    this->LatticeSpacing = spacing;
    this->update();
  }
}

void StrokeModel::setAppliedShares(const std::vector<double>& shares)
{
  if (this->AppliedShares != shares)
  {
    this->AppliedShares = shares;
    this->update();
  }
}

void StrokeModel::setReaches(const std::vector<double>& reaches)
{
  if (this->Reaches != reaches)
  {
    this->Reaches = reaches; // at each step of a drag: the strokes are not read again
    this->announceColumn(ReachColumn);
  }
}

// mm, with the sign of the amount. None for a disabled stroke.
std::optional<double> StrokeModel::reach(int row, const Stroke& stroke) const
{
  const std::size_t place = static_cast<std::size_t>(row);
  if (!stroke.enabled || place >= this->Reaches.size())
  {
    return std::nullopt;
  }
  return amountOf(stroke) < 0.0 ? -this->Reaches[place] : this->Reaches[place];
}

std::vector<Stroke> StrokeModel::strokes(std::string& problem) const
{
  const double* numbers = this->Property->GetElements();
  std::vector<Stroke> strokes;
  problem = problemOf([&] {
    strokes = strokesFromNumbers(
      std::vector<double>(numbers, numbers + this->Property->GetNumberOfElements()));
  });
  return strokes;
}

Stroke StrokeModel::stroke(int row) const
{
  if ((row + 1) * NumbersPerStroke > static_cast<int>(this->Property->GetNumberOfElements()))
  {
    return {}; // the property is ahead of the model
  }
  const double* numbers = this->Property->GetElements() + row * NumbersPerStroke;
  Stroke stroke; // the default one if the numbers are bad
  problemOf([&] {
    stroke = strokesFromNumbers(std::vector<double>(numbers, numbers + NumbersPerStroke)).front();
  });
  return stroke;
}

void StrokeModel::write(const std::function<void(std::vector<Stroke>&)>& edit, const QString& label)
{
  std::string problem;
  std::vector<Stroke> strokes = this->strokes(problem);
  if (problem.empty())
  {
    edit(strokes);
    this->WriteStrokes(strokes, label);
  }
}

void StrokeModel::setOn(const QList<int>& rows, bool on)
{
  this->write(
    [&rows, on](std::vector<Stroke>& strokes) {
      for (const int row : rows)
      {
        strokes.at(row).enabled = on;
      }
    },
    on ? tr("Enable Strokes") : tr("Disable Strokes"));
}

void StrokeModel::removeRowsOf(const QList<int>& rows)
{
  QList<int> fromLast = rows;
  std::sort(fromLast.begin(), fromLast.end(), std::greater<int>());
  this->write(
    [&fromLast](std::vector<Stroke>& strokes) {
      for (const int row : fromLast)
      {
        strokes.erase(strokes.begin() + row);
      }
    },
    tr("Delete Strokes"));
}

void StrokeModel::removeAll()
{
  this->WriteStrokes({}, tr("Reset All Strokes"));
}

std::optional<ListModel::Number> StrokeModel::number(int row, int column) const
{
  const Stroke stroke = this->stroke(row);
  const bool directed = column != AmountColumn || directionOf(stroke) != glm::dvec3(0.0);
  if (!hasNumber(stroke, column) || !directed)
  {
    return std::nullopt;
  }
  return Number{ numberIn(stroke, column), leastNumber(stroke, column), MostLength };
}

void StrokeModel::change(int row, int column, double number)
{
  this->write(
    [row, column, number](std::vector<Stroke>& strokes) {
      Stroke& stroke = strokes.at(row);
      switch (column)
      {
        case MajorColumn:
          stroke.major = number;
          break;
        case MinorColumn:
          stroke.minor = number;
          break;
        default:
          stroke = withAmount(stroke, number);
      }
    },
    tr("Change Stroke"));
}

QString StrokeModel::text(int row, int column) const
{
  const Stroke stroke = this->stroke(row);
  switch (column)
  {
    case ToolColumn:
      return tr("%1 %2").arg(row + 1).arg(nameOf(stroke.tool));
    case ReachColumn:
    {
      const std::optional<double> reached = this->reach(row, stroke);
      return reached ? QString::number(*reached, 'f', 1) : QString();
    }
    case WhereColumn:
      return positionText(stroke.anchor, 0);
    default:
      return hasNumber(stroke, column) ? QString::number(numberIn(stroke, column), 'f', 1)
                                       : QString();
  }
}

QString StrokeModel::warning(int row, int column) const
{
  const Stroke stroke = this->stroke(row);
  if (column == ReachColumn)
  {
    const std::optional<double> reached = this->reach(row, stroke);
    return reached ? reachAdvice(amountOf(stroke), *reached) : QString();
  }
  if (!hasNumber(stroke, column))
  {
    return {};
  }
  const double number = numberIn(stroke, column);
  if (column == AmountColumn)
  {
    const std::size_t place = static_cast<std::size_t>(row);
    return guardAdvice(
      number, place < this->AppliedShares.size() ? this->AppliedShares[place] : 1.0);
  }
  const QString name = column == MinorColumn      ? tr("The radius across the push")
    : shapeOf(stroke.tool) == StrokeShape::Sphere ? tr("The radius")
                                                  : tr("The radius along the push");
  return radiusAdvice(name, number, this->LatticeSpacing);
}

QString StrokeModel::toolTip(int row, int) const
{
  const Stroke stroke = this->stroke(row);
  QString tip =
    tr("%1 at %2 mm, displacement %3 mm")
      .arg(nameOf(stroke.tool), positionText(stroke.anchor, 2), positionText(stroke.vector, 2));
  if (shapeOf(stroke.tool) != StrokeShape::Point)
  {
    tip += tr(", fullness %1 (sigma)").arg(stroke.sigma);
  }
  return stroke.enabled ? tip : tip + tr(" (disabled)");
}

StrokeList::StrokeList(StrokeModel* model, QWidget* parent)
  : QWidget(parent)
  , Strokes(model)
  , Tree(new ListTree(model,
      { 4, 9, tr("There are no strokes yet. Choose a tool, then work on the volume in the view.") },
      this))
  , Problem(new QLabel(this))
  , Delete(makeListButton(this, "BrainShiftDelete", tr("Delete"),
      tr("Delete the selected strokes (Delete key). Ctrl+Z brings them back."),
      ":/BrainShift/delete.svg"))
  , Reset(makeListButton(this, "BrainShiftReset", tr("Reset All"),
      tr("Delete all strokes. Ctrl+Z brings them back."), ":/BrainShift/reset.svg"))
{
  this->setObjectName("List");
  this->Tree->setObjectName("BrainShiftStrokes");
  this->Tree->setAccessibleName(tr("Strokes"));
  this->Problem->setObjectName("BrainShiftProblem");
  this->Problem->setWordWrap(true);

  auto buttons = new QHBoxLayout;
  for (QToolButton* button : { this->Delete, this->Reset })
  {
    buttons->addWidget(button);
    this->connect(button, &QToolButton::pressed, this, &StrokeList::giveFocusBack);
  }
  buttons->addStretch();
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->Problem);
  column->addWidget(this->Tree);
  column->addLayout(buttons);

  this->connect(this->Delete, &QToolButton::clicked, this->Tree, &ListTree::removeSelected);
  this->connect(this->Reset, &QToolButton::clicked, model, &StrokeModel::removeAll);
  this->connect(this->Tree, &ListTree::selectedRowsChanged, this, &StrokeList::refresh);
  this->connect(model, &StrokeModel::updated, this, &StrokeList::refresh);
  this->connect(qApp, &QApplication::focusChanged, this, [this](QWidget* before, QWidget* now) {
    this->FocusBefore = now && now->isAncestorOf(this) ? before : nullptr;
  });
  this->refresh();
}

void StrokeList::refresh()
{
  const QString& problem = this->Strokes->problem();
  this->Problem->setText(problem);
  this->Problem->setVisible(!problem.isEmpty());
  QPalette palette = this->palette();
  palette.setColor(QPalette::WindowText, gradeColor(Grade::Bad, palette, wantsBlueAndOrange()));
  this->Problem->setPalette(palette);
  this->enable(this->Delete, !this->Tree->selectedRows().isEmpty());
  this->enable(this->Reset, this->Strokes->rowCount() > 0 || !problem.isEmpty());
}

// Qt offers a click that the button does not want the focus for to the panel around it.
void StrokeList::giveFocusBack()
{
  QWidget* focus = QApplication::focusWidget();
  if (this->FocusBefore && focus && focus->isAncestorOf(this))
  {
    this->FocusBefore->setFocus();
  }
}

// Qt takes the focus from a button that is disabled to whatever comes next in the panel.
void StrokeList::enable(QToolButton* button, bool enabled)
{
  if (!enabled && button->hasFocus())
  {
    this->Tree->setFocus();
  }
  button->setEnabled(enabled);
}
}
