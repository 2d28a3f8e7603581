// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Workarounds for the size of ParaView's panel; see README.md.
#ifndef BrainShift_Docks_h
#define BrainShift_Docks_h

#include <QObject>

class QScrollArea;
class QWidget;

namespace brainshift
{
/// Keeps a part of ParaView's panel within the visible width. The panel is as wide as its widest
/// part, which at first is wider than its dock. Without this, the dock cuts off buttons at the
/// right.
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

/// Makes the dock of ParaView's panel larger: wider by what the panel's contents lack, until the
/// user resizes it, and once higher where the window is low. ParaView's own editor of colours is
/// wider than the dock at first, and a bar would hide its last buttons.
class RoomyDock : public QObject
{
  Q_OBJECT

public:
  /// Watches the panel that `part` is a part of, from when it is shown. If the user narrows the
  /// dock later, it stays narrow.
  explicit RoomyDock(QWidget* part);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void watch();
  void widen();

  QWidget* const Part;
  QScrollArea* Panel = nullptr; ///< Known when the part is shown for the first time.
};
}

#endif
