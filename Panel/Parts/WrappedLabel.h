// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A text over several lines that keeps its height while a scroll bar comes and goes beside it.
#ifndef BrainShift_WrappedLabel_h
#define BrainShift_WrappedLabel_h

#include <QLabel>

namespace brainshift
{
/// ParaView's panel is a scroll area. A QLabel that wraps asks for a height that depends on its
/// width, so the area's scroll bar changes the height, which changes the scroll bar: Qt resizes the
/// area without end. This label's height changes only with its text or with a wider or narrower
/// panel, and the scroll area that shows it keeps its vertical scroll bar.
class WrappedLabel : public QLabel
{
public:
  explicit WrappedLabel(QWidget* parent);

  bool hasHeightForWidth() const override { return false; }
  QSize minimumSizeHint() const override;
  QSize sizeHint() const override { return this->minimumSizeHint(); }

protected:
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;

private:
  mutable QString MeasuredText;
  mutable int MeasuredHeight = 0; // pixels
  int MeasuredWidth = 0;          // pixels; 0 before the label is laid out
};
}

#endif
