// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Shows in the status bar of the window what the mouse does in the view under the cursor. If the
/// view shows another volume than the tool works on, a button takes the tool to it.
#ifndef BrainShift_StatusLine_h
#define BrainShift_StatusLine_h

#include <QWidget>

class QLabel;
class QToolButton;

namespace brainshift
{
class StatusLine : public QWidget
{
  Q_OBJECT

public:
  StatusLine(QWidget* parent);

private:
  void refresh();

  QToolButton* Switch;
  QLabel* Line;
};
}

#endif
