// SPDX-License-Identifier: BSD-3-Clause
// The strokes as a list to disable, change and delete them in, with its buttons.
#ifndef BrainShift_StrokeList_h
#define BrainShift_StrokeList_h

#include <QWidget>

class QLabel;
class QToolButton;
class StrokeModel;
class StrokeTree;

class StrokeList : public QWidget
{
  Q_OBJECT

public:
  StrokeList(StrokeModel* model, QWidget* parent = nullptr);

private:
  void refresh();

  StrokeModel* const Strokes;
  StrokeTree* const Tree;
  QLabel* const Problem;
  QToolButton* const Delete;
  QToolButton* const Reset;
};

#endif
