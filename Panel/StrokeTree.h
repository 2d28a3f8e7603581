// SPDX-License-Identifier: BSD-3-Clause
// View of a StrokeModel that can be worked with the keyboard alone: arrows choose a cell, Enter
// edits it, Space enables or disables, Delete deletes.
#ifndef BrainShift_StrokeTree_h
#define BrainShift_StrokeTree_h

#include <QList>
#include <QTreeView>

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
  void softenHighlight();
  int heightOfRows(int rows) const;

  StrokeModel* const Strokes;
};

#endif
