// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Aligns the reference of a Compare Volumes from its panel: buttons, progress and result.
#ifndef BrainShift_AlignPane_h
#define BrainShift_AlignPane_h

#include <QPointer>
#include <QWidget>

class QLabel;
class QProgressBar;
class QToolButton;
class pqPipelineSource;

namespace brainshift
{
class AlignEditor;

class AlignPane : public QWidget
{
  Q_OBJECT

public:
  AlignPane(pqPipelineSource* compare, QWidget* parent = nullptr);

private:
  void refresh();
  void report();

  const QPointer<AlignEditor> Editor; ///< It may go before its panel does.
  QToolButton* const Align;
  QToolButton* const Stop;
  QProgressBar* const Progress;
  QLabel* const Report;
  QLabel* const Warning;
  QToolButton* const Keep;
};
}

#endif
