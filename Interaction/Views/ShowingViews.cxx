// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/ShowingViews.h"

#include <pqPipelineSource.h>
#include <pqView.h>

namespace brainshift
{
namespace
{
void collectViews(pqPipelineSource* source, QSet<pqPipelineSource*>& seen, QSet<pqView*>& views)
{
  if (seen.contains(source))
  {
    return;
  }
  seen.insert(source);
  for (pqView* view : source->getViews())
  {
    views.insert(view);
  }
  for (pqPipelineSource* consumer : source->getAllConsumers())
  {
    collectViews(consumer, seen, views);
  }
}
}

QSet<pqView*> viewsShowing(pqPipelineSource* source)
{
  QSet<pqPipelineSource*> seen;
  QSet<pqView*> views;
  collectViews(source, seen, views);
  return views;
}
}
