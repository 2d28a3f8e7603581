// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The steps of a case: a button for each, and what it lacks or found.
#ifndef BrainShift_StepRows_h
#define BrainShift_StepRows_h

#include <QMap>
#include <QWidget>

class QGridLayout;
class QJsonArray;
class QLabel;
class QPushButton;

namespace brainshift
{
class StepRows : public QWidget
{
  Q_OBJECT

public:
  StepRows();

  /// Shows steps as `_told_steps` of dock.py tells them.
  void show(const QJsonArray& told);
  /// Shows another text for a step, and on its button.
  void showInstead(const QString& step, const QString& text, const QString& button);

Q_SIGNALS:
  /// The user pressed the button of a step.
  void pressed(const QString& step);

protected:
  void changeEvent(QEvent* event) override;

private:
  struct Row
  {
    QPushButton* button = nullptr;
    QLabel* sign = nullptr;
    QLabel* text = nullptr;
    bool lacks = false;      ///< whether something is missing
    bool isDoubtful = false; ///< whether what it found may be wrong
  };
  Row& row(const QString& step);
  void paint(const Row& row);

  QGridLayout* Grid;
  QMap<QString, Row> Rows;
};
}

#endif
