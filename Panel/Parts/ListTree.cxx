// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/ListTree.h"

#include "Interaction/Commands/Commands.h"
#include "Panel/Parts/ListModel.h"

#include <QDoubleSpinBox>
#include <QEvent>
#include <QGuiApplication>
#include <QHeaderView>
#include <QKeyEvent>
#include <QPainter>
#include <QStyledItemDelegate>

#include <algorithm>

namespace brainshift
{
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
      this->moveColumn(found.place == 0 ? -1 : 1);
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
