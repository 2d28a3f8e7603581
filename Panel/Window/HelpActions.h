// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// BrainShift's entries in ParaView's Help menu: mouse and keys, tutorial, and About.
#ifndef BrainShift_HelpActions_h
#define BrainShift_HelpActions_h

#include <QActionGroup>
#include <QString>

namespace brainshift
{
// The table of commands as text: for the help window, and for Documentation/keys.md, which a test
// compares with it.

/// All of the table as rich text, a section for each scope.
QString keysAsHtml();

/// All of the table as the content of Documentation/keys.md.
QString keysAsMarkdown();

class HelpActions : public QActionGroup
{
  Q_OBJECT

public:
  HelpActions(QObject* parent);

private:
  void showShortcuts();
  void showAbout();
};
}

#endif
