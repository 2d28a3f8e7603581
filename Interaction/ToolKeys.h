// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keys in views: they work the tool in hand, and step through slices. The table of commands
/// defines which. They come before ParaView's shortcuts, but only while the cursor is over a view,
/// or the view has the keyboard, and no text is typed.
#ifndef BrainShift_ToolKeys_h
#define BrainShift_ToolKeys_h

#include "Interaction/Commands/Commands.h"

#include <QEvent>

class QKeyEvent;

namespace brainshift
{
class StrokeEditor;
class ToolCarrier;
struct HandEvent;

class ToolKeys : public QObject
{
  Q_OBJECT

public:
  explicit ToolKeys(ToolCarrier* carrier); ///< The carrier deletes it.

  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  bool handleKey(QKeyEvent& key, QEvent::Type type);
  bool canDo(Command command) const;
  bool viewHasKeys() const;
  void act(const KeyCommand& found, bool shift);
  void holdAxis(ToolSettings::AxisHold axis);
  void setInterest();
  void moveCursor(int direction); ///< See Command::MoveCursor.
  void step(int clicks);
  void hold(bool shift); ///< See Command::TakeHold.
  HandEvent eventAtCursor() const;
  StrokeEditor* editorUnderCursor() const; ///< Null if nothing can be deformed there.

  ToolCarrier& Carrier;
};
}

#endif
