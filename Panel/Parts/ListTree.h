// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// View of a list of strokes, pulls or landmarks. The keyboard alone is enough to use it: the table
/// of commands lists its keys under Scope::List.
#ifndef BrainShift_ListTree_h
#define BrainShift_ListTree_h

#include <QList>
#include <QTreeView>

namespace brainshift
{
class ListModel;

class ListTree : public QTreeView
{
  Q_OBJECT

public:
  /// How many rows are seen at once, and what stands in the view while there are none.
  struct Room
  {
    int fewestRows;
    int mostRows;
    QString empty;
  };

  ListTree(ListModel* model, const Room& room, QWidget* parent = nullptr);

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
  void softenHighlight();
  void toggleSelected();
  void moveColumn(int by);
  void showWhereIfRoom();
  int heightOfRows(int rows) const;

  ListModel* const Rows;
  const Room Space;
};
}

#endif
