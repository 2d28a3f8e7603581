// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A small histogram of signed lengths in mm. Its bins are equally wide and symmetric about 0. It
/// follows the palette and is told to screen readers in words.
#ifndef BrainShift_HistogramPlot_h
#define BrainShift_HistogramPlot_h

#include <QList>
#include <QWidget>

namespace brainshift
{
class HistogramPlot : public QWidget
{
  Q_OBJECT

public:
  explicit HistogramPlot(QWidget* parent = nullptr);

  /// `width` of a bin in mm, and how many lengths lie in each bin. Their number is even. Empty,
  /// or a width of 0: there is nothing to show.
  void setHistogram(double width, const QList<double>& counts);

  /// The bin at a place of the widget (pixels); below 0 if there is none.
  int binAt(const QPointF& place) const;
  /// What a bin holds, in words.
  QString textOf(int bin) const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

protected:
  bool event(QEvent* event) override; ///< The tool tip tells the bin under the cursor.
  void paintEvent(QPaintEvent* event) override;

private:
  /// Where the bars stand, without labels, pixels.
  QRectF barsArea() const;
  double edgeOf(int bin) const; ///< The lower edge, mm.

  double Width = 0.0;
  QList<double> Counts;
};
}

#endif
