// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The settings of a case that matter with its present roles.
#ifndef BrainShift_CaseSettings_h
#define BrainShift_CaseSettings_h

#include <QJsonValue>
#include <QMap>
#include <QWidget>

class QFormLayout;
class QJsonObject;

namespace brainshift
{
class CaseSettings : public QWidget
{
  Q_OBJECT

public:
  CaseSettings();

  /// Shows settings as `_told_settings` of dock.py tells them.
  void show(const QJsonObject& told);

Q_SIGNALS:
  /// The user gave a setting another value. `label`: what the user calls it.
  void edited(const QString& name, const QJsonValue& value, const QString& label);
  /// What the user typed is no value: a sentence.
  void refused(const QString& problem);

private:
  void addCheck(const QString& name, const QString& label, const QString& tip);
  void addLabels(const QString& name, const QString& label, const QString& tip);
  void addName();
  void addMinutes();
  void addTraceTimes();
  void addLevel();
  void addGrowth();
  void addField(const QString& name, const QString& label, const QString& tip, QWidget* field);

  QFormLayout* Form;
  QMap<QString, QWidget*> Fields; ///< by the name of the setting
};
}

#endif
