// SPDX-License-Identifier: BSD-3-Clause
// The strokes of a Free-Form Deformation as rows of a table, in the order they are replayed. Each
// cell is read from the property when it is asked for: the model holds no stroke.
#ifndef BrainShift_StrokeModel_h
#define BrainShift_StrokeModel_h

#include "Filters/Deformation/Stroke.h"

#include <QAbstractTableModel>
#include <QList>

#include <functional>
#include <string>
#include <vector>

class vtkSMDoubleVectorProperty;

// How far full weight moves, mm. Stamp: pull (away from the point of interest) is above 0.
double amountOf(const brainshift::Stroke& stroke);

// The stroke moving that far in the same direction. Without a direction it stays as it is.
brainshift::Stroke withAmount(brainshift::Stroke stroke, double amount);

class StrokeModel : public QAbstractTableModel
{
  Q_OBJECT

public:
  enum Column
  {
    ToolColumn, // with the check box: enabled
    WhereColumn,
    AmountColumn, // mm, editable
    MajorColumn,  // mm, editable: radius of Soft, half the long axis of Stamp
    MinorColumn,  // mm, editable: radius across the long axis of Stamp
    ColumnCount,
  };
  enum Role // limits of an editable number, mm
  {
    LeastRole = Qt::UserRole,
    MostRole,
  };

  // Replaces all strokes; the text names the edit on the undo stack.
  using Write = std::function<void(const std::vector<brainshift::Stroke>&, const QString&)>;

  StrokeModel(vtkSMDoubleVectorProperty* strokes, Write write, QObject* parent = nullptr);

  // To call when the property has changed, whoever changed it.
  void update();

  // What keeps the numbers from being strokes; empty if nothing does. Nothing can be edited then,
  // for that would lose them.
  const QString& problem() const { return this->Problem; }

  // Largest distance between neighbouring control points, mm: smaller radii are marked.
  void setLatticeSpacing(double spacing);

  // How much of each stroke the guard against folding applies, 0 to 1; all of it where none is
  // told.
  void setAppliedShares(const std::vector<double>& shares);

  void setEnabled(const QList<int>& rows, bool enabled);
  void removeRowsOf(const QList<int>& rows);
  void removeAll();

  brainshift::Stroke stroke(int row) const;

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

Q_SIGNALS:
  void updated(); // after rows and cells have followed the property

private:
  std::vector<brainshift::Stroke> strokes(std::string& problem) const;
  void write(
    const std::function<void(std::vector<brainshift::Stroke>&)>& edit, const QString& label);
  QString text(const brainshift::Stroke& stroke, int column) const;
  QString advice(int row, int column) const;
  QString toolTip(int row, int column) const;

  vtkSMDoubleVectorProperty* const Property; // outlives the model
  const Write WriteStrokes;
  QString Problem;
  int Rows = 0; // what the view was told
  double LatticeSpacing = 0.0;
  std::vector<double> AppliedShares;
};

#endif
