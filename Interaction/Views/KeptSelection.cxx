// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/KeptSelection.h"

#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

namespace brainshift
{
KeptSelection::KeptSelection(QObject* parent)
  : QObject(parent)
{
  using Sources = void (pqServerManagerModel::*)(pqPipelineSource*, pqPipelineSource*, int);
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  const auto before = [this](pqPipelineSource*, pqPipelineSource* consumer) {
    this->remember(consumer);
  };
  const auto after = [this](
                       pqPipelineSource*, pqPipelineSource* consumer) { this->restore(consumer); };
  this->connect(
    model, static_cast<Sources>(&pqServerManagerModel::preConnectionAdded), this, before);
  this->connect(
    model, static_cast<Sources>(&pqServerManagerModel::preConnectionRemoved), this, before);
  this->connect(model, static_cast<Sources>(&pqServerManagerModel::connectionAdded), this, after);
  this->connect(model, static_cast<Sources>(&pqServerManagerModel::connectionRemoved), this, after);
}

void KeptSelection::remember(pqPipelineSource* consumer)
{
  const bool isSelected = pqActiveObjects::instance().selection() == pqProxySelection{ consumer };
  this->Active = isSelected ? consumer : nullptr;
}

void KeptSelection::restore(pqPipelineSource* consumer)
{
  pqActiveObjects& active = pqActiveObjects::instance();
  if (this->Active == consumer && !active.selection().contains(consumer))
  {
    active.setSelection({ consumer }, consumer);
  }
  this->Active = nullptr;
}
}
