// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One Qt application for all tests of a program. It needs no display.
#ifndef BrainShift_Application_h
#define BrainShift_Application_h

#include <QApplication>

#include <gtest/gtest.h>

#include <memory>

namespace brainshift
{
/// The application ends with the tests: later, what Qt keeps of fonts would count as lost.
class WithApplication : public testing::Environment
{
public:
  QApplication* application()
  {
    static int count = 3;
    static char program[] = "PanelTest", option[] = "-platform", value[] = "offscreen";
    static char* arguments[] = { program, option, value, nullptr };
    if (!this->Instance)
    {
      this->Instance = std::make_unique<QApplication>(count, arguments);
    }
    return this->Instance.get();
  }

  void TearDown() override { this->Instance = nullptr; }

private:
  std::unique_ptr<QApplication> Instance;
};

inline WithApplication* const withApplication =
  static_cast<WithApplication*>(testing::AddGlobalTestEnvironment(new WithApplication));

/// Widgets, icons and palettes need an application.
inline QApplication* application()
{
  return withApplication->application();
}
}

#endif
