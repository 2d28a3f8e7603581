// SPDX-License-Identifier: BSD-3-Clause
// Says in the window's status bar what the mouse does in the view, while a tool is in hand.
#ifndef BrainShift_StatusLine_h
#define BrainShift_StatusLine_h

#include <QLabel>

class StatusLine : public QLabel
{
  Q_OBJECT

public:
  StatusLine(QWidget* parent);

  // A long line does not widen the window.
  QSize minimumSizeHint() const override { return { 0, this->QLabel::minimumSizeHint().height() }; }

private:
  void refresh();
};

#endif
