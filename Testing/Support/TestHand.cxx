// SPDX-License-Identifier: BSD-3-Clause
// A hand for tests of ParaView's window: sends mouse, wheel and key events to a view as Qt's own
// come, which ParaView's test player does for mouse buttons only. test_hand.py calls it.
#include "TestHandExport.h"

#include <QVTKOpenGLNativeWidget.h>
#include <QVTKOpenGLStereoWidget.h>
#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqLoadDataReaction.h>
#include <pqObjectBuilder.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkSMProxy.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QAccessible>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QElapsedTimer>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMouseEvent>
#include <QOpenGLWindow>
#include <QPalette>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>
#include <QWidget>

namespace
{
vtkTypeUInt32 viewId = 0; // of the view under the hand; 0: the active one
Qt::MouseButton button = Qt::LeftButton;

QWidget* viewWidget()
{
  pqView* view = pqActiveObjects::instance().activeView();
  for (pqView* other : pqApplicationCore::instance()->getServerManagerModel()->findItems<pqView*>())
  {
    view = other->getProxy()->GetGlobalID() == viewId ? other : view;
  }
  return view ? view->widget() : nullptr;
}

// What hears the mouse in that view; null without a view.
QObject* ear()
{
  QWidget* widget = viewWidget();
  if (!widget)
  {
    return nullptr;
  }
  if (auto native = widget->findChild<QVTKOpenGLNativeWidget*>())
  {
    return native;
  }
  auto stereo = widget->findChild<QVTKOpenGLStereoWidget*>();
  return stereo ? stereo->embeddedOpenGLWindow() : nullptr;
}

void send(QEvent& event)
{
  if (QObject* target = ear())
  {
    QApplication::sendEvent(target, &event);
  }
}

// Qt counts in logical pixels, of which a screen at 200 % has half as many a side.
QPointF logical(int x, int y)
{
  QWidget* widget = viewWidget();
  return QPointF(x, y) / (widget ? widget->devicePixelRatioF() : 1.0);
}

QPointF onScreen(const QPointF& inView)
{
  QWidget* widget = viewWidget();
  return widget ? widget->mapToGlobal(inView) : inView;
}
}

// The view that the hand is over from now on, by its proxy's number; 0: the active one.
TEST_HAND_EXPORT void test_hand_over(unsigned int view)
{
  viewId = view;
}

// The button that is meant from now on: the right one, or the left one.
TEST_HAND_EXPORT void test_hand_right_button(int right)
{
  button = right ? Qt::RightButton : Qt::LeftButton;
}

// Pixels of the screen from the view's upper left corner. `type`: 0 move, 1 press, 2 release,
// 3 double-click. `held`: whether the button is down afterwards. `modifiers`:
// Qt::KeyboardModifiers.
TEST_HAND_EXPORT void test_hand_mouse(int type, int x, int y, int held, int modifiers)
{
  const QEvent::Type types[] = { QEvent::MouseMove, QEvent::MouseButtonPress,
    QEvent::MouseButtonRelease, QEvent::MouseButtonDblClick };
  const QPointF at = logical(x, y);
  QMouseEvent event(types[type], at, onScreen(at), type == 0 ? Qt::NoButton : button,
    held ? button : Qt::NoButton, Qt::KeyboardModifiers(modifiers));
  send(event);
}

// `clicks`: forward (away from the user) is positive.
TEST_HAND_EXPORT void test_hand_wheel(int x, int y, int clicks, int modifiers)
{
  constexpr int eighthsOfDegree = 120; // of a click
  const QPointF at = logical(x, y);
  QWheelEvent event(at, onScreen(at), QPoint(), QPoint(0, clicks * eighthsOfDegree), Qt::NoButton,
    Qt::KeyboardModifiers(modifiers), Qt::NoScrollPhase, false);
  send(event);
}

// `key`: Qt::Key. As Qt does, asks first whether a shortcut may have it.
TEST_HAND_EXPORT void test_hand_key(int key, int press, int modifiers)
{
  const Qt::KeyboardModifiers held(modifiers);
  if (press)
  {
    QKeyEvent ask(QEvent::ShortcutOverride, key, held);
    send(ask);
  }
  QKeyEvent event(press ? QEvent::KeyPress : QEvent::KeyRelease, key, held);
  send(event);
}

