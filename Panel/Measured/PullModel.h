// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The pulls and then the pins of a Fit Deformation as rows of a table. They are solved together,
/// so their order means nothing.
#ifndef BrainShift_PullModel_h
#define BrainShift_PullModel_h

#include "Interaction/Edits/PullList.h"

#include <QAbstractTableModel>
#include <QList>

#include <functional>
#include <vector>

namespace brainshift
{
/// What hands asked of a fit.
struct Pulled
{
  std::vector<Pull> pulls;
  std::vector<Pin> pins;
};

class PullModel : public QAbstractTableModel
{
  Q_OBJECT

public:
  enum Column
  {
    KindColumn,   ///< Number and kind, with the check box that switches it on.
    AskedColumn,  ///< mm, editable: how far a pull should take its tissue.
    MissedColumn, ///< mm: how far from there the fit leaves it.
    WeightColumn, ///< Editable: how far a pull is trusted.
    WhereColumn,  ///< mm: the tissue at rest.
    ColumnCount,
  };

  /// Replaces all of it. The text names the edit on the undo stack.
  using Write = std::function<void(const Pulled&, const QString&)>;

  explicit PullModel(Write write, QObject* parent = nullptr);

  /// Shows what the fit has now.
  void show(const Pulled& pulled);
  /// Where the fit takes the tissue of each row (mm); empty: not known. `held`: where each pin
  /// should hold its tissue (mm); empty: where it was at rest.
  void setPlaces(const std::vector<glm::dvec3>& places, const std::vector<glm::dvec3>& held = {});

  const Pulled& pulled() const { return this->Now; }
  bool isOn(int row) const;

  /// Switches rows on or off: one edit. A pull that is switched on again has the weight 1.
  void setOn(const QList<int>& rows, bool on);
  /// Deletes rows: one edit.
  void removeRowsOf(const QList<int>& rows);
  /// Deletes all rows: one edit.
  void removeAll();

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

private:
  bool isPull(int row) const { return row < static_cast<int>(this->Now.pulls.size()); }
  const Pull& pull(int row) const { return this->Now.pulls[static_cast<std::size_t>(row)]; }
  const Pin& pin(int row) const;
  glm::dvec3 target(int row) const;
  QString text(int row, int column) const;
  QString toolTip(int row) const;

  const Write WritePulled;
  Pulled Now;
  std::vector<glm::dvec3> Places;
  std::vector<glm::dvec3> Held; // of the pins
};
}

#endif
