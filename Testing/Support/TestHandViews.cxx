// SPDX-License-Identifier: BSD-3-Clause
// The frames and layouts of views, states, and messages of ParaView's window, for test_hand.py.
#include "TestHandExport.h"

#include <pqApplicationCore.h>
#include <pqLoadStateReaction.h>
#include <pqOutputWidget.h>
#include <pqSaveStateReaction.h>
#include <pqServerManagerModel.h>
#include <pqTabbedMultiViewWidget.h>
#include <pqView.h>
#include <pqViewFrame.h>

#include <vtkSMProxy.h>

#include <QAbstractItemModel>
#include <QAbstractItemView>
#include <QAction>
#include <QApplication>
#include <QByteArray>
#include <QPushButton>
#include <QStringList>
#include <QTabWidget>
#include <QToolButton>

namespace
{
pqTabbedMultiViewWidget* layouts()
{
  return qobject_cast<pqTabbedMultiViewWidget*>(
    pqApplicationCore::instance()->manager("MULTIVIEW_WIDGET"));
}

pqOutputWidget* messages()
{
  for (QWidget* widget : QApplication::allWidgets())
  {
    if (auto output = qobject_cast<pqOutputWidget*>(widget))
    {
      return output;
    }
  }
  return nullptr;
}
}

// Presses a button of a view's frame: Close, Maximize, Restore, Split Horizontal Axis or Split
// Vertical Axis. Returns whether there is one that can be pressed.
TEST_HAND_EXPORT int test_hand_frame(unsigned int id, const char* text)
{
  for (pqView* view : pqApplicationCore::instance()->getServerManagerModel()->findItems<pqView*>())
  {
    QWidget* frame = view->getProxy()->GetGlobalID() == id ? view->widget() : nullptr;
    while (frame && !qobject_cast<pqViewFrame*>(frame))
    {
      frame = frame->parentWidget();
    }
    for (auto button : frame ? frame->findChildren<QToolButton*>() : QList<QToolButton*>())
    {
      QAction* action = button->defaultAction();
      if (action && action->text() == text && button->isEnabled() && !button->isHidden())
      {
        button->click();
        return 1;
      }
    }
  }
  return 0;
}

// Presses the button of an empty frame that is seen which makes a view, for example Render View.
TEST_HAND_EXPORT int test_hand_fill_frame(const char* text)
{
  for (QWidget* widget : QApplication::allWidgets())
  {
    auto button = qobject_cast<QPushButton*>(widget);
    if (button && button->text() == text && button->isVisible())
    {
      button->click();
      return 1;
    }
  }
  return 0;
}

// Opens a new tab of views, as the tab + does.
TEST_HAND_EXPORT void test_hand_new_layout()
{
  layouts()->setCurrentTab(layouts()->createTab());
}

// Brings a tab to the front; from 0.
TEST_HAND_EXPORT void test_hand_show_layout(int tab)
{
  layouts()->setCurrentTab(tab);
}

// Closes a tab with its views; from 0.
TEST_HAND_EXPORT void test_hand_close_layout(int tab)
{
  layouts()->closeTab(tab);
}

// The tab at the front; from 0.
TEST_HAND_EXPORT int test_hand_shown_layout()
{
  auto tabs = layouts()->findChild<QTabWidget*>("CoreWidget");
  return tabs ? tabs->currentIndex() : -1;
}

// As File > Save State and Load State do, without their dialogs.
TEST_HAND_EXPORT void test_hand_save_state(const char* path)
{
  pqSaveStateReaction::saveState(QString::fromUtf8(path));
}

TEST_HAND_EXPORT void test_hand_load_state(const char* path)
{
  pqLoadStateReaction::loadState(QString::fromUtf8(path), /*dialogBlocked*/ true);
}

// What the window Output Messages holds, one line each.
TEST_HAND_EXPORT const char* test_hand_messages()
{
  static QByteArray told;
  QStringList lines;
  if (pqOutputWidget* output = messages())
  {
    for (auto list : output->findChildren<QAbstractItemView*>())
    {
      for (int row = 0; list->model() && row < list->model()->rowCount(); ++row)
      {
        lines.append(list->model()->index(row, 0).data().toString());
      }
    }
  }
  told = lines.join('\n').toUtf8();
  return told.constData();
}

// Empties it.
TEST_HAND_EXPORT void test_hand_forget_messages()
{
  if (pqOutputWidget* output = messages())
  {
    QMetaObject::invokeMethod(output, "clear");
  }
}

// Whether the window Output Messages is shown.
TEST_HAND_EXPORT int test_hand_shows_messages()
{
  pqOutputWidget* output = messages();
  return output && output->isVisible() ? 1 : 0;
}
