// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The landmarks of a Free-Form Deformation as rows of a table. The check mark lets a pair count.
/// The pair that fits worst is bold and has a warning sign.
#ifndef BrainShift_LandmarkModel_h
#define BrainShift_LandmarkModel_h

#include <QAbstractTableModel>
#include <QPointer>

namespace brainshift
{
class LandmarkList;
struct LandmarkRow;

class LandmarkModel : public QAbstractTableModel
{
  Q_OBJECT

public:
  enum Column
  {
    NameColumn,     ///< Number and name, with the check box.
    ResidualColumn, ///< mm
    LeftOutColumn,  ///< mm
    ColumnCount,
  };

  LandmarkModel(LandmarkList* list, QObject* parent);

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

private:
  void update();
  bool isWorst(int row) const;
  QString text(int row, int column) const;
  QString toolTip(int row, int column) const;

  const QPointer<LandmarkList> List; ///< Its source may go before the panel does.
  int Rows = 0;                      ///< As announced to views.
};
}

#endif
