// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/LandmarksWidget.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Landmarks/LandmarkList.h"
#include "Interaction/Workarounds/Docks.h"
#include "Panel/Landmarks/LandmarkTable.h"

#include <pqPipelineSource.h>
#include <pqPropertiesPanel.h>
#include <pqProxyWidget.h>

#include <vtkSMSourceProxy.h>

#include <QLabel>
#include <QVBoxLayout>

namespace brainshift
{
LandmarksWidget::LandmarksWidget(vtkSMProxy* proxy, vtkSMProperty*, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
  , Column(new QVBoxLayout(this))
  , Nobody(new QLabel(
      tr("Choose this fit as the Lattice of a Free-Form Deformation to see its landmarks."), this))
{
  this->setShowLabel(false);
  this->Nobody->setWordWrap(true);
  this->Column->setContentsMargins(0, 0, 0, 0);
  this->Column->setSpacing(pqPropertiesPanel::suggestedVerticalSpacing());
  this->Column->addWidget(pqProxyWidget::newGroupLabelWidget(tr("Landmarks (mm)"), this));
  this->Column->addWidget(this->Nobody);
  new InSight(this);
  pqServerManagerModel* model = serverManagerModel();
  using Connection = void (pqServerManagerModel::*)(pqPipelineSource*, pqPipelineSource*, int);
  this->connect(model, static_cast<Connection>(&pqServerManagerModel::connectionAdded), this,
    &LandmarksWidget::refresh);
  this->connect(model, static_cast<Connection>(&pqServerManagerModel::connectionRemoved), this,
    &LandmarksWidget::refresh);
  this->refresh();
}

pqPipelineSource* LandmarksWidget::taker() const
{
  pqServerManagerModel* model = serverManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (fitOf(source) && fitOf(source) == this->proxy())
    {
      return source;
    }
  }
  return nullptr;
}

void LandmarksWidget::refresh()
{
  pqPipelineSource* taker = this->taker();
  this->Nobody->setVisible(!taker);
  if (taker == this->Shown)
  {
    return;
  }
  delete this->Table;
  this->Shown = taker;
  if (taker)
  {
    this->Table = new LandmarkTable(LandmarkList::of(taker), this);
    this->Column->addWidget(this->Table);
  }
}
}
