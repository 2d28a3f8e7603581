// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/Welcome.h"

#include <QApplication>
#include <QObject>
#include <QTimer>
#include <QWidget>

#include <cstring>
#include <memory>

namespace brainshift
{
namespace
{
constexpr int LookAgain = 100; // ms
constexpr int MostLooks = 300; // a slow start may read a volume first
}

bool closeWelcome()
{
  QWidget* modal = QApplication::activeModalWidget();
  return modal && std::strcmp(modal->metaObject()->className(), "pqWelcomeDialog") == 0 &&
    modal->close();
}

void keepWelcomeAway(QObject* owner)
{
  auto timer = new QTimer(owner);
  const auto looks = std::make_shared<int>(0);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, looks] {
    if (closeWelcome() || ++*looks == MostLooks)
    {
      timer->deleteLater();
    }
  });
  timer->start(LookAgain);
}
}
