// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/StillWheel.h"

#include <QEvent>
#include <QObject>
#include <QWidget>

namespace brainshift
{
namespace
{
class StillWheel : public QObject
{
public:
  explicit StillWheel(QWidget* field)
    : QObject(field)
  {
    field->setFocusPolicy(Qt::StrongFocus);
    field->installEventFilter(this);
  }

  bool eventFilter(QObject* watched, QEvent* event) override
  {
    const bool isStill =
      event->type() == QEvent::Wheel && !static_cast<QWidget*>(watched)->hasFocus();
    if (isStill)
    {
      event->ignore(); // so that it goes on to the panel
    }
    return isStill;
  }
};
}

void keepStill(QWidget* field)
{
  new StillWheel(field); // lives as long as the field
}
}
