// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The dock "Live Pointer": connects the pointer, shows the tip and its distance to the cortex,
/// records traces, registers the tracker, saves and replays sessions. It is closed until the View
/// menu or the toolbar opens it.
#ifndef BrainShift_PointerDock_h
#define BrainShift_PointerDock_h

#include <QDockWidget>
#include <QTimer>

class QCheckBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

namespace brainshift
{
class RegistrationTable;

class PointerDock : public QDockWidget
{
  Q_OBJECT

public:
  explicit PointerDock(QWidget* parent);

private:
  void addConnection(QVBoxLayout* layout);
  void addTip(QVBoxLayout* layout);
  void addSession(QVBoxLayout* layout);
  void addLine(QFormLayout* form, const QString& name, QWidget* field, const QString& tip);
  void toggleConnection(); ///< Connects or disconnects.
  void save();
  void replay();
  bool mayDrop();
  void report(const QString& problem); ///< Shown until the next step.
  void showState();
  void showConnection();
  void showTip();

  QWidget* Server = nullptr; ///< The fields of the connection.
  QLineEdit* Host = nullptr;
  QSpinBox* Port = nullptr;
  QLineEdit* Device = nullptr;
  QCheckBox* Reconnect = nullptr;
  QPushButton* Connect = nullptr;
  QLabel* Status = nullptr;
  QLabel* Position = nullptr;
  QLabel* Distance = nullptr;
  QLabel* ThresholdName = nullptr;
  QDoubleSpinBox* Threshold = nullptr;
  QPushButton* Record = nullptr;
  QLabel* Recorded = nullptr;
  RegistrationTable* Registration = nullptr;
  QPushButton* Save = nullptr;
  QPushButton* Play = nullptr;
  QLabel* Problem = nullptr;
  QTimer Soon; ///< Words need not change with each picture.
};
}

#endif
