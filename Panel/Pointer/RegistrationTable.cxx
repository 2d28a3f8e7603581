// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Pointer/RegistrationTable.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Pointer/Pointer.h"
#include "Interaction/Views/CursorProbe.h"

#include <pqRenderView.h>

#include <QApplication>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMouseEvent>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalBlocker>
#include <QStringList>
#include <QTableWidget>

#include <cmath>

namespace brainshift
{
namespace
{
enum Column
{
  TrackerColumn,
  ImageColumn,
  ResidualColumn,
  Columns,
};

QString textOf(const glm::dvec3& point)
{
  return QString("%1 %2 %3")
    .arg(point.x, 0, 'f', 1)
    .arg(point.y, 0, 'f', 1)
    .arg(point.z, 0, 'f', 1);
}

std::optional<glm::dvec3> pointFrom(const QString& text)
{
  static const QRegularExpression between("[\\s,;]+");
  const QStringList parts = text.split(between, Qt::SkipEmptyParts);
  glm::dvec3 point(0.0);
  bool fine = parts.size() == 3;
  for (int axis = 0; fine && axis < 3; ++axis)
  {
    point[axis] = parts[axis].toDouble(&fine);
    fine = fine && std::abs(point[axis]) <= 1e6;
  }
  return fine ? std::optional<glm::dvec3>(point) : std::nullopt;
}

// The view that a widget belongs to; null if it belongs to none.
pqRenderView* viewOf(QObject* watched)
{
  auto widget = qobject_cast<QWidget*>(watched);
  pqServerManagerModel* model = serverManagerModel();
  for (pqRenderView* view : model->findItems<pqRenderView*>())
  {
    QWidget* shown = view->widget();
    if (widget && shown && (shown == widget || shown->isAncestorOf(widget)))
    {
      return view;
    }
  }
  return nullptr;
}

QTableWidgetItem* cell(const QString& text, bool editable)
{
  auto item = new QTableWidgetItem(text);
  item->setFlags(editable ? item->flags() : item->flags() & ~Qt::ItemIsEditable);
  return item;
}
}

RegistrationTable::RegistrationTable(QWidget* parent)
  : QWidget(parent)
  , State(new QLabel)
  , Table(new QTableWidget(0, Columns))
  , Touch(new QPushButton(tr("Touch Point")))
  , Mark(new QPushButton(tr("Mark in View")))
  , Remove(new QPushButton(tr("Remove")))
{
  this->State->setObjectName("BrainShiftPointerRegistration");
  this->State->setWordWrap(true);
  this->Table->setObjectName("BrainShiftPointerPairs");
  this->Table->setHorizontalHeaderLabels({ tr("Touched"), tr("In the image"), tr("Residual") });
  this->Table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  this->Table->horizontalHeader()->setSectionResizeMode(
    ResidualColumn, QHeaderView::ResizeToContents);
  this->Table->setSelectionBehavior(QAbstractItemView::SelectRows);
  this->Table->setSelectionMode(QAbstractItemView::SingleSelection);
  this->Table->setToolTip(
    tr("Landmarks: touched position (mm, tracker), position in the image (mm, world axes; "
       "double-click to type it), and residual after the registration (mm)."));
  constexpr int rows = 4;
  this->Table->setFixedHeight(
    (rows + 1) * this->Table->verticalHeader()->defaultSectionSize() + rows);
  this->Touch->setObjectName("BrainShiftPointerTouch");
  this->Touch->setToolTip(tr("Hold the tip still on a landmark for half a second, then press. The "
                             "registration needs at least 3 landmarks that are not on one line."));
  this->Mark->setObjectName("BrainShiftPointerMark");
  this->Mark->setCheckable(true);
  this->Mark->setToolTip(tr("Press this button, then click on the landmark in a view. The position "
                            "becomes the partner of the selected point."));
  this->Remove->setObjectName("BrainShiftPointerRemove");
  auto layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->State, 0, 0, 1, 3);
  layout->addWidget(this->Table, 1, 0, 1, 3);
  layout->addWidget(this->Touch, 2, 0);
  layout->addWidget(this->Mark, 2, 1);
  layout->addWidget(this->Remove, 2, 2);
  this->connect(this->Touch, &QPushButton::clicked, this, &RegistrationTable::touch);
  this->connect(this->Mark, &QPushButton::toggled, this, &RegistrationTable::wait);
  this->connect(this->Remove, &QPushButton::clicked, this, [this] {
    Pointer::instance()->registration().remove(this->Table->currentRow());
    this->showState();
  });
  this->connect(this->Table, &QTableWidget::itemChanged, this, &RegistrationTable::takeTyped);
  this->connect(
    this->Table, &QTableWidget::itemSelectionChanged, this, &RegistrationTable::showState);
}

