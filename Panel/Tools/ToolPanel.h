// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Chooses the tool and its settings. It shows only the settings of the tool in hand. Panel,
/// toolbar and views share ToolSettings.
#ifndef BrainShift_ToolPanel_h
#define BrainShift_ToolPanel_h

#include "Interaction/Commands/ToolSettings.h"

#include <QList>
#include <QWidget>

class QBoxLayout;
class QLabel;
class QToolButton;

namespace brainshift
{
// The mouse gestures of a view, as one line for the panel and the status bar. The words are those
// of the table of commands.

/// The line for the tool in hand over a ground.
QString mouseHint(const ToolSettings& settings, ToolSettings::Ground ground);

class ReachDrawing;
class ValueSlider;

class ToolPanel : public QWidget
{
  Q_OBJECT

public:
  ToolPanel(QWidget* parent = nullptr);

  /// Largest spacing of control points, mm. Smaller radii get a warning.
  void setLatticeSpacing(double spacing);

  /// False before the filter was applied: there is nothing to work on yet.
  void setReady(bool ready);

private:
  struct Value; ///< A number of ToolSettings and the slider that shows it.
  static const QList<Value>& values();

  void addButtons(QBoxLayout* column);
  void addSliders(QBoxLayout* column);
  void addWarning(QBoxLayout* column);
  void refresh();
  QString advice() const;

  QList<QToolButton*> Buttons;
  QList<ValueSlider*> Sliders; ///< In the order of values().
  ReachDrawing* const Drawing; ///< Of the tool in hand.
  QLabel* const Hint;
  QWidget* const Warning;
  QLabel* const WarningText;
  double LatticeSpacing = 0.0;
  bool Ready = true;
};
}

#endif