// `key`: Qt::Key, pressed and let go where the active view is: a shortcut of the window hears it.
TEST_HAND_EXPORT void test_hand_shortcut(int key, int modifiers)
{
  if (QWidget* widget = viewWidget())
  {
    widget->window()->activateWindow();
    QApplication::setActiveWindow(widget->window()); // without a window manager nobody else does
    QTest::keyClick(widget, Qt::Key(key), Qt::KeyboardModifiers(modifiers));
  }
}

// Of an action of the window that can be checked.
TEST_HAND_EXPORT int test_hand_is_checked(const char* name)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    if (auto action = window->findChild<QAction*>(name))
    {
      return action->isChecked() ? 1 : 0;
    }
  }
  return 0;
}

// Lets the window do what it has to do, for at least so long.
TEST_HAND_EXPORT void test_hand_wait(int milliseconds)
{
  QElapsedTimer timer;
  timer.start();
  do
  {
    QApplication::processEvents();
    QApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  } while (timer.elapsed() < milliseconds);
}

// Of the tool settings. Returns the number it is afterwards; 0 if there is none of that name.
TEST_HAND_EXPORT double test_hand_set(const char* property, double value)
{
  QObject* settings = pqApplicationCore::instance()->findChild<QObject*>("BrainShiftToolSettings");
  if (!settings)
  {
    return 0.0;
  }
  if (value == value) // not a number: only asked for
  {
    const bool isWhole = qstrcmp(property, "tool") == 0;
    settings->setProperty(property, isWhole ? QVariant(static_cast<int>(value)) : QVariant(value));
  }
  return settings->property(property).toDouble();
}

// Of the window's menus and toolbars, by its object name. Returns whether it could be triggered.
TEST_HAND_EXPORT int test_hand_action(const char* name)
{
  for (QWidget* widget : QApplication::allWidgets()) // an action may belong to a group alone
  {
    for (QAction* action : widget->actions())
    {
      if (action->objectName() == name && action->isEnabled())
      {
        action->trigger();
        return 1;
      }
    }
  }
  return 0;
}

// Of the active source, as the menu Filters does. `name`: in XML.
TEST_HAND_EXPORT void test_hand_create_filter(const char* name)
{
  SCOPED_UNDO_SET("Create filter");
  pqApplicationCore::instance()->getObjectBuilder()->createFilter(
    "filters", name, pqActiveObjects::instance().activeSource());
}

// As File > Open does, before Apply. One path.
TEST_HAND_EXPORT void test_hand_open(const char* path)
{
  pqLoadDataReaction::loadData(QStringList{ QString::fromUtf8(path) });
}

// A button, by its object name. Returns whether it could be pressed.
TEST_HAND_EXPORT int test_hand_click(const char* name)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto button = window->findChild<QAbstractButton*>(name);
    auto panel = button ? nullptr : window->findChild<QWidget*>("propertiesPanel");
    if (auto property = panel ? panel->findChild<QWidget*>(name) : nullptr)
    {
      button = property->findChild<QAbstractButton*>(); // its box to tick
    }
    if (button && button->isEnabled())
    {
      button->click();
      return 1;
    }
  }
  return 0;
}

// Whether a widget of the window is shown, by its object name.
TEST_HAND_EXPORT int test_hand_is_visible(const char* name)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    const auto widget = window->findChild<QWidget*>(name);
    if (widget && widget->isVisible())
    {
      return 1;
    }
  }
  return 0;
}

// The text of a label or of a field of a number, or what another widget tells screen readers, by
// its object name; nothing without one. Holds until the next call.
TEST_HAND_EXPORT const char* test_hand_label(const char* name)
{
  static QByteArray text;
  text.clear();
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    const auto widget = window->findChild<QWidget*>(name);
    const auto label = qobject_cast<QLabel*>(widget);
    const auto box = qobject_cast<QAbstractSpinBox*>(widget);
    text = label ? label->text().toUtf8()
      : box      ? box->text().toUtf8()
      : widget   ? widget->accessibleDescription().toUtf8()
                 : text;
  }
  return text.constData();
}

