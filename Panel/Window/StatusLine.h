// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Shows in the status bar of the window what the mouse does in the view under the cursor.
#ifndef BrainShift_StatusLine_h
#define BrainShift_StatusLine_h

#include <QLabel>

namespace brainshift
{
class StatusLine : public QLabel
{
  Q_OBJECT

public:
  StatusLine(QWidget* parent);

  /// A long line must not widen the window.
  QSize minimumSizeHint() const override { return { 0, this->QLabel::minimumSizeHint().height() }; }

private:
  void refresh();
};
}

#endif
