// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// BrainShift's entries in ParaView's Help menu: mouse and keys, tutorial, and About.
#ifndef BrainShift_HelpActions_h
#define BrainShift_HelpActions_h

#include <QActionGroup>

namespace brainshift
{
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
