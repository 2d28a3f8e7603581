// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The table of landmarks of a Free-Form Deformation, with buttons to pick, find and delete pairs,
/// and the figures of the fit. It acts at once, without Apply.
#ifndef BrainShift_LandmarkTable_h
#define BrainShift_LandmarkTable_h

#include "Panel/Parts/List.h"

#include <QPointer>
#include <QWidget>

class QCheckBox;
class QLabel;
class QToolButton;

namespace brainshift
{
// The landmarks of a Free-Form Deformation as rows of a table. The check mark lets a pair count.
// The pair that fits worst is bold and has a warning sign.

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

class LandmarkList;
class LandmarkModel;
class ListTree;

class LandmarkTable : public QWidget
{
  Q_OBJECT

public:
  LandmarkTable(LandmarkList* list, QWidget* parent = nullptr);

private:
  void layOut();
  void pick(bool on);
  void goTo();
  void refresh();
  QString figuresText() const;

  const QPointer<LandmarkList> Landmarks; ///< Its source may go before the panel does.
  LandmarkModel* const Model;
  ListTree* const Tree;
  QLabel* const Problem;
  QLabel* const Request;
  QLabel* const Figures;
  QToolButton* const Pick;
  QToolButton* const GoTo;
  QToolButton* const Delete;
  QCheckBox* const Marks;
};
}

#endif
