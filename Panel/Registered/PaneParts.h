// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Parts of the panes of a registration: buttons, texts, and a curve of the cost.
#ifndef BrainShift_PaneParts_h
#define BrainShift_PaneParts_h

#include <QList>
#include <QString>
#include <QWidget>

class QLabel;
class QToolButton;

namespace brainshift
{
struct LandmarkError;

/// The progress of what is done, as progress bars of panes count it.
constexpr int WholeProgress = 100;

/// A number with decimals.
QString figure(double value, int digits = 2);

/// A button that leaves the keyboard where it is when it is clicked.
QToolButton* makeButton(const char* name, const QString& text, const QString& tip);

/// A text that wraps and can be copied.
QLabel* makeText(const char* name);

/// A sentence about the trust in a result (AlignFigures::trust).
QString trustText(const QString& trust);

/// What is said of a result if something that it depends on has changed since. `ended`: how, as the
/// beginning of a sentence.
QString changedText(const QString& ended, int steps);

/// A sentence while the result is checked.
QString checkingText();

/// Keeps a result that failed its checks. Hidden while there is none.
QToolButton* makeKeep(const char* name);

/// A table of the errors of landmarks with a note below it, as rich text. Empty without errors.
QString errorTable(const QList<LandmarkError>& errors, const QString& note);

/// Shows a report and a warning, each hidden if it is empty.
void showTexts(QLabel* report, const QString& text, QLabel* warning, const QString& warningText);

/// A small curve of the cost of a similarity over the steps of a refinement. It follows the
/// palette, and screen readers get it in words.
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
