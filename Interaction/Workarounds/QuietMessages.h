// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Warnings of BrainShift do not open ParaView's window Output Messages; see README.md.
#ifndef BrainShift_QuietMessages_h
#define BrainShift_QuietMessages_h

#include <QObject>
#include <QPointer>
#include <QString>

class QMainWindow;
class pqOutputWidget;

namespace brainshift
{
/// The words of a warning of a BrainShift class, without the place in the source and the object
/// that VTK puts before them. Empty for errors and for messages of others.
///
/// @param message  as VTK makes it
/// @param type     a QtMsgType
QString wordsOfWarning(const QString& message, int type);

/// Output Messages lists warnings of BrainShift and stays closed; `said` is their way to the user.
/// Errors, and messages of others, open it as before.
class QuietMessages : public QObject
{
  Q_OBJECT

public:
  /// Lives as long as the window.
  explicit QuietMessages(QMainWindow* window);

  /// Opens Output Messages, for who wants to read all of them.
  void open();

Q_SIGNALS:
  void said(const QString& words); ///< A sentence or more, with full stops.

private Q_SLOTS:
  void judge(const QString& message, int type);

private:
  QMainWindow* const Window;
  QPointer<pqOutputWidget> Output;
};
}

#endif