// How many pixels of the panel's contents the dock cuts off at the right; -1 without a panel.
TEST_HAND_EXPORT int test_hand_cut_off()
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto panel = window->findChild<QWidget*>("propertiesPanel");
    auto area = panel ? panel->findChild<QScrollArea*>("scrollArea") : nullptr;
    if (area)
    {
      return area->horizontalScrollBar()->maximum();
    }
  }
  return -1;
}

// Whether a widget, by its object name, is seen whole: nothing scrolled a part of it away.
TEST_HAND_EXPORT int test_hand_in_sight(const char* name)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto widget = window->findChild<QWidget*>(name);
    if (widget && widget->isVisible())
    {
      return widget->visibleRegion().boundingRect() == widget->rect() ? 1 : 0;
    }
  }
  return 0;
}

// Whether a widget of the properties panel is enabled; -1: there is none of this name.
TEST_HAND_EXPORT int test_hand_is_enabled(const char* name)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto panel = window->findChild<QWidget*>("propertiesPanel");
    if (auto widget = panel ? panel->findChild<QWidget*>(name) : nullptr)
    {
      return widget->isEnabled() ? 1 : 0;
    }
  }
  return -1;
}

// Chooses an entry in the list of a property that the properties panel shows. Returns whether it
// could.
TEST_HAND_EXPORT int test_hand_choose(const char* property, const char* entry)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto panel = window->findChild<QWidget*>("propertiesPanel");
    auto widget = panel ? panel->findChild<QWidget*>(property) : nullptr;
    auto list = widget ? widget->findChild<QComboBox*>() : nullptr;
    const int index = list && list->isEnabled() ? list->findText(QString::fromUtf8(entry)) : -1;
    if (index >= 0)
    {
      list->setCurrentIndex(index);
      Q_EMIT list->activated(index);
      return 1;
    }
  }
  return 0;
}

// Types into a field, by its object name, in place of what it holds.
TEST_HAND_EXPORT int test_hand_type(const char* name, const char* text)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto field = window->findChild<QWidget*>(name);
    auto box = qobject_cast<QAbstractSpinBox*>(field);
    auto own = qobject_cast<QLineEdit*>(field);
    auto line = own || !field ? own : field->findChild<QLineEdit*>(); // the first of a vector's
    if (line && line->isEnabled())
    {
      line->selectAll();
      QTest::keyClicks(line, QString::fromUtf8(text));
      QTest::keyClick(box ? static_cast<QWidget*>(box) : line, Qt::Key_Return);
      return 1;
    }
  }
  return 0;
}

// Gives the view the keyboard, as a click in it does.
TEST_HAND_EXPORT void test_hand_focus()
{
  if (QWidget* view = viewWidget())
  {
    view->window()->activateWindow();
    QApplication::setActiveWindow(view->window()); // without a window manager nobody else does
    view->setFocus();
  }
}

TEST_HAND_EXPORT int test_hand_has_focus()
{
  const QWidget* view = viewWidget();
  const QWidget* keyboard = view ? view->window()->focusWidget() : nullptr;
  return keyboard && (keyboard == view || view->isAncestorOf(keyboard)) ? 1 : 0;
}

// A click of the mouse on a button, by its object name, while the view has the keyboard's focus.
// Returns whether the view still has it.
TEST_HAND_EXPORT int test_hand_keeps_focus(const char* name)
{
  QWidget* view = viewWidget();
  QWidget* window = view ? view->window() : nullptr;
  auto button = window ? window->findChild<QAbstractButton*>(name) : nullptr;
  if (!button || !button->isEnabled())
  {
    return 0;
  }
  window->activateWindow();
  QApplication::setActiveWindow(window); // without a window manager nobody else does
  view->setFocus();
  QTest::mouseClick(button, Qt::LeftButton);
  return window->focusWidget() == view->focusWidget() ? 1 : 0;
}

// The window, pixels, as far as the screen has room.
TEST_HAND_EXPORT void test_hand_resize_window(int width, int height)
{
  if (QWidget* widget = viewWidget())
  {
    QWidget* window = widget->window();
    window->resize(QSize(width, height).boundedTo(window->screen()->availableGeometry().size()));
    QApplication::processEvents();
  }
}

