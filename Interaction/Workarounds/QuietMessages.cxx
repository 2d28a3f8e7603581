// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/QuietMessages.h"

#include <pqOutputWidget.h>

#include <QDockWidget>
#include <QMainWindow>
#include <QRegularExpression>

namespace brainshift
{
namespace
{
constexpr const char* Slot = "handleMessage"; // of ParaView's window: opens Output Messages

QDockWidget* dockAround(QWidget* widget)
{
  while (widget && !qobject_cast<QDockWidget*>(widget))
  {
    widget = widget->parentWidget();
  }
  return qobject_cast<QDockWidget*>(widget);
}
}

QString wordsOfWarning(const QString& message, int type)
{
  static const QRegularExpression form(
    "^Warning: In (?:.*/)?Guard\\.cxx, line \\d+\\n"                   // where warn() of Guard.h is
    "(?:\\w* ?\\((?:nullptr|(?:'[^']*', )?(?:0x)?[0-9a-fA-F]+)\\): )?" // which object
    "(.+)$",
    QRegularExpression::DotMatchesEverythingOption);
  const auto found = form.match(message.trimmed());
  return type == QtWarningMsg && found.hasMatch() ? found.captured(1).simplified() : QString();
}

QuietMessages::QuietMessages(QMainWindow* window)
  : QObject(window)
  , Window(window)
  , Output(window->findChild<pqOutputWidget*>())
{
  // Only where the slot is the one that is known.
  const QByteArray slot = QByteArray(Slot) + "(QString,int)";
  if (this->Output && window->metaObject()->indexOfMethod(slot) >= 0 &&
    this->Output->disconnect(SIGNAL(messageDisplayed(QString, int)), window))
  {
    // Later: the message holds a lock, and a picture that the status bar causes may warn as well.
    this->connect(this->Output, &pqOutputWidget::messageDisplayed, this, &QuietMessages::judge,
      Qt::QueuedConnection);
  }
}

void QuietMessages::judge(const QString& message, int type)
{
  const QDockWidget* dock = dockAround(this->Output);
  const QString words = wordsOfWarning(message, type);
  if (!words.isEmpty())
  {
    Q_EMIT this->said(words);
  }
  if (words.isEmpty() || (dock && dock->isVisible()))
  {
    QMetaObject::invokeMethod(this->Window, Slot, Q_ARG(QString, message), Q_ARG(int, type));
  }
}

void QuietMessages::open()
{
  if (QDockWidget* dock = dockAround(this->Output))
  {
    dock->show();
    dock->raise();
  }
}
}
