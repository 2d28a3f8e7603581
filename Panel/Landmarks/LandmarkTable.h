// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The table of landmarks of a Free-Form Deformation, with buttons to pick, find and delete pairs,
/// and what the fit says of all of them. It acts at once, without Apply.
#ifndef BrainShift_LandmarkTable_h
#define BrainShift_LandmarkTable_h

#include <QList>
#include <QPointer>
#include <QWidget>

class QCheckBox;
class QLabel;
class QToolButton;

namespace brainshift
{
class LandmarkList;
class LandmarkModel;
class ListTree;

class LandmarkTable : public QWidget
{
  Q_OBJECT

public:
  LandmarkTable(LandmarkList* list, QWidget* parent = nullptr);

private:
  QToolButton* addButton(const char* name, const QString& text, const QString& tip);
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
