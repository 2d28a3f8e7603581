// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The list of strokes with its buttons. The user disables, changes and deletes strokes in it.
#ifndef BrainShift_StrokeList_h
#define BrainShift_StrokeList_h

#include "Filters/Deformation/Stroke.h"
#include "Panel/Parts/List.h"

#include <QPointer>
#include <QWidget>

#include <functional>
#include <string>

class QLabel;
class QToolButton;
class vtkSMDoubleVectorProperty;

namespace brainshift
{
// The strokes of a Free-Form Deformation as rows of a table, in the order of replay. The model
// holds no stroke: it reads a cell from the property when a view asks for the cell.

/// Displacement at the centre of a stroke, mm. Stamp: pull (away from the point of interest) is
/// above 0.
double amountOf(const Stroke& stroke);

/// The stroke with another amount in its own direction. A stroke without direction stays unchanged.
Stroke withAmount(Stroke stroke, double amount);

class StrokeModel : public ListModel
{
  Q_OBJECT

public:
  enum Column
  {
    ToolColumn,   ///< Number and tool, with the check box that enables the stroke.
    AmountColumn, ///< mm, editable: what was asked for.
    ReachColumn,  ///< mm: how far the tissue at the anchor went.
    MajorColumn,  ///< mm, editable: radius of Soft, half the long axis of Stamp.
    MinorColumn,  ///< mm, editable: radius of Stamp across its long axis.
    WhereColumn,  ///< mm: the anchor.
    ColumnCount,
  };
  /// Replaces all strokes. The text names the edit on the undo stack.
  using Write = std::function<void(const std::vector<Stroke>&, const QString&)>;

  StrokeModel(vtkSMDoubleVectorProperty* strokes, Write write, QObject* parent = nullptr);

  /// Must be called after each change of the property.
  void update();

  /// Why the numbers of the property are not valid strokes. Empty if they are. While they are not,
  /// nothing can be edited, because an edit would lose them.
  const QString& problem() const { return this->Problem; }

  /// Largest spacing of control points, mm. Smaller radii get a warning.
  void setLatticeSpacing(double spacing);

  /// The fraction of each stroke (0 to 1) that the guard against folding applies. Strokes without a
  /// fraction are applied whole.
  void setAppliedShares(const std::vector<double>& shares);

  /// How far (mm) each stroke took the tissue at its anchor along its vector. Strokes without a
  /// reach show none.
  void setReaches(const std::vector<double>& reaches);

  bool isOn(int row) const override { return this->stroke(row).enabled; }
  void setOn(const QList<int>& rows, bool on) override;
  void removeRowsOf(const QList<int>& rows) override;
  /// Deletes all strokes: one edit.
  void removeAll();

  /// The stroke of a row, read from the property.
  Stroke stroke(int row) const;

Q_SIGNALS:
  void updated(); ///< Rows and cells have followed the property.

protected:
  int count() const override { return this->Strokes; }
  QString text(int row, int column) const override;
  QString toolTip(int row, int column) const override;
  QString warning(int row, int column) const override;
  std::optional<Number> number(int row, int column) const override;
  void change(int row, int column, double number) override;

private:
  std::vector<Stroke> strokes(std::string& problem) const;
  void write(const std::function<void(std::vector<Stroke>&)>& edit, const QString& label);
  std::optional<double> reach(int row, const Stroke& stroke) const;

  vtkSMDoubleVectorProperty* const Property; ///< Outlives the model.
  const Write WriteStrokes;
  QString Problem;
  int Strokes = 0; ///< Of the property, when it was last read.
  double LatticeSpacing = 0.0;
  std::vector<double> AppliedShares;
  std::vector<double> Reaches;
};

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
