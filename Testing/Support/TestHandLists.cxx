// SPDX-License-Identifier: BSD-3-Clause
// What a hand does with lists of ParaView's window, beside TestHand.cxx. test_hand.py calls it.
#include "TestHandExport.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QFont>
#include <QTest>

// A cell of a list of the window, by the list's object name: 1 or 0 for a check mark (- for none),
// 1 or 0 for bold, 1 or 0 for a sign, and the text, with tabs between. Holds until the next call.
TEST_HAND_EXPORT const char* test_hand_cell(const char* name, int row, int column)
{
  static QByteArray text;
  text.clear();
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto list = window->findChild<QAbstractItemView*>(name);
    if (!list || row >= list->model()->rowCount() || !text.isEmpty())
    {
      continue;
    }
    const QModelIndex cell = list->model()->index(row, column);
    const QVariant check = cell.data(Qt::CheckStateRole);
    const QStringList parts{ !check.isValid() ? "-"
        : check.toInt() == Qt::Checked        ? "1"
                                              : "0",
      cell.data(Qt::FontRole).value<QFont>().bold() ? "1" : "0",
      cell.data(Qt::DecorationRole).isValid() ? "1" : "0", cell.data().toString() };
    text = parts.join('\t').toUtf8();
  }
  return text.constData();
}

// Clicks a cell with the mouse: on its check box, or on its text. Returns whether it is seen.
TEST_HAND_EXPORT int test_hand_click_cell(const char* name, int row, int column, int onCheck)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto list = window->findChild<QAbstractItemView*>(name);
    if (!list || row >= list->model()->rowCount())
    {
      continue;
    }
    const QModelIndex cell = list->model()->index(row, column);
    list->scrollTo(cell);
    const QRect where = list->visualRect(cell);
    constexpr int intoCheckBox = 10; // pixels
    const QPoint at =
      onCheck ? QPoint(where.left() + intoCheckBox, where.center().y()) : where.center();
    QTest::mouseClick(list->viewport(), Qt::LeftButton, Qt::NoModifier, at);
    return where.isEmpty() ? 0 : 1;
  }
  return 0;
}
