// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A small curve of the cost of a similarity over the steps of a refinement. It follows
/// the palette, and screen readers get it in words.
#ifndef BrainShift_CostPlot_h
#define BrainShift_CostPlot_h

#include <QList>
#include <QWidget>

namespace brainshift
{
class CostPlot : public QWidget
{
  Q_OBJECT

public:
  explicit CostPlot(QWidget* parent = nullptr);

  /// The cost after each step, as a fraction of that at the start (1). Empty: no step yet.
  void setCosts(const QList<double>& costs);

  QSize sizeHint() const override { return this->minimumSizeHint(); }
  QSize minimumSizeHint() const override;

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  QRectF area() const; ///< of the curve, pixels

  QList<double> Costs; ///< with the start before the first step
};
}

#endif