RegistrationTable::~RegistrationTable() = default;

int RegistrationTable::row() const
{
  const auto& pairs = Pointer::instance()->registration().pairs();
  if (!this->Table->selectedItems().isEmpty())
  {
    return this->Table->currentRow();
  }
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i)
  {
    if (!pairs[i].image)
    {
      return i;
    }
  }
  return -1;
}

void RegistrationTable::touch()
{
  Q_EMIT this->problem(Pointer::instance()->touch());
  this->showState();
  this->Table->selectRow(this->Table->rowCount() - 1);
}

void RegistrationTable::wait(bool on)
{
  if (on)
  {
    qApp->installEventFilter(this);
    QApplication::setOverrideCursor(Qt::CrossCursor);
  }
  else
  {
    qApp->removeEventFilter(this);
    QApplication::restoreOverrideCursor();
  }
}

bool RegistrationTable::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() != QEvent::MouseButtonPress)
  {
    return QWidget::eventFilter(watched, event);
  }
  pqRenderView* view = viewOf(watched);
  auto mouse = static_cast<QMouseEvent*>(event);
  if (!view || mouse->button() != Qt::LeftButton)
  {
    return QWidget::eventFilter(watched, event);
  }
  QWidget* shown = view->widget();
  const QPoint at = shown->mapFromGlobal(mouse->globalPosition().toPoint());
  const double ratio = shown->devicePixelRatioF();
  const auto tissue = CursorProbe().tissueAt(view, static_cast<int>(at.x() * ratio),
    static_cast<int>((shown->height() - 1 - at.y()) * ratio));
  if (tissue)
  {
    Pointer::instance()->registration().mark(this->row(), tissue->deformed);
  }
  Q_EMIT this->problem(tissue ? QString() : tr("There is no tissue at that position."));
  this->Mark->setChecked(false);
  this->showState();
  return true;
}

void RegistrationTable::takeTyped(QTableWidgetItem* item)
{
  const std::optional<glm::dvec3> point = pointFrom(item->text());
  if (item->column() == ImageColumn)
  {
    if (point)
    {
      Pointer::instance()->registration().mark(item->row(), *point);
    }
    Q_EMIT this->problem(point ? QString() : tr("Type three numbers (mm)."));
    this->Shown.clear();
    this->showState();
  }
}

void RegistrationTable::fill()
{
  const auto& pairs = Pointer::instance()->registration().pairs();
  QStringList lines;
  for (const TrackerRegistration::Pair& pair : pairs)
  {
    lines.append(textOf(pair.tracker));
    lines.append(pair.image ? textOf(*pair.image) : QString());
    lines.append(std::isfinite(pair.residual) ? QString::number(pair.residual, 'f', 2) : QString());
  }
  const QString wanted = lines.join('\n') + QString::number(pairs.size());
  if (wanted == this->Shown)
  {
    return;
  }
  this->Shown = wanted;
  const QSignalBlocker quiet(this->Table);
  this->Table->setRowCount(static_cast<int>(pairs.size()));
  for (int i = 0; i < lines.size(); ++i)
  {
    this->Table->setItem(i / Columns, i % Columns, cell(lines[i], i % Columns == ImageColumn));
  }
}

void RegistrationTable::showState()
{
  const Pointer* pointer = Pointer::instance();
  const TrackerRegistration& registration = Pointer::instance()->registration();
  this->fill();
  QString state = tr("Not registered: tracker positions are used as image positions.");
  if (registration.isRegistered())
  {
    state = std::isfinite(registration.error())
      ? tr("Registered, RMS %1 mm").arg(registration.error(), 0, 'f', 2)
      : tr("Registered as in the saved session");
  }
  for (const QString& sentence : { registration.problem(), registration.doubt() })
  {
    state += sentence.isEmpty() ? QString() : " " + sentence;
  }
  this->State->setText(state);
  this->Touch->setEnabled(pointer->isOpen() && pointer->tip());
  this->Mark->setEnabled(this->row() >= 0);
  this->Remove->setEnabled(!this->Table->selectedItems().isEmpty());
}
}
