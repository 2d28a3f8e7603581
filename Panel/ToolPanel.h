// SPDX-License-Identifier: BSD-3-Clause
// Chooses the tool and how widely it works; shows only what the tool in hand has. Panel, toolbar
// and view share ToolSettings.
#ifndef BrainShift_ToolPanel_h
#define BrainShift_ToolPanel_h

#include "ToolSettings.h"

#include <QList>
#include <QWidget>

class QBoxLayout;
class QLabel;
class QToolButton;
class ValueSlider;

class ToolPanel : public QWidget
{
  Q_OBJECT

public:
  ToolPanel(QWidget* parent = nullptr);

  // Largest distance between neighbouring control points, mm: smaller radii are warned of.
  void setLatticeSpacing(double spacing);

  // Before its first picture a filter has nothing to take hold of.
  void setReady(bool ready);

private:
  struct Value; // a number of ToolSettings and the slider that shows it
  static const QList<Value>& values();

  void addButtons(QBoxLayout* column);
  void addSliders(QBoxLayout* column);
  void addWarning(QBoxLayout* column);
  void refresh();
  QString advice() const;

  QList<QToolButton*> Buttons;
  QList<ValueSlider*> Sliders; // in the order of values()
  QLabel* const Hint;
  QWidget* const Warning;
  QLabel* const WarningText;
  double LatticeSpacing = 0.0;
  bool Ready = true;
};

#endif
