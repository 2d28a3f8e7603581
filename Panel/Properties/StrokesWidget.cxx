// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/StrokesWidget.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Landmarks/LandmarkList.h"
#include "Interaction/Workarounds/Docks.h"
#include "Interaction/Workarounds/Sessions.h"
#include "Panel/Landmarks/LandmarkTable.h"
#include "Panel/Measured/PullsPane.h"
#include "Panel/Registered/RefinePane.h"
#include "Panel/Strokes/StrokeList.h"
#include "Panel/Tools/ToolPanel.h"

#include <pqPipelineSource.h>
#include <pqPropertiesPanel.h>
#include <pqProxyWidget.h>

#include <vtkSMDoubleVectorProperty.h>
#include <vtkSMPropertyHelper.h>

#include <QVBoxLayout>

namespace brainshift
{
namespace
{
constexpr int ListMs = 250; // from one update of a list under the hand to the next

StrokeModel* makeModel(StrokeEditor* owner, vtkSMProperty* property, QObject* parent)
{
  const QPointer<StrokeEditor> editor = owner; // the source may go before its panel does
  return new StrokeModel(
    vtkSMDoubleVectorProperty::SafeDownCast(property),
    [editor](const std::vector<Stroke>& strokes, const QString& label) {
      if (editor)
      {
        editor->replaceAll(strokes, label);
      }
    },
    parent);
}
}

StrokesWidget::StrokesWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
  , Source(sourceOf(proxy))
  , Tools(new ToolPanel(this))
  , Strokes(makeModel(StrokeEditor::of(this->Source), property, this))
{
  this->setShowLabel(false);
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(pqPropertiesPanel::suggestedVerticalSpacing());
  column->addWidget(pqProxyWidget::newGroupLabelWidget(tr("Tools"), this));
  column->addWidget(this->Tools);
  column->addWidget(pqProxyWidget::newGroupLabelWidget(tr("Strokes (mm)"), this));
  column->addWidget(new StrokeList(this->Strokes, this));
  column->addWidget(new PullsPane(this->Source, this));
  column->addWidget(pqProxyWidget::newGroupLabelWidget(tr("Landmarks (mm)"), this));
  column->addWidget(new LandmarkTable(LandmarkList::of(this->Source), this));
  column->addWidget(new RefinePane(this->Source, this));

  new InSight(this);
  new RoomyDock(this);

  const StrokeEditor* editor = StrokeEditor::of(this->Source);
  this->connect(editor, &StrokeEditor::changed, this, &StrokesWidget::followStrokes);
  this->connect(editor, &StrokeEditor::editing, this, &StrokesWidget::followStrokes);
  this->ListSoon.setSingleShot(true);
  this->connect(&this->ListSoon, &QTimer::timeout, this->Strokes, &StrokeModel::update);
  this->connect(this->Source, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
    &StrokesWidget::followResult);
  this->connect(this->Source, &pqProxy::modifiedStateChanged, this, &StrokesWidget::followResult);
  this->followResult();
}

void StrokesWidget::followStrokes()
{
  // Rows must be those of the property at once, but painting numbers takes its time from a drag.
  const int rows = vtkSMPropertyHelper(this->property()).GetNumberOfElements() / NumbersPerStroke;
  if (StrokeEditor::of(this->Source)->isEditing() && rows == this->Strokes->rowCount())
  {
    if (!this->ListSoon.isActive())
    {
      this->ListSoon.start(ListMs);
    }
    return;
  }
  this->ListSoon.stop();
  this->Strokes->update();
}

double StrokesWidget::latticeSpacing()
{
  if (this->Source->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return 0.0;
  }
  if (!this->Lattice)
  {
    this->Lattice.emplace(this->Source->getProxy());
  }
  const auto lattice = this->Lattice->lattice();
  return lattice ? std::max({ lattice->spacing.x, lattice->spacing.y, lattice->spacing.z }) : 0.0;
}

void StrokesWidget::followResult()
{
  const double spacing = this->latticeSpacing();
  this->Tools->setLatticeSpacing(spacing);
  this->Tools->setReady(this->Source->modifiedState() != pqProxy::UNINITIALIZED);
  this->Strokes->setLatticeSpacing(spacing);
  if (vtkSMProperty* shares = this->proxy()->GetProperty("StrokeShares"))
  {
    pull(this->proxy(), shares);
    this->Strokes->setAppliedShares(vtkSMPropertyHelper(shares).GetDoubleArray());
  }
  if (vtkSMProperty* reaches = this->proxy()->GetProperty("StrokeReaches"))
  {
    pull(this->proxy(), reaches);
    this->Strokes->setReaches(vtkSMPropertyHelper(reaches).GetDoubleArray());
  }
}
}
