// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// View of a StrokeModel. The keyboard alone is enough to use it: the table of commands lists its
/// keys under Scope::List.
#ifndef BrainShift_StrokeTree_h
#define BrainShift_StrokeTree_h

#include <QList>
#include <QTreeView>

namespace brainshift
{
class StrokeModel;

class StrokeTree : public QTreeView
{
  Q_OBJECT

public:
  StrokeTree(StrokeModel* model, QWidget* parent = nullptr);

  QList<int> selectedRows() const;
  void removeSelected();

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

Q_SIGNALS:
  void selectedRowsChanged();

protected:
  void changeEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

private:
  void toggleSelected();
  void moveColumn(int by);
  void showWhereIfRoom();
  int heightOfRows(int rows) const;

  StrokeModel* const Strokes;
};
}

#endif
