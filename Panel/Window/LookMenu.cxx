// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/LookMenu.h"

#include "Panel/Tools/LookChoice.h"

#include <pqActiveObjects.h>
#include <pqDataRepresentation.h>
#include <pqView.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QAction>
#include <QPointer>

#include <cstring>

namespace brainshift
{
namespace
{
bool isShownVolume(pqRepresentation* display)
{
  vtkSMProxy* proxy = display->getProxy();
  const char* type = proxy->GetProperty("Representation")
    ? vtkSMPropertyHelper(proxy, "Representation").GetAsString()
    : nullptr;
  return display->isVisible() && type && std::strcmp(type, "Deformed Volume") == 0;
}

// The Deformed Volume of the active source, else the first one of the active view.
pqDataRepresentation* shownVolume()
{
  pqDataRepresentation* active = pqActiveObjects::instance().activeRepresentation();
  if (active && isShownVolume(active))
  {
    return active;
  }
  pqView* view = pqActiveObjects::instance().activeView();
  for (pqRepresentation* display : view ? view->getRepresentations() : QList<pqRepresentation*>())
  {
    if (isShownVolume(display))
    {
      return qobject_cast<pqDataRepresentation*>(display);
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
