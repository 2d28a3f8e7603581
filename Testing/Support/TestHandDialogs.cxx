// SPDX-License-Identifier: BSD-3-Clause
// What a hand does with lists of files and with dialogs that wait for an answer. test_hand.py calls
// it.
#include "TestHandExport.h"

#include <pqFileDialog.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QApplication>
#include <QComboBox>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileDialog>
#include <QLineEdit>
#include <QMimeData>
#include <QStringList>
#include <QTest>
#include <QTimer>
#include <QUrl>

namespace
{
constexpr int LookAgain = 50; // ms

template <class T>
T* findInWindows(const char* name)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto found =
      window->objectName() == name ? qobject_cast<T*>(window) : window->findChild<T*>(name);
    if (found)
    {
      return found;
    }
  }
  return nullptr;
}

// Calls `act` once a dialog is seen, while Python waits for whoever opened it.
template <class Act>
void whenShown(const QByteArray& dialog, const Act& act)
{
  auto timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, dialog, act] {
    auto shown = findInWindows<QWidget>(dialog.constData());
    if (shown && shown->isVisible())
    {
      timer->stop();
      timer->deleteLater();
      act(shown);
    }
  });
  timer->start(LookAgain);
}

QStringList answeredRows;
}

// The entries of a list by its object name, one line each; the first line is the present one.
TEST_HAND_EXPORT const char* test_hand_entries(const char* name)
{
  static QByteArray text;
  text.clear();
  auto list = findInWindows<QComboBox>(name);
  auto wrap = list ? nullptr : findInWindows<QWidget>(name);
  list = wrap ? wrap->findChild<QComboBox*>() : list;
  if (list)
  {
    QStringList entries{ list->currentText() };
    for (int i = 0; i < list->count(); ++i)
    {
      entries.append(list->itemText(i));
    }
    text = entries.join('\n').toUtf8();
  }
  return text.constData();
}

// Opens a list by its object name and presses Down or Up to an entry, then Enter.
TEST_HAND_EXPORT int test_hand_choose_by_keys(const char* name, const char* entry)
{
  auto list = findInWindows<QComboBox>(name);
  const int wanted = list && list->isEnabled() ? list->findText(QString::fromUtf8(entry)) : -1;
  if (wanted < 0 || !list->isVisible())
  {
    return 0;
  }
  list->showPopup();
  QAbstractItemView* entries = list->view();
  for (int i = 0; i < list->count() && entries->currentIndex().row() != wanted; ++i)
  {
    QTest::keyClick(entries, entries->currentIndex().row() < wanted ? Qt::Key_Down : Qt::Key_Up);
  }
  QTest::keyClick(entries, Qt::Key_Return);
  return 1;
}

// Drops files, whose paths have line feeds between, onto a widget by its object name. Returns
// whether it takes them.
TEST_HAND_EXPORT int test_hand_drop(const char* name, const char* paths)
{
  auto widget = findInWindows<QWidget>(name);
  if (!widget)
  {
    return 0;
  }
  QMimeData files;
  QList<QUrl> urls;
  for (const QString& path : QString::fromUtf8(paths).split('\n'))
  {
    urls.append(QUrl::fromLocalFile(path));
  }
  files.setUrls(urls);
  const QPoint middle = widget->rect().center();
  QDragEnterEvent enter(middle, Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
  enter.ignore();
  QApplication::sendEvent(widget, &enter);
  if (!enter.isAccepted())
  {
    return 0;
  }
  QDropEvent drop(middle, Qt::CopyAction, &files, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(widget, &drop);
  return 1;
}

// Once a dialog is seen: keeps the rows of its first table, chooses an entry of a list of it (no
// list: an empty name), and presses a button.
TEST_HAND_EXPORT void test_hand_answer(
  const char* dialog, const char* list, const char* entry, const char* button)
{
  answeredRows.clear();
  whenShown(dialog,
    [list = QByteArray(list), entry = QString::fromUtf8(entry), button = QByteArray(button)](
      QWidget* shown) {
      if (auto table = shown->findChild<QAbstractItemView*>())
      {
        const QAbstractItemModel* model = table->model();
        for (int row = 0; row < model->rowCount(); ++row)
        {
          QStringList cells;
          for (int column = 0; column < model->columnCount(); ++column)
          {
            auto box = qobject_cast<QComboBox*>(table->indexWidget(model->index(row, column)));
            cells.append(box ? box->currentText() : model->index(row, column).data().toString());
          }
          answeredRows.append(cells.join('\t'));
        }
      }
      auto box = list.isEmpty() ? nullptr : shown->findChild<QComboBox*>(QString(list));
      if (box)
      {
        box->setCurrentIndex(box->findText(entry));
      }
      if (auto pressed = shown->findChild<QAbstractButton*>(QString(button)))
      {
        QTest::mouseClick(pressed, Qt::LeftButton);
      }
    });
}

// The rows that it kept: cells with tabs between.
TEST_HAND_EXPORT const char* test_hand_answered()
{
  static QByteArray text;
  text = answeredRows.join('\n').toUtf8();
  return text.constData();
}

// Once a file dialog is seen: chooses a path.
TEST_HAND_EXPORT void test_hand_answer_path(const char* dialog, const char* path)
{
  whenShown(dialog, [path = QString::fromUtf8(path)](QWidget* shown) {
    if (auto files = qobject_cast<pqFileDialog*>(shown))
    {
      files->selectFile(path);
    }
    else if (auto local = qobject_cast<QFileDialog*>(shown))
    {
      local->selectFile(path);
      if (auto name = local->findChild<QLineEdit*>("fileNameEdit")) // which keeps what is typed
      {
        name->setText(path);
      }
      static_cast<QDialog*>(local)->accept();
    }
  });
}
