// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/LooksWidget.h"

#include "Interaction/Views/VolumeLook.h"
#include "Panel/Tools/LookChoice.h"

#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <vtkSMProxy.h>

#include <QGridLayout>
#include <QLabel>
#include <QTimer>
#include <QToolButton>

namespace brainshift
{
namespace
{
constexpr int ButtonsInRow = 4;
constexpr int PictureSize = 40; // pixels
}

LooksWidget::LooksWidget(vtkSMProxy* proxy, vtkSMProperty*, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
  , Without(new QLabel(tr("This volume has no looks."), this))
{
  auto grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(2);
  grid->setColumnStretch(ButtonsInRow, 1);
  grid->addWidget(this->Without, 0, 0, 1, ButtonsInRow + 1);
  this->Without->setWordWrap(true);
  // Apply may attach a segmentation, or bring another volume.
  this->connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::dataUpdated, this, [this](pqPipelineSource* source) {
      if (this->display() && this->display()->getInput() == source)
      {
        this->offerLooks();
      }
    });
  QTimer::singleShot(0, this, &LooksWidget::offerLooks); // the panel appears first
}

pqDataRepresentation* LooksWidget::display() const
{
  return pqApplicationCore::instance()->getServerManagerModel()->findItem<pqDataRepresentation*>(
    this->proxy());
}

void LooksWidget::offerLooks()
{
  pqDataRepresentation* display = this->display();
  const QStringList names = display ? makeVolumeLook(display).names : QStringList();
  if (names == this->Offered)
  {
    return;
  }
  this->Offered = names;
  qDeleteAll(this->findChildren<QToolButton*>());
  this->Without->setVisible(names.isEmpty());
  for (const QString& name : names)
  {
    this->addButton(name);
  }
}

void LooksWidget::addButton(const QString& name)
{
  auto button = new QToolButton(this);
  button->setObjectName(name);
  button->setText(name);
  button->setToolTip(tipOfLook(name));
  button->setAccessibleDescription(tipOfLook(name));
  button->setIcon(iconOfLook(name));
  button->setIconSize(QSize(PictureSize, PictureSize));
  button->setToolButtonStyle(Qt::ToolButtonTextUnderIcon);
  button->setFocusPolicy(Qt::StrongFocus);
  button->setAutoRaise(true);
  this->connect(button, &QToolButton::clicked, this, [this, name] { this->choose(name); });
  const int place = static_cast<int>(this->Offered.indexOf(name));
  static_cast<QGridLayout*>(this->layout())
    ->addWidget(button, place / ButtonsInRow, place % ButtonsInRow);
}

void LooksWidget::choose(const QString& name)
{
  if (pqDataRepresentation* display = this->display())
  {
    chooseLook(display, name);
  }
}
}
