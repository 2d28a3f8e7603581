// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A small curve of an RMS distance (mm) over the strokes. Its last point, the current one, is
/// marked and says its number. It follows the palette and is told to screen readers in words.
#ifndef BrainShift_CurvePlot_h
#define BrainShift_CurvePlot_h

#include <QList>
#include <QWidget>

namespace brainshift
{
class CurvePlot : public QWidget
{
  Q_OBJECT

public:
  explicit CurvePlot(QWidget* parent = nullptr);

  /// The RMS (mm) after none, one, and so on, to all strokes. NaN: not measured. Empty: there is
  /// nothing to show.
  void setLengths(const QList<double>& lengths);

  /// How many strokes the nearest point of the curve follows, for a place of the widget (pixels);
  /// below 0 if there is none.
  int pointAt(const QPointF& place) const;
  /// Position of the point after so many strokes (pixels), if it was measured.
  QPointF placeOf(int strokes) const;
  /// What the point after so many strokes says, in words.
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
