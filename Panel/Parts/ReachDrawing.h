// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A small drawing of the radii of a tool: an ellipse or a circle, shaded by how much of the
/// stroke its tissue follows, with its sizes in mm. It follows the palette.
#ifndef BrainShift_ReachDrawing_h
#define BrainShift_ReachDrawing_h

#include <QWidget>

#include <functional>

namespace brainshift
{
/// The radii of a tool and the profile inside them.
struct Reach
{
  double along = 0.0;   ///< mm from the centre to the edge along the push; 0 draws nothing.
  double across = 0.0;  ///< mm from the centre to the edge across the push.
  bool hasAxis = false; ///< Whether tissue moves along one axis only. If not, a circle is drawn.
  /// The fraction (0 to 1) of the stroke that tissue follows, for its distance from the centre as
  /// a fraction of the reach (0 to 1). It is 1 at 0 and must not rise.
  std::function<double(double)> weight;
};

/// The distance, as a fraction of the reach, at which tissue follows half of the stroke.
double halfDistance(const Reach& reach);

/// The drawing in words, for a tool tip and for screen readers.
QString describe(const Reach& reach);

class ReachDrawing : public QWidget
{
  Q_OBJECT

public:
  explicit ReachDrawing(QWidget* parent = nullptr);

  void setReach(const Reach& reach);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return { 0, this->sizeHint().height() }; }

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  void drawTissue(QPainter& painter, const QPointF& centre, const QSizeF& half) const;
  void drawAxis(QPainter& painter, const QPointF& centre, double halfLength) const;
  void drawSizes(QPainter& painter, const QPointF& centre, const QSizeF& half) const;
  void drawText(
    QPainter& painter, const QPointF& at, Qt::Alignment side, const QString& text) const;

  Reach Shown;
};
}

#endif
