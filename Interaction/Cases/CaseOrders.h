// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The case in hand, a `brainshift.Case` of the window's Python: what it is now, and orders to it.
#ifndef BrainShift_CaseOrders_h
#define BrainShift_CaseOrders_h

#include <QJsonArray>
#include <QJsonObject>
#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>

class pqPipelineSource;

namespace brainshift
{
class CaseOrders : public QObject
{
  Q_OBJECT

public:
  /// Lives as long as `parent`.
  explicit CaseOrders(QObject* parent);

  /// What `_told` of Python/brainshift/dock.py says of the case, by its keys. Empty at first.
  const QJsonObject& told() const { return this->Told; }
  /// Why the last order failed, or why the case is not known now: a sentence, or empty.
  const QString& problem() const { return this->Problem.isEmpty() ? this->Trouble : this->Problem; }
  /// Shows a reason of the window's own as that of the last order.
  void report(const QString& problem);

  /// Does an order of dock.py, as one step to undo with that label; without a label it is none.
  void give(const QString& order, const QJsonObject& arguments, const QString& label);
  /// What files may be, or those in one folder: lists of role (empty: none), path and reason.
  QJsonArray sorted(const QStringList& paths);

  /// The Free-Form Deformation of the case, and its Compare Volumes; null while there is none.
  pqPipelineSource* bent() const;
  pqPipelineSource* comparison() const { return this->source("comparison"); }

  /// Whether anyone looks: only then the case is asked again when the pipeline changes.
  void setWatched(bool on);

Q_SIGNALS:
  /// The case or the problem is another.
  void changed();

private:
  pqPipelineSource* source(const char* key) const;
  QJsonValue ask(const QString& order, const QJsonObject& arguments);
  void endEdits();
  void refreshSoon();
  void refresh();
  /// Whether an edit or a registration is under way, a state is loaded, or there is no session.
  bool isBusy() const;

  QJsonObject Told;
  QString Problem; ///< Of the last order.
  QString Trouble; ///< Of the last look at the case.
  QTimer Soon;
  bool Watched = false;
  bool Asking = false;
};
}

#endif
