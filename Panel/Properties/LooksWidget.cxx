// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/LooksWidget.h"

#include "Filters/Attached/Segmentation.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Displays/LabelMaps.h"
#include "Panel/Tools/LookChoice.h"

#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>

#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkEventQtSlotConnect.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

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
  , Without(new QLabel(tr("This volume has no presets."), this))
{
  auto grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(2);
  grid->setColumnStretch(ButtonsInRow, 1);
  grid->addWidget(this->Without, 0, 0, 1, ButtonsInRow + 1);
  this->Without->setWordWrap(true);
  // Apply may attach a segmentation, or bring another volume.
  this->connect(serverManagerModel(), &pqServerManagerModel::dataUpdated, this,
    [this](pqPipelineSource* source) {
      if (this->display() && this->display()->getInput() == source)
      {
        this->offerLooks();
      }
    });
  // Another array has looks of its own.
  this->Observers->Connect(
    proxy->GetProperty("ColorArrayName"), vtkCommand::ModifiedEvent, this, SLOT(offerLooksSoon()));
  this->offerLooksSoon();
}

LooksWidget::~LooksWidget() = default;

// The panel appears first, and a change of the property is complete.
void LooksWidget::offerLooksSoon()
{
  QTimer::singleShot(0, this, &LooksWidget::offerLooks);
}

pqDataRepresentation* LooksWidget::display() const
{
  return serverManagerModel()->findItem<pqDataRepresentation*>(this->proxy());
}

// Identifies a volume without reading it: every stroke makes new data of the same volume.
QString LooksWidget::volume() const
{
  const vtkSMPropertyHelper input(this->proxy(), "Input");
  const vtkSMPropertyHelper colors(this->proxy(), "ColorArrayName", true);
  auto source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  const char* name = colors.GetInputArrayNameToProcess();
  if (!source || !name)
  {
    return {};
  }
  vtkPVDataInformation* data = source->GetDataInformation(input.GetOutputPort());
  vtkPVArrayInformation* array = data->GetArrayInformation(name, colors.GetInputArrayAssociation());
  const bool hasSegment =
    data->GetArrayInformation(SegmentationName, vtkDataObject::FIELD) != nullptr;
  const double* range = array ? array->GetComponentRange(0) : nullptr;
  const qsizetype labelMaps = this->display() ? labelMapsFor(this->display()).size() : 0;
  return QString("%1 %2 %3 %4 %5 %6")
    .arg(name)
    .arg(data->GetNumberOfPoints())
    .arg(hasSegment)
    .arg(range ? range[0] : 0.0)
    .arg(range ? range[1] : 0.0)
    .arg(labelMaps);
}

void LooksWidget::offerLooks()
{
  const QString volume = this->volume();
  if (volume == this->Read)
  {
    return;
  }
  this->Read = volume;
  pqDataRepresentation* display = this->display();
  const QStringList names = display ? looksOf(display) : QStringList();
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