// What can be operated inside a widget that is seen, in the order of the Tab key: a line for each
// with its class, its object name, what it tells screen readers, whether Tab reaches it, and the
// height of its middle in the widget. Holds until the next call.
TEST_HAND_EXPORT const char* test_hand_controls(const char* name)
{
  static QByteArray lines;
  lines.clear();
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto root = window->findChild<QWidget*>(name);
    for (QWidget* at = root ? root->nextInFocusChain() : nullptr; at && at != root;
      at = at->nextInFocusChain())
    {
      const bool operates = qobject_cast<QAbstractButton*>(at) ||
        qobject_cast<QAbstractSlider*>(at) || qobject_cast<QAbstractSpinBox*>(at) ||
        qobject_cast<QAbstractItemView*>(at) || qobject_cast<QComboBox*>(at) ||
        (qobject_cast<QLineEdit*>(at) && !qobject_cast<QAbstractSpinBox*>(at->parentWidget()));
      const bool shown = root->isAncestorOf(at) && at->isVisible() && at->isEnabled() &&
        !qobject_cast<QScrollBar*>(at) && !qobject_cast<QHeaderView*>(at);
      if (operates && shown)
      {
        QAccessibleInterface* told = QAccessible::queryAccessibleInterface(at);
        const QStringList line{ at->metaObject()->className(), at->objectName(),
          told ? told->text(QAccessible::Name).simplified() : QString(),
          at->focusPolicy() & Qt::TabFocus ? "1" : "0",
          QString::number(at->mapTo(root, at->rect().center()).y()) };
        lines += line.join('\t').toUtf8() + '\n';
      }
    }
  }
  return lines.constData();
}

// Whether a label has room for its text, by its object name.
TEST_HAND_EXPORT int test_hand_shows_all(const char* name)
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    if (auto label = window->findChild<QLabel*>(name))
    {
      const int needed =
        label->wordWrap() ? label->heightForWidth(label->width()) : label->sizeHint().height();
      return label->height() >= needed ? 1 : 0;
    }
  }
  return 0;
}

// Gives all widgets the colours of a dark theme, or those they had.
TEST_HAND_EXPORT void test_hand_dark(int dark)
{
  static const QPalette before = QApplication::palette();
  QPalette palette(QColor(49, 54, 59), QColor(35, 38, 41)); // Qt makes the others of these
  palette.setColor(QPalette::Highlight, QColor(61, 174, 233));
  palette.setColor(QPalette::Link, QColor(61, 174, 233));
  QApplication::setPalette(dark ? palette : before);
}

// How many pixels of the screen a logical pixel of the view has along a side.
TEST_HAND_EXPORT double test_hand_scale()
{
  QWidget* widget = viewWidget();
  return widget ? widget->devicePixelRatioF() : 1.0;
}

// Writes a widget as a picture, by its object name, or the whole screen. Returns whether it did.
TEST_HAND_EXPORT int test_hand_picture(const char* name, const char* file)
{
  if (qstrcmp(name, "") == 0)
  {
    return QGuiApplication::primaryScreen()->grabWindow(0).save(file) ? 1 : 0;
  }
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    if (auto widget = window->findChild<QWidget*>(name))
    {
      return widget->grab().save(file) ? 1 : 0;
    }
  }
  return 0;
}

TEST_HAND_EXPORT int test_hand_is_there()
{
  return qobject_cast<QApplication*>(QCoreApplication::instance()) != nullptr;
}

TEST_HAND_EXPORT void test_hand_quit()
{
  QTimer::singleShot(0, qApp, &QApplication::quit);
}

// The view, pixels. The window grows by what it would hide of a lone view, if the screen has room.
TEST_HAND_EXPORT void test_hand_resize(int width, int height)
{
  if (QWidget* widget = viewWidget())
  {
    widget->setFixedSize(width, height);
    QApplication::processEvents();
    const QSize hidden = widget->size() - widget->visibleRegion().boundingRect().size();
    QWidget* window = widget->window();
    window->resize(
      (window->size() + hidden).boundedTo(window->screen()->availableGeometry().size()));
    QApplication::processEvents();
  }
}
