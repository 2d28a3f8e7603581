// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The dock "Case": what is known of a patient, by roles, and the steps from there to a report. It
/// opens where ParaView starts with this computer's user for the first time, and by its key.
#ifndef BrainShift_CaseDock_h
#define BrainShift_CaseDock_h

#include <QDockWidget>
#include <QMap>
#include <QStringList>

class QComboBox;
class QJsonObject;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace brainshift
{
class CaseOrders;
class CaseSettings;
class MillimetreField;
class RoleBox;
class StepRows;

class CaseDock : public QDockWidget
{
  Q_OBJECT

public:
  explicit CaseDock(QWidget* parent);

  /// Shows the dock at the front, or hides it if it is there.
  void toggle();
  /// Gives the dock the keyboard, at the front, or hides it if it has the keyboard.
  void toggleByKey();
  /// Proposes roles for files, or those of one folder, and takes them over if the user agrees.
  void propose(const QStringList& paths);

protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void changeEvent(QEvent* event) override;

private:
  void addCases(QVBoxLayout* layout);
  void addRoles(QVBoxLayout* layout);
  void addSphere();
  void addSteps(QVBoxLayout* layout);
  void addSettings(QVBoxLayout* layout);
  void openFolder();
  /// Tabs the dock with the panel Properties, and shows it where nobody has used it yet.
  void settle();
  void comeToFront();
  void remember(); ///< Keeps for the next start whether it is shown.
  void run(const QString& step);
  void runByHand();
  void runRefine();
  void writeTo(const QString& step);
  bool isInFront() const;
  void showInFront(bool on);
  void paint(); ///< Gives texts the colours of the palette.
  void showNothingYet();
  void showState();
  void showRefine();
  void choose(const QString& role, const QJsonObject& what);

  CaseOrders* Orders;
  QComboBox* Cases = nullptr;
  QPushButton* NewMoment = nullptr;
  QMap<QString, RoleBox*> Boxes; ///< by role
  QWidget* Sphere = nullptr;
  QList<MillimetreField*> SphereFields; ///< centre and radius, mm
  CaseSettings* Settings = nullptr;
  StepRows* Steps = nullptr;
  QLabel* Problem = nullptr;
  QLabel* Note = nullptr;
  bool IsRoomy = false; ///< whether it has got more of the window's height
};
}

#endif
