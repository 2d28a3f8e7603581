// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The lists of strokes, pulls and landmarks: their rows, and their view.
#ifndef BrainShift_List_h
#define BrainShift_List_h

#include <QAbstractTableModel>
#include <QList>
#include <QString>
#include <QTreeView>

#include <glm/glm.hpp>

#include <optional>

class QToolButton;

namespace brainshift
{
// Base of the lists of strokes, pulls and landmarks. Each row has a check mark in the first column
// and may have numbers to edit. A subclass defines the contents of its cells and writes edits.

/// "10, 20, 30"
QString positionText(const glm::dvec3& position, int decimals);

class ListModel : public QAbstractTableModel
{
  Q_OBJECT

public:
  struct Column
  {
    QString title;
    QString tip;
    bool isText = false; ///< If not, a number, on the right.
  };
  /// A number that can be edited, with its limits.
  struct Number
  {
    double value;
    double least;
    double most;
  };
  /// The limits of a number, for its editor.
  enum Role
  {
    LeastRole = Qt::UserRole,
    MostRole,
  };

  ListModel(const QList<Column>& columns, QObject* parent);

  /// The column of positions, which needs most room. Below 0: none. It is the last one.
  int whereColumn() const;

  virtual bool isOn(int row) const = 0;
  /// Switches rows on or off: one edit.
  virtual void setOn(const QList<int>& rows, bool on) = 0;
  /// Deletes rows: one edit.
  virtual void removeRowsOf(const QList<int>& rows) = 0;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

protected:
  /// Rows that there are now; the views know of rowCount().
  virtual int count() const = 0;
  virtual QString text(int row, int column) const = 0;
  virtual QString toolTip(int row, int column) const = 0;
  /// Shown as a sign, and as the tool tip. Empty: none.
  virtual QString warning(int row, int column) const;
  virtual bool isBold(int row) const;
  /// None: the cell cannot be edited.
  virtual std::optional<Number> number(int row, int column) const;
  virtual void change(int row, int column, double number);

  /// Announces count() rows and that all cells may have changed.
  void announce();
  /// Announces that the cells of a column may have changed.
  void announceColumn(int column);

private:
  QVariant number(const QModelIndex& index, int role) const;

  const QList<Column> Columns;
  int Rows = 0; ///< As announced to views.
};

class ListModel;

/// A button below a list. A click leaves the keyboard where it is.
QToolButton* makeListButton(QWidget* parent, const char* name, const QString& text,
  const QString& tip, const char* icon = nullptr);

/// View of a list of strokes, pulls or landmarks. The keyboard alone is enough to use it: the table
/// of commands lists its keys under Scope::List.
class ListTree : public QTreeView
{
  Q_OBJECT

public:
  /// The number of rows that are seen at once, and the text of an empty list.
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
