// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/RestingCursor.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqServerManagerModel.h>

namespace brainshift
{
RestingCursor::RestingCursor(QObject* parent)
  : QObject(parent)
{
  this->Soon.setSingleShot(true);
  this->Soon.setInterval(0); // a pick in the middle of a picture would ask a busy server
  this->connect(&this->Soon, &QTimer::timeout, this, &RestingCursor::sees);
  this->connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::dataUpdated, this, [this](pqPipelineSource* source) {
      this->Outdated = this->Outdated || source == this->Deformation;
    });
}

void RestingCursor::follow(pqPipelineSource* deformation, pqRenderView* view)
{
  if (this->View)
  {
    this->View->disconnect(this);
  }
  this->Deformation = deformation;
  this->View = view;
  if (view)
  {
    this->connect(view, &pqView::endRender, this, [this] {
      if (this->Outdated)
      {
        this->Outdated = false;
        this->look();
      }
    });
    this->look();
  }
}
}
