// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The landmarks of a Free-Form Deformation as rows of a table. The check mark lets a pair count.
/// The pair that fits worst is bold and has a warning sign.
#ifndef BrainShift_LandmarkModel_h
#define BrainShift_LandmarkModel_h

#include "Panel/Parts/ListModel.h"

#include <QPointer>

namespace brainshift
{
class LandmarkList;

class LandmarkModel : public ListModel
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

  bool isOn(int row) const override;
  void setOn(const QList<int>& rows, bool on) override;
  /// Pairs of files stay.
  void removeRowsOf(const QList<int>& rows) override;

protected:
  int count() const override;
  QString text(int row, int column) const override;
  QString toolTip(int row, int column) const override;
  QString warning(int row, int column) const override;
  bool isBold(int row) const override;

private:
  const QPointer<LandmarkList> List; ///< Its source may go before the panel does.
};
}

#endif
