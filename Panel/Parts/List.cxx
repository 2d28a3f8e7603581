// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/List.h"

#include "Interaction/Commands/Commands.h"

#include <QDoubleSpinBox>
#include <QEvent>
#include <QFont>
#include <QGuiApplication>
#include <QHeaderView>
#include <QIcon>
#include <QKeyEvent>
#include <QPainter>
#include <QPalette>
#include <QStyledItemDelegate>
#include <QToolButton>

#include <algorithm>

namespace brainshift
{
QString positionText(const glm::dvec3& position, int decimals)
{
  return QString("%1, %2, %3")
    .arg(position.x, 0, 'f', decimals)
    .arg(position.y, 0, 'f', decimals)
    .arg(position.z, 0, 'f', decimals);
}

ListModel::ListModel(const QList<Column>& columns, QObject* parent)
  : QAbstractTableModel(parent)
  , Columns(columns)
{
}

int ListModel::whereColumn() const
{
  const int last = static_cast<int>(this->Columns.size()) - 1;
  return last > 0 && this->Columns[last].isText ? last : -1;
}

QString ListModel::warning(int, int) const
{
  return {};
}

bool ListModel::isBold(int) const
{
  return false;
}

std::optional<ListModel::Number> ListModel::number(int, int) const
{
  return std::nullopt;
}

void ListModel::change(int, int, double) {}

void ListModel::announce()
{
  const int rows = this->count();
  if (rows > this->Rows)
  {
    this->beginInsertRows({}, this->Rows, rows - 1);
    this->Rows = rows;
    this->endInsertRows();
  }
  else if (rows < this->Rows)
  {
    this->beginRemoveRows({}, rows, this->Rows - 1);
    this->Rows = rows;
    this->endRemoveRows();
  }
  if (rows > 0)
  {
    Q_EMIT this->dataChanged(this->index(0, 0), this->index(rows - 1, this->columnCount() - 1));
  }
}

void ListModel::announceColumn(int column)
{
  if (this->Rows > 0)
  {
    Q_EMIT this->dataChanged(this->index(0, column), this->index(this->Rows - 1, column));
  }
}

int ListModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : this->Rows;
}

int ListModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : static_cast<int>(this->Columns.size());
}

Qt::ItemFlags ListModel::flags(const QModelIndex& index) const
{
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
  flags.setFlag(Qt::ItemIsUserCheckable, index.column() == 0);
  const bool isThere = index.isValid() && index.row() < this->count();
  flags.setFlag(Qt::ItemIsEditable, isThere && this->number(index.row(), index.column()));
  return flags;
}

QVariant ListModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal || section < 0 || section >= this->columnCount())
  {
    return {};
  }
  const Column& column = this->Columns[section];
  switch (role)
  {
    case Qt::DisplayRole:
      return column.title;
    case Qt::ToolTipRole:
      return column.tip;
    case Qt::TextAlignmentRole:
      return int(column.isText ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter;
    default:
      return {};
  }
}

QVariant ListModel::number(const QModelIndex& index, int role) const
{
  const std::optional<Number> number = this->number(index.row(), index.column());
  if (!number)
  {
    return {};
  }
  return role == LeastRole ? number->least : role == MostRole ? number->most : number->value;
}

QVariant ListModel::data(const QModelIndex& index, int role) const
{
  const int row = index.row();
  const int column = index.column();
  if (!index.isValid() || row >= this->count()) // the list may be ahead of the views
  {
    return {};
  }
  switch (role)
  {
    case Qt::DisplayRole:
      return this->text(row, column);
    case Qt::CheckStateRole:
      return column == 0 ? QVariant(this->isOn(row) ? Qt::Checked : Qt::Unchecked) : QVariant();
    case Qt::DecorationRole:
      return this->warning(row, column).isEmpty() ? QVariant() : QIcon(":/BrainShift/warning.svg");
    case Qt::ToolTipRole:
    {
      const QString warning = this->warning(row, column);
      return warning.isEmpty() ? this->toolTip(row, column) : warning;
    }
    case Qt::TextAlignmentRole:
      return this->headerData(column, Qt::Horizontal, role);
    case Qt::ForegroundRole:
      return this->isOn(row) ? QVariant()
                             : QGuiApplication::palette().brush(QPalette::Disabled, QPalette::Text);
    case Qt::FontRole:
    {
      QFont font = QGuiApplication::font();
      font.setBold(true);
      return this->isBold(row) ? QVariant(font) : QVariant();
    }
    case Qt::EditRole:
    case LeastRole:
    case MostRole:
      return this->number(index, role);
    default:
      return {};
  }
}

