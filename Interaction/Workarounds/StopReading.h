// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The cross beside the progress bar, while one of our readers reads on this machine, or a large
/// volume is written: it stops that. ParaView enables the cross from 6.1 on alone. There a press
/// does not reach it while a writer is at work, and would not stop one.
#ifndef BrainShift_StopReading_h
#define BrainShift_StopReading_h

#include <QObject>
#include <QPointer>

class pqProgressManager;
class QAbstractButton;
class QEvent;
class QMouseEvent;

namespace brainshift
{
class StopReading : public QObject
{
  Q_OBJECT

public:
  explicit StopReading(QObject* parent);

  /// Lets through what the window needs to show itself and to press the cross.
  bool eventFilter(QObject* object, QEvent* event) override;

private:
  void findCross();
  bool isOnCross(const QMouseEvent& event) const;
  void handlePress();
  void stop() const;

  pqProgressManager* Manager;
  QPointer<QAbstractButton> Cross;
  bool IsHandling = false;
};
}

#endif
