// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Layouts of views during and after undo and redo.
#ifndef BrainShift_UndoneLayouts_h
#define BrainShift_UndoneLayouts_h

#include <QObject>

namespace brainshift
{
/// Tells the session how undo and redo have left each layout of views. ParaView does not: the next
/// change of a layout is then recorded against what it was before the undo, so that taking it back
/// leaves cells "Create View" and views that were gone.
class UndoneLayouts : public QObject
{
  Q_OBJECT

public:
  /// Follows the undo stack of the application until it is deleted.
  explicit UndoneLayouts(QObject* parent = nullptr);
};

/// Lets ParaView's editors wait for the end of an undo or a redo. A layout that it brings back
/// works off events in the middle of it. An editor whose timer ends then writes what it showed
/// before, for example the old opacities of a map whose colours are the new ones.
class WaitingEditors : public QObject
{
  Q_OBJECT

public:
  /// Watches the events of the application until it is deleted.
  explicit WaitingEditors(QObject* parent = nullptr);

  bool eventFilter(QObject* watched, QEvent* event) override;
};
}

#endif
