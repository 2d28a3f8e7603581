// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Small plots of the panel: a length over the strokes, and a histogram of lengths.
#ifndef BrainShift_Plots_h
#define BrainShift_Plots_h

#include <QList>
#include <QWidget>

namespace brainshift
{
/// A small histogram of signed lengths in mm. Its bins are equally wide and symmetric about 0. It
/// follows the palette and is described to screen readers in words.
class HistogramPlot : public QWidget
{
  Q_OBJECT

public:
  explicit HistogramPlot(QWidget* parent = nullptr);

  /// `width` of a bin in mm, and how many lengths lie in each bin. Their number is even. Empty,
  /// or a width of 0: there is nothing to show.
  void setHistogram(double width, const QList<double>& counts);

  /// The bin at a position in the widget (pixels); below 0 if there is none.
  int binAt(const QPointF& place) const;
  /// The range and the count of a bin, in words.
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

/// A small curve of an RMS distance (mm) over the strokes. Its last point, the current one, is
/// marked and labelled with its number. It follows the palette and is described to screen readers
/// in words.
class CurvePlot : public QWidget
{
  Q_OBJECT

public:
  explicit CurvePlot(QWidget* parent = nullptr);

  /// The RMS (mm) after none, one, and so on, to all strokes. NaN: not measured. Empty: there is
  /// nothing to show.
  void setLengths(const QList<double>& lengths);

  /// The number of strokes before the nearest point of the curve, for a position in the widget
  /// (pixels); below 0 if there is none.
  int pointAt(const QPointF& place) const;
  /// Position of the point after so many strokes (pixels), if it was measured.
  QPointF placeOf(int strokes) const;
  /// The RMS distance after so many strokes, in words.
  QString textOf(int strokes) const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

protected:
  bool event(QEvent* event) override; ///< The tool tip tells the point under the cursor.
  void paintEvent(QPaintEvent* event) override;

private:
  QRectF area() const; ///< where the points lie, pixels
  void drawCurve(QPainter& painter) const;
  void drawCurrent(QPainter& painter) const;

  QList<double> Lengths;
  double Longest = 0.0; ///< mm
};
}

#endif
