// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/LookMenu.h"

#include "Interaction/Views/ActiveDeformation.h"
#include "Panel/Tools/LookChoice.h"

#include <pqActiveObjects.h>
#include <pqDataRepresentation.h>
#include <pqView.h>

#include <QAction>
#include <QPointer>

namespace brainshift
{
namespace
{
bool isShownVolume(pqDataRepresentation* display)
{
  return display && display->isVisible() && showsVolume(display);
}

// The Deformed Volume of the active source, else the first one of the active view.
pqDataRepresentation* shownVolume()
{
  pqDataRepresentation* active = pqActiveObjects::instance().activeRepresentation();
  if (isShownVolume(active))
  {
    return active;
  }
  pqView* view = pqActiveObjects::instance().activeView();
  for (pqRepresentation* display : view ? view->getRepresentations() : QList<pqRepresentation*>())
  {
    auto data = qobject_cast<pqDataRepresentation*>(display);
    if (isShownVolume(data))
    {
      return data;
    }
  }
  return nullptr;
}
}

LookMenu::LookMenu(QWidget* parent)
  : QMenu(tr("Look"), parent)
{
  this->setToolTipsVisible(true);
  this->connect(this, &QMenu::aboutToShow, this, &LookMenu::offer);
}

void LookMenu::offer()
{
  this->clear();
  const QPointer<pqDataRepresentation> display = shownVolume();
  const QStringList names = display ? looksOf(display) : QStringList();
  for (const QString& name : names)
  {
    QAction* action = this->addAction(iconOfLook(name), name);
    action->setObjectName("actionBrainShiftLook" + name);
    action->setToolTip(tipOfLook(name));
    this->connect(action, &QAction::triggered, this, [display, name] {
      if (display)
      {
        chooseLook(display, name);
      }
    });
  }
  if (names.isEmpty())
  {
    this
      ->addAction(
        display ? tr("This volume has no looks") : tr("The view shows no Deformed Volume"))
      ->setEnabled(false);
  }
}
}
