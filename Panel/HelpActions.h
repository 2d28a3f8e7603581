// SPDX-License-Identifier: BSD-3-Clause
// Entries of ParaView's Help menu: what keys and mouse do, and what BrainShift is.
#ifndef BrainShift_HelpActions_h
#define BrainShift_HelpActions_h

#include <QActionGroup>

class HelpActions : public QActionGroup
{
  Q_OBJECT

public:
  HelpActions(QObject* parent);

private:
  void showShortcuts();
  void showAbout();
};

#endif