bool ListModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  const int row = index.row();
  const int column = index.column();
  if (!this->checkIndex(index, CheckIndexOption::IndexIsValid) || row >= this->count())
  {
    return false;
  }
  if (role == Qt::CheckStateRole && column == 0)
  {
    this->setOn({ row }, value.toInt() == Qt::Checked);
    return true;
  }
  bool isNumber = false;
  const double wanted = value.toDouble(&isNumber);
  const std::optional<Number> before = this->number(row, column);
  if (role != Qt::EditRole || !isNumber || !before ||
    !(wanted >= before->least && wanted <= before->most))
  {
    return false;
  }
  if (wanted != before->value) // an editor that was opened and closed is no edit
  {
    this->change(row, column, wanted);
  }
  return true;
}

namespace
{
// Edits numbers with 2 decimals, within their limits.
class NumberDelegate : public QStyledItemDelegate
{
public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QWidget* createEditor(
    QWidget* parent, const QStyleOptionViewItem&, const QModelIndex& index) const override
  {
    auto editor = new QDoubleSpinBox(parent);
    editor->setFrame(false);
    editor->setButtonSymbols(QAbstractSpinBox::NoButtons); // the cell is narrow
    editor->setDecimals(2);
    editor->setRange(
      index.data(ListModel::LeastRole).toDouble(), index.data(ListModel::MostRole).toDouble());
    return editor;
  }
};
}

QToolButton* makeListButton(
  QWidget* parent, const char* name, const QString& text, const QString& tip, const char* icon)
{
  auto button = new QToolButton(parent);
  button->setObjectName(name);
  button->setText(text);
  button->setToolTip(tip);
  button->setFocusPolicy(Qt::TabFocus);
  if (icon)
  {
    button->setIcon(QIcon(icon));
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  }
  return button;
}

ListTree::ListTree(ListModel* model, const Room& room, QWidget* parent)
  : QTreeView(parent)
  , Rows(model)
  , Space(room)
{
  this->setModel(model);
  this->setItemDelegate(new NumberDelegate(this));
  this->setRootIsDecorated(false);
  this->setUniformRowHeights(true); // hundreds of rows are not measured one by one
  this->setAlternatingRowColors(true);
  this->setSelectionMode(QAbstractItemView::ExtendedSelection);
  this->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed |
    QAbstractItemView::AnyKeyPressed);
  this->setTabKeyNavigation(false); // Tab leaves the list
  this->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  this->setTextElideMode(Qt::ElideRight);
  this->softenHighlight();
  QHeaderView* header = this->header();
  header->setStretchLastSection(true); // the position
  header->setMinimumSectionSize(this->fontMetrics().averageCharWidth() * 5);
  header->setSectionResizeMode(QHeaderView::ResizeToContents);
  header->setResizeContentsPrecision(50); // rows looked at, of maybe thousands
  header->setSectionsMovable(false);
  this->connect(this->selectionModel(), &QItemSelectionModel::selectionChanged, this,
    &ListTree::selectedRowsChanged);
  const auto fit = [this] {
    this->updateGeometry();
    this->showWhereIfRoom();
  };
  this->connect(model, &QAbstractItemModel::rowsInserted, this, fit);
  this->connect(model, &QAbstractItemModel::rowsRemoved, this, fit);
}

QList<int> ListTree::selectedRows() const
{
  QList<int> rows;
  for (const QModelIndex& index : this->selectionModel()->selectedRows())
  {
    rows.append(index.row());
  }
  return rows;
}

void ListTree::removeSelected()
{
  const QList<int> rows = this->selectedRows();
  if (!rows.isEmpty())
  {
    this->clearSelection(); // rows keep their number, not their content
    this->Rows->removeRowsOf(rows);
  }
}

void ListTree::toggleSelected()
{
  const QList<int> rows = this->selectedRows();
  if (!rows.isEmpty())
  {
    this->Rows->setOn(rows, !this->Rows->isOn(rows.front()));
  }
}

