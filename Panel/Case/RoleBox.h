// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The list of a role in the dock Case: the sources that may have it, and a file to open. A file
/// that is dropped on it is opened for the role.
#ifndef BrainShift_RoleBox_h
#define BrainShift_RoleBox_h

#include <QComboBox>
#include <QStringList>

class QJsonObject;
class QMimeData;

namespace brainshift
{
/// The paths of the files and folders that are dragged; only those of this computer.
QStringList pathsOf(const QMimeData* dragged);

class RoleBox : public QComboBox
{
  Q_OBJECT

public:
  /// `role`: as dock.py tells it.
  explicit RoleBox(const QString& role);

  /// Shows a role as `_told_roles` of dock.py tells it. `sphere`: for the opening, whether it is a
  /// sphere.
  void show(const QJsonObject& told, bool sphere);

Q_SIGNALS:
  /// The user chose a source by the number of its proxy; 0: none.
  void sourceChosen(int number);
  /// The user chose or dropped a file of this path.
  void fileChosen(const QString& path);
  void sphereChosen();

protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  /// The keys that would choose unseen open the list.
  void keyPressEvent(QKeyEvent* event) override;

private:
  void choose(int index);
  void openFile();

  const QString Role;
  int Shown = 0; ///< The entry that the case has.
};
}

#endif
