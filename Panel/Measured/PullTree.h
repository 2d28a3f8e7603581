// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// View of a PullModel. Its keys are those of the list of strokes, under Scope::List in the table
/// of commands.
#ifndef BrainShift_PullTree_h
#define BrainShift_PullTree_h

#include <QList>
#include <QTreeView>

namespace brainshift
{
class PullModel;

class PullTree : public QTreeView
{
  Q_OBJECT

public:
  PullTree(PullModel* model, QWidget* parent = nullptr);

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
  void moveColumn(int by);
  void showWhereIfRoom();
  int heightOfRows(int rows) const;

  PullModel* const Pulls;
};
}

#endif
