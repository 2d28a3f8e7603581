// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A small curve of how far two volumes still disagree, over the steps of a refinement. It follows
/// the palette and is told to screen readers in words.
#ifndef BrainShift_DisagreementPlot_h
#define BrainShift_DisagreementPlot_h

#include <QList>
#include <QWidget>

namespace brainshift
{
class DisagreementPlot : public QWidget
{
  Q_OBJECT

public:
  explicit DisagreementPlot(QWidget* parent = nullptr);

  /// The disagreement after each step, as a share of that at the beginning (1). Empty: no step yet.
  void setShares(const QList<double>& shares);

  QSize sizeHint() const override { return this->minimumSizeHint(); }
  QSize minimumSizeHint() const override;

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  QRectF area() const; ///< where the curve lies, pixels

  QList<double> Shares; ///< with the beginning before the first step
};
}

#endif
