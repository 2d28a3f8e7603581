// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/ArrowKeys.h"

#include <pqRenderView.h>

#include <vtkRenderWindow.h>
#include <vtkSMRenderViewProxy.h>

#include <QApplication>
#include <QCursor>
#include <QWidget>

#include <algorithm>
#include <array>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr int StepPixels = 8; // more than a resting hand trembles: each step is a new place
constexpr std::array<glm::ivec2, 4> Ways{ { { -1, 0 }, { 1, 0 }, { 0, 1 }, { 0, -1 } } };

glm::ivec2 sizeOf(pqRenderView* view)
{
  const int* size = view->getRenderViewProxy()->GetRenderWindow()->GetSize();
  return { size[0], size[1] };
}
}

HandEvent steppedByKey(pqRenderView* view, const std::optional<glm::ivec2>& from, int way)
{
  const glm::ivec2 size = sizeOf(view);
  const int step = static_cast<int>(std::lround(StepPixels * view->widget()->devicePixelRatioF()));
  const glm::ivec2 at = from ? *from + step * Ways[way] : size / 2;
  HandEvent event;
  event.x = std::clamp(at.x, 0, size.x - 1);
  event.y = std::clamp(at.y, 0, size.y - 1);
  return event;
}

void takeMouseAlong(pqRenderView* view, const HandEvent& to)
{
  QWidget* widget = view->widget();
  const QPointF inView = QPointF(to.x, sizeOf(view).y - 1 - to.y) / widget->devicePixelRatioF();
  QCursor::setPos(widget->mapToGlobal(inView.toPoint()));
}

bool hasKeyboard(pqRenderView* view)
{
  QWidget* focus = QApplication::focusWidget(); // null: a window inside the view has it
  QWidget* widget = view->widget();
  return !focus || focus == widget || widget->isAncestorOf(focus);
}
}
