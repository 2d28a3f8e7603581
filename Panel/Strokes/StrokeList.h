// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The list of strokes with its buttons. The user disables, changes and deletes strokes in it.
#ifndef BrainShift_StrokeList_h
#define BrainShift_StrokeList_h

#include <QPointer>
#include <QWidget>

class QLabel;
class QToolButton;

namespace brainshift
{
class ListTree;
class StrokeModel;

class StrokeList : public QWidget
{
  Q_OBJECT

public:
  StrokeList(StrokeModel* model, QWidget* parent = nullptr);

private:
  void refresh();
  void giveFocusBack();
  void enable(QToolButton* button, bool enabled);

  StrokeModel* const Strokes;
  ListTree* const Tree;
  QLabel* const Problem;
  QToolButton* const Delete;
  QToolButton* const Reset;
  QPointer<QWidget> FocusBefore; ///< What lost the focus to the panel around the list.
};
}

#endif
