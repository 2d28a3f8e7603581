// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Landmarks/LandmarkTable.h"

#include "Interaction/Commands/ToolSettings.h"
#include "Interaction/Displays/SharedSettings.h"
#include "Interaction/Landmarks/LandmarkList.h"
#include "Interaction/Landmarks/LandmarkPicker.h"
#include "Panel/Parts/Advice.h"

#include <pqPipelineSource.h>

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
QString millimetres(double value)
{
  return std::isfinite(value) ? QString::number(value, 'f', 2) : QString(QChar(0x2013));
}
}

LandmarkModel::LandmarkModel(LandmarkList* list, QObject* parent)
  : ListModel(
      {
        { tr("Landmark"),
          tr("Number of the pair, and its name if the file has one. The check mark includes the "
             "pair in the fit."),
          true },
        { tr("Residual"),
          tr("Distance from the measured position to the position after the fit (mm)") },
        { tr("Leave-one-out"),
          tr("Leave-one-out error: distance from the measured position to the prediction of a fit "
             "without this pair (mm), before fold guard and mask. A fit never includes a pair that "
             "is switched off.") },
      },
      parent)
  , List(list)
{
  this->connect(list, &LandmarkList::changed, this, &LandmarkModel::announce);
  this->announce();
}

int LandmarkModel::count() const
{
  return this->List ? static_cast<int>(this->List->rows().size()) : 0;
}

bool LandmarkModel::isOn(int row) const
{
  return this->List && this->List->rows()[row].on;
}

void LandmarkModel::setOn(const QList<int>& rows, bool on)
{
  if (this->List)
  {
    this->List->setOn(rows, on);
  }
}

void LandmarkModel::removeRowsOf(const QList<int>& rows)
{
  if (this->List)
  {
    this->List->remove(rows);
  }
}

bool LandmarkModel::isBold(int row) const
{
  return this->List->figures().worst == row;
}

QString LandmarkModel::text(int row, int column) const
{
  const LandmarkRow& landmark = this->List->rows()[row];
  switch (column)
  {
    case ResidualColumn:
      return millimetres(landmark.residual);
    case LeftOutColumn:
      return millimetres(landmark.leftOut);
    default:
      // Omit a name that only repeats the number.
      return landmark.name.isEmpty() || landmark.name == QString::number(row + 1)
        ? QString::number(row + 1)
        : tr("%1 %2").arg(row + 1).arg(landmark.name);
  }
}

QString LandmarkModel::warning(int row, int column) const
{
  return column == LeftOutColumn && this->isBold(row) ? this->toolTip(row, column) : QString();
}

QString LandmarkModel::toolTip(int row, int column) const
{
  const LandmarkRow& landmark = this->List->rows()[row];
  if (this->isBold(row))
  {
    return tr("This pair fits worst. Its leave-one-out error is %1 mm. Check it, or switch it off.")
      .arg(millimetres(landmark.leftOut));
  }
  if (!landmark.on && column == LeftOutColumn)
  {
    return tr("Switched off. Its distance from the fit of the other pairs is %1 mm.")
      .arg(millimetres(landmark.leftOut));
  }
  return tr("Rest position %1 mm, measured position %2 mm. %3")
    .arg(positionText(landmark.rest, 1), positionText(landmark.measured, 1),
      landmark.isPicked() ? tr("It was picked in the window.") : tr("It comes from a file."));
}

namespace
{
QString bold(const QString& text)
{
  return "<b>" + text + "</b>";
}
}

LandmarkTable::LandmarkTable(LandmarkList* list, QWidget* parent)
  : QWidget(parent)
  , Landmarks(list)
  , Model(new LandmarkModel(list, this))
  , Tree(new ListTree(this->Model, { 3, 9, {} }, this))
  , Problem(new QLabel(this))
  , Request(new QLabel(this))
  , Figures(new QLabel(this))
  , Pick(makeListButton(this, "BrainShiftPickPairs", tr("Pick Pairs"),
      tr("Pick pairs of landmarks: click a position in the deformed volume, then the same position "
         "in the reference. Drags and the wheel work as usual. Press the button again or Escape to "
         "stop.")))
  , GoTo(makeListButton(this, "BrainShiftGoTo", tr("Go To"),
      tr("Bring the slices of all views to the selected landmark (double-click)")))
  , Delete(makeListButton(this, "BrainShiftLandmarkDelete", tr("Delete"),
      tr("Delete the selected picked pairs (Delete key). Pairs from a file remain. Clear their "
         "check marks to switch them off.")))
  , Marks(new QCheckBox(tr("Marks"), this))
{
  this->Tree->setObjectName("BrainShiftLandmarks");
  this->Tree->setAccessibleName(tr("Landmarks"));
  this->Problem->setObjectName("BrainShiftLandmarkProblem");
  this->Request->setObjectName("BrainShiftLandmarkRequest");
  this->Figures->setObjectName("BrainShiftLandmarkFigures");
  this->Figures->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  for (QLabel* label : { this->Problem, this->Request, this->Figures })
  {
    label->setWordWrap(true);
  }
  this->Pick->setCheckable(true);
  this->Marks->setObjectName("BrainShiftLandmarkMarks");
  this->Marks->setToolTip(
    tr("Mark the landmarks in the views: a ring at the drawn position of the tissue, a cross at "
       "its measured position, and a line from the cross to its position after the fit. A 2D view "
       "marks landmarks within 2.5 mm of its slice."));
  this->layOut();
  this->connect(this->Pick, &QToolButton::clicked, this, &LandmarkTable::pick);
  this->connect(this->GoTo, &QToolButton::clicked, this, &LandmarkTable::goTo);
  this->connect(this->Delete, &QToolButton::clicked, this->Tree, &ListTree::removeSelected);
  this->connect(this->Tree, &ListTree::doubleClicked, this, &LandmarkTable::goTo);
  this->connect(this->Marks, &QCheckBox::clicked, list, &LandmarkList::showMarks);
  this->connect(this->Tree, &ListTree::selectedRowsChanged, this, &LandmarkTable::refresh);
  this->connect(list, &LandmarkList::changed, this, &LandmarkTable::refresh);
  this->connect(list->source(), &pqProxy::modifiedStateChanged, this, &LandmarkTable::refresh);
  this->connect(
    LandmarkPicker::instance(), &LandmarkPicker::changed, this, &LandmarkTable::refresh);
  this->connect(ToolSettings::instance(), &ToolSettings::changed, this, &LandmarkTable::refresh);
  this->refresh();
}

