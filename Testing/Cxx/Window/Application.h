// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One Qt application for all tests of a program. It needs no display.
#ifndef BrainShift_Application_h
#define BrainShift_Application_h

#include <QApplication>

namespace brainshift
{
/// Widgets, icons and palettes need an application.
inline QApplication* application()
{
  static int count = 3;
  static char program[] = "PanelTest", option[] = "-platform", value[] = "offscreen";
  static char* arguments[] = { program, option, value, nullptr };
  static auto instance = new QApplication(count, arguments);
  return instance;
}
}

#endif
