// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Strokes/StrokeTree.h"

#include "Interaction/Commands/Commands.h"
#include "Panel/Parts/NumberDelegate.h"
#include "Panel/Parts/SoftHighlight.h"
#include "Panel/Strokes/StrokeModel.h"

#include <QEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QPainter>

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int FewestRows = 4; // seen at once
constexpr int MostRows = 9;
}

StrokeTree::StrokeTree(StrokeModel* model, QWidget* parent)
  : QTreeView(parent)
  , Strokes(model)
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
  softenHighlight(this);
  QHeaderView* header = this->header();
  header->setStretchLastSection(true); // the position
  header->setMinimumSectionSize(this->fontMetrics().averageCharWidth() * 5);
  header->setSectionResizeMode(QHeaderView::ResizeToContents);
  header->setResizeContentsPrecision(50); // rows looked at, of maybe thousands
  header->setSectionsMovable(false);
  this->connect(this->selectionModel(), &QItemSelectionModel::selectionChanged, this,
    &StrokeTree::selectedRowsChanged);
  const auto fit = [this] {
    this->updateGeometry();
    this->showWhereIfRoom();
  };
  this->connect(model, &QAbstractItemModel::rowsInserted, this, fit);
  this->connect(model, &QAbstractItemModel::rowsRemoved, this, fit);
}

QList<int> StrokeTree::selectedRows() const
{
  QList<int> rows;
  for (const QModelIndex& index : this->selectionModel()->selectedRows())
  {
    rows.append(index.row());
  }
  return rows;
}

void StrokeTree::removeSelected()
{
  const QList<int> rows = this->selectedRows();
  if (!rows.isEmpty())
  {
    this->clearSelection(); // rows keep their number, not their stroke
    this->Strokes->removeRowsOf(rows);
  }
}

void StrokeTree::toggleSelected()
{
  const QList<int> rows = this->selectedRows();
  if (!rows.isEmpty())
  {
    this->Strokes->setEnabled(rows, !this->Strokes->stroke(rows.front()).enabled);
  }
}

void StrokeTree::moveColumn(int by)
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

void StrokeTree::keyPressEvent(QKeyEvent* event)
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

void StrokeTree::resizeEvent(QResizeEvent* event)
{
  this->QTreeView::resizeEvent(event);
  this->showWhereIfRoom();
}

// A narrow panel must not cut off the numbers to edit. Tool tips show the position as well. If
// there is no room for the numbers either, a bar moves them; the tool's name comes first.
void StrokeTree::showWhereIfRoom()
{
  int others = 0;
  for (int column = 0; column < StrokeModel::ColumnCount; ++column)
  {
    if (column != StrokeModel::WhereColumn)
    {
      others += std::max(this->sizeHintForColumn(column), this->header()->sectionSizeHint(column));
    }
  }
  const int needed = this->fontMetrics().horizontalAdvance("-300, -300, 300");
  const bool hidden = this->viewport()->width() < others + needed;
  this->setColumnHidden(StrokeModel::WhereColumn, hidden);
  const bool stretched = hidden && this->viewport()->width() >= others;
  this->header()->setSectionResizeMode(
    StrokeModel::ToolColumn, stretched ? QHeaderView::Stretch : QHeaderView::ResizeToContents);
  this->header()->setStretchLastSection(!hidden);
}

void StrokeTree::changeEvent(QEvent* event)
{
  this->QTreeView::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) // our own one, equal to the last, changes nothing
  {
    softenHighlight(this);
  }
}

void StrokeTree::paintEvent(QPaintEvent* event)
{
  this->QTreeView::paintEvent(event);
  if (this->Strokes->rowCount() == 0)
  {
    QPainter painter(this->viewport());
    painter.setPen(this->palette().color(QPalette::PlaceholderText));
    painter.drawText(this->viewport()->rect().adjusted(8, 0, -8, 0),
      Qt::AlignCenter | Qt::TextWordWrap,
      tr("There are no strokes yet. Choose a tool, then work on the volume in the view."));
  }
}

int StrokeTree::heightOfRows(int rows) const
{
  const int row = std::max(this->sizeHintForRow(0), this->fontMetrics().height() + 4);
  return rows * row + this->header()->sizeHint().height() + 2 * this->frameWidth();
}

QSize StrokeTree::sizeHint() const
{
  const int rows = std::clamp(this->Strokes->rowCount() + 1, FewestRows, MostRows);
  return { this->QTreeView::sizeHint().width(), this->heightOfRows(rows) };
}

QSize StrokeTree::minimumSizeHint() const
{
  return { 0, this->heightOfRows(FewestRows) };
}
}
