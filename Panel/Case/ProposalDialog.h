// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What each file of a folder may be in a case, with the reason. The user corrects it before
/// anything is opened.
#ifndef BrainShift_ProposalDialog_h
#define BrainShift_ProposalDialog_h

#include <QDialog>
#include <QJsonObject>

class QDialogButtonBox;
class QJsonArray;
class QLabel;
class QTableWidget;

namespace brainshift
{
class ProposalDialog : public QDialog
{
  Q_OBJECT

public:
  /// - `proposal`: lists of role (empty: none), path and reason
  /// - `roles`: as `_told_roles` of dock.py tells them
  ProposalDialog(QWidget* parent, const QJsonArray& proposal, const QJsonArray& roles);

  /// The paths of the files by the roles that the user left or gave them.
  QJsonObject accepted() const;

private:
  /// Accepts only if no role was given twice, and says so.
  void judge();

  QTableWidget* Table = nullptr;
  QLabel* Problem = nullptr;
  QDialogButtonBox* Buttons = nullptr;
};
}

#endif
