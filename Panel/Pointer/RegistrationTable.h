// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The paired points that register the tracker to the image, with their registration errors.
#ifndef BrainShift_RegistrationTable_h
#define BrainShift_RegistrationTable_h

#include <QString>
#include <QWidget>

class QLabel;
class QPushButton;
class QTableWidget;
class QTableWidgetItem;

namespace brainshift
{
class RegistrationTable : public QWidget
{
  Q_OBJECT

public:
  explicit RegistrationTable(QWidget* parent = nullptr);
  ~RegistrationTable() override;

  void showState();

  /// While Mark in View is pressed, takes the click on the landmark.
  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  void problem(const QString& sentence); ///< Empty: there is none any more.

private:
  void touch();
  void wait(bool on); ///< For a click in a view.
  void takeTyped(QTableWidgetItem* item);
  void fill();
  int row() const; ///< The one to mark: selected, else the first without an image point. -1: none.

  QLabel* State = nullptr;
  QTableWidget* Table = nullptr;
  QPushButton* Touch = nullptr;
  QPushButton* Mark = nullptr;
  QPushButton* Remove = nullptr;
  QString Shown; ///< What the table was filled with.
};
}

#endif