void LandmarkTable::layOut()
{
  auto buttons = new QHBoxLayout;
  for (QWidget* widget : { static_cast<QWidget*>(this->Pick), static_cast<QWidget*>(this->GoTo),
         static_cast<QWidget*>(this->Delete), static_cast<QWidget*>(this->Marks) })
  {
    buttons->addWidget(widget);
  }
  buttons->addStretch();
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->Problem);
  column->addWidget(this->Tree);
  column->addWidget(this->Figures);
  column->addLayout(buttons);
  column->addWidget(this->Request);
}

void LandmarkTable::pick(bool on)
{
  if (on && this->Landmarks)
  {
    LandmarkPicker::instance()->start(this->Landmarks->source());
  }
  else
  {
    LandmarkPicker::instance()->stop();
  }
}

void LandmarkTable::goTo()
{
  const QList<int> rows = this->Tree->selectedRows();
  if (this->Landmarks && !rows.isEmpty())
  {
    const LandmarkRow& row = this->Landmarks->rows().at(rows.front());
    bringCrosshairTo(this->Landmarks->source(), std::isfinite(row.drawn.x) ? row.drawn : row.rest);
  }
}

QString LandmarkTable::figuresText() const
{
  const LandmarkFigures& figures = this->Landmarks->figures();
  QStringList lines;
  if (std::isfinite(figures.meanLeftOut))
  {
    lines.append(tr("Mean leave-one-out error: %1")
        .arg(bold(tr("%1 mm").arg(figures.meanLeftOut, 0, 'f', 2))));
  }
  lines.append(tr("Rigid motion removed: %1")
      .arg(bold(
        tr("%1 mm, %2°").arg(figures.shift, 0, 'f', 1).arg(figures.rotationDegrees, 0, 'f', 1))));
  if (figures.applied < 1.0)
  {
    lines.append(tr("The fold guard applied %1 of the deformation")
        .arg(bold(tr("%1 %").arg(100.0 * figures.applied, 0, 'f', 0))));
  }
  if (!this->Landmarks->warning().isEmpty())
  {
    lines.append(this->Landmarks->warning().toHtmlEscaped() + ".");
  }
  if (figures.worst >= 0)
  {
    lines.append(tr("Landmark %1 fits worst").arg(bold(QString::number(figures.worst + 1))));
  }
  return lines.join("<br>");
}

void LandmarkTable::refresh()
{
  if (!this->Landmarks)
  {
    return;
  }
  const std::vector<LandmarkRow>& all = this->Landmarks->rows();
  const QList<int> rows = this->Tree->selectedRows();
  const bool isPicking = LandmarkPicker::instance()->deformation() == this->Landmarks->source();
  const QString problem = this->Landmarks->problem();
  QPalette palette = this->palette();
  palette.setColor(QPalette::WindowText, gradeColor(Grade::Bad, palette, wantsBlueAndOrange()));
  this->Problem->setPalette(palette);
  this->Problem->setText(problem);
  this->Problem->setVisible(!problem.isEmpty());
  this->Tree->setVisible(!all.empty());
  this->Tree->updateGeometry();
  this->Figures->setText(all.empty() ? QString() : this->figuresText());
  this->Figures->setVisible(!all.empty() && problem.isEmpty());
  this->Request->setText(isPicking ? ToolSettings::instance()->request() : QString());
  this->Request->setVisible(isPicking);
  this->Pick->setChecked(isPicking);
  this->Pick->setEnabled(this->Landmarks->isOpen());
  this->GoTo->setEnabled(rows.size() == 1);
  this->Delete->setEnabled(std::any_of(rows.begin(), rows.end(),
    [&](int row) { return row < static_cast<int>(all.size()) && all[row].isPicked(); }));
  for (QWidget* widget : { static_cast<QWidget*>(this->GoTo), static_cast<QWidget*>(this->Delete),
         static_cast<QWidget*>(this->Marks) })
  {
    widget->setVisible(!all.empty());
  }
  this->Marks->setChecked(this->Landmarks->areMarksShown());
}
}
