// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/KeptSelection.h"

#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <QPointer>
#include <QTimer>

namespace brainshift
{
KeptSelection::KeptSelection(QObject* parent)
  : QObject(parent)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  const auto keep = [this](pqPipelineSource*, pqPipelineSource* consumer) { this->keep(consumer); };
  this->connect(model, &pqServerManagerModel::preConnectionAdded, this, keep);
  this->connect(model, &pqServerManagerModel::preConnectionRemoved, this, keep);
}

// Later, when the pipeline browser has moved the filter. What was selected since then stays.
void KeptSelection::keep(pqPipelineSource* consumer)
{
  if (pqActiveObjects::instance().selection() != pqProxySelection{ consumer })
  {
    return;
  }
  QTimer::singleShot(0, this, [kept = QPointer<pqPipelineSource>(consumer)] {
    pqActiveObjects& active = pqActiveObjects::instance();
    // The filter can be selected and yet not be the active source.
    const bool isActive = active.activeSource() == kept;
    const bool isAlone = active.selection() == pqProxySelection{ kept.data() };
    if (kept && (active.selection().isEmpty() || (isAlone && !isActive)))
    {
      active.setSelection({ kept }, kept);
    }
  });
}
}
