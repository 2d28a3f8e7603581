// SPDX-License-Identifier: BSD-3-Clause
// Keeps a part of ParaView's panel within what is seen of it. The panel is as wide as its widest
// part, which at first is wider than its dock; without this, buttons at the right are cut off.
#ifndef BrainShift_InSight_h
#define BrainShift_InSight_h

#include <QObject>

class QScrollArea;
class QWidget;

class InSight : public QObject
{
  Q_OBJECT

public:
  // `part` has a layout, whose right margin is from now on what lies out of sight.
  explicit InSight(QWidget* part);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  QWidget* const Part;
  QScrollArea* Panel = nullptr; // known when the part is first shown
};

#endif
