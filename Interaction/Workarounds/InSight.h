// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps a part of ParaView's panel within the visible width. The panel is as wide as its widest
/// part, which at first is wider than its dock. Without this, the dock cuts off buttons at the
/// right.
#ifndef BrainShift_InSight_h
#define BrainShift_InSight_h

#include <QObject>

class QScrollArea;
class QWidget;

namespace brainshift
{
class InSight : public QObject
{
  Q_OBJECT

public:
  /// Adapts the right margin of the layout of `part`.
  explicit InSight(QWidget* part);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void fitMargin();

  QWidget* const Part;
  QScrollArea* Panel = nullptr; ///< Known when the part is shown for the first time.
};
}

#endif