void ListTree::moveColumn(int by)
{
  const QModelIndex current = this->currentIndex();
  QModelIndex next = current.siblingAtColumn(current.column() + by);
  while (next.isValid() && this->isColumnHidden(next.column()))
  {
    next = next.siblingAtColumn(next.column() + by);
  }
  if (next.isValid())
  {
    this->selectionModel()->setCurrentIndex(next, QItemSelectionModel::NoUpdate);
  }
}

void ListTree::keyPressEvent(QKeyEvent* event)
{
  const KeyCommand found = commandOfKey({ Scope::List }, event->key());
  switch (found.command)
  {
    case Command::DeleteStrokes:
      this->removeSelected();
      return;
    case Command::ToggleStrokes:
      this->toggleSelected();
      return;
    case Command::ChooseNumber:
      this->moveColumn(found.index == 0 ? -1 : 1);
      return;
    case Command::EditNumber:
      if (this->currentIndex().flags() & Qt::ItemIsEditable)
      {
        this->edit(this->currentIndex());
      }
      return;
    default:
      this->QTreeView::keyPressEvent(event);
  }
}

void ListTree::resizeEvent(QResizeEvent* event)
{
  this->QTreeView::resizeEvent(event);
  this->showWhereIfRoom();
}

// A narrow panel must not cut off the numbers to edit. Tool tips show the position as well. If
// there is no room for the numbers either, a bar moves them; the first column stays whole.
void ListTree::showWhereIfRoom()
{
  const int where = this->Rows->whereColumn();
  int others = 0;
  for (int column = 0; column < this->Rows->columnCount(); ++column)
  {
    if (column != where)
    {
      others += std::max(this->sizeHintForColumn(column), this->header()->sectionSizeHint(column));
    }
  }
  const int needed = this->fontMetrics().horizontalAdvance("-300, -300, 300");
  const bool isShown = where >= 0 && this->viewport()->width() >= others + needed;
  if (where >= 0)
  {
    this->setColumnHidden(where, !isShown);
  }
  const bool stretched = !isShown && this->viewport()->width() >= others;
  this->header()->setSectionResizeMode(
    0, stretched ? QHeaderView::Stretch : QHeaderView::ResizeToContents);
  this->header()->setStretchLastSection(isShown);
}

// Icons would be lost on the strong highlight of most themes.
void ListTree::softenHighlight()
{
  constexpr double part = 0.35; // of the theme's highlight
  const QPalette theme = QGuiApplication::palette();
  const QColor strong = theme.color(QPalette::Highlight);
  const QColor base = theme.color(QPalette::Base);
  const auto mixed = [](int some, int rest) { return int(part * some + (1.0 - part) * rest); };
  QPalette soft;
  soft.setColor(QPalette::Highlight,
    QColor(mixed(strong.red(), base.red()), mixed(strong.green(), base.green()),
      mixed(strong.blue(), base.blue())));
  soft.setColor(QPalette::HighlightedText, theme.color(QPalette::Text));
  this->setPalette(soft);
}

void ListTree::changeEvent(QEvent* event)
{
  this->QTreeView::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) // our own one, equal to the last, changes nothing
  {
    this->softenHighlight();
  }
}

void ListTree::paintEvent(QPaintEvent* event)
{
  this->QTreeView::paintEvent(event);
  if (this->Rows->rowCount() == 0)
  {
    QPainter painter(this->viewport());
    painter.setPen(this->palette().color(QPalette::PlaceholderText));
    painter.drawText(this->viewport()->rect().adjusted(8, 0, -8, 0),
      Qt::AlignCenter | Qt::TextWordWrap, this->Space.empty);
  }
}

int ListTree::heightOfRows(int rows) const
{
  const int row = std::max(this->sizeHintForRow(0), this->fontMetrics().height() + 4);
  return rows * row + this->header()->sizeHint().height() + 2 * this->frameWidth();
}

QSize ListTree::sizeHint() const
{
  const int rows =
    std::clamp(this->Rows->rowCount() + 1, this->Space.fewestRows, this->Space.mostRows);
  return { this->QTreeView::sizeHint().width(), this->heightOfRows(rows) };
}

QSize ListTree::minimumSizeHint() const
{
  return { 0, this->heightOfRows(this->Space.fewestRows) };
}
}
