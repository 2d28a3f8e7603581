// SPDX-License-Identifier: BSD-3-Clause
// What the window manager and the fields of ParaView's window know, for test_hand.py.
#include "TestHandExport.h"

#include <pqOutputWidget.h>

#include <QApplication>
#include <QDockWidget>
#include <QLineEdit>
#include <QMainWindow>
#include <QWindow>

// The number that X knows a window by, by its object name; the main window's if that is empty. 0:
// there is none.
TEST_HAND_EXPORT unsigned long long test_hand_window(const char* name)
{
  const bool main = qstrcmp(name, "") == 0;
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    if (main ? qobject_cast<QMainWindow*>(window) != nullptr : window->objectName() == name)
    {
      return window->windowHandle() ? window->windowHandle()->winId() : 0;
    }
  }
  return 0;
}

// Lets Qt make the main window again, as it does where a window gets its first OpenGL view: X knows
// it by another number then.
TEST_HAND_EXPORT void test_hand_remake_window()
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    if (qobject_cast<QMainWindow*>(window))
    {
      window->windowHandle()->destroy();
      window->windowHandle()->create();
      window->windowHandle()->show();
      return;
    }
  }
}

// What Qt reports when another window gets the keyboard.
TEST_HAND_EXPORT void test_hand_deactivate()
{
  QEvent event(QEvent::ApplicationDeactivate);
  QApplication::sendEvent(qApp, &event);
}

// Gives a widget the keyboard, by its object name. Returns whether it has it.
TEST_HAND_EXPORT int test_hand_focus_on(const char* name)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    if (auto widget = window->findChild<QWidget*>(name))
    {
      window->activateWindow();
      QApplication::setActiveWindow(window); // without a window manager nobody else does
      widget->setFocus();
      return widget->hasFocus() ? 1 : 0;
    }
  }
  return 0;
}

// The text of a field of a property that the properties panel shows, by both names.
TEST_HAND_EXPORT const char* test_hand_field(const char* property, const char* name)
{
  static QByteArray text;
  text.clear();
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto panel = window->findChild<QWidget*>("propertiesPanel");
    auto widget = panel ? panel->findChild<QWidget*>(property) : nullptr;
    auto field = widget ? widget->findChild<QLineEdit*>(name) : nullptr;
    text = field ? field->text().toUtf8() : text;
  }
  return text.constData();
}

// Closes the window Output Messages.
TEST_HAND_EXPORT void test_hand_close_messages()
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    for (QDockWidget* dock : window->findChildren<QDockWidget*>())
    {
      if (dock->findChild<pqOutputWidget*>())
      {
        dock->close();
      }
    }
  }
}
