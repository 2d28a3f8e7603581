// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Alternates the deformed volume and the reference of Compare Volumes, so that differences
/// flicker. It switches the property Show of the filters that the active view shows, or else of
/// all. The undo stack sees nothing, and Show is restored in the end.
#ifndef BrainShift_Flicker_h
#define BrainShift_Flicker_h

#include <QList>
#include <QObject>
#include <QPointer>
#include <QTimer>

class pqPipelineSource;
class pqServerManagerModelItem;

namespace brainshift
{
class Flicker : public QObject
{
  Q_OBJECT

public:
  explicit Flicker(QObject* parent);

  /// Whether there is a Compare Volumes filter that was applied.
  static bool isPossible();

  /// Ends the flicker that is on, if there is one. Called before an edit that is not the panel's:
  /// undo and redo of the edit would bring back what the flicker showed for a moment.
  static void stop();

public Q_SLOTS:
  /// Starts with the reference. An edit of the filter in the panel, the writing of a state file and
  /// the removal of the last filter switch the flicker off.
  void setOn(bool on);

Q_SIGNALS:
  void switched(bool on);

private Q_SLOTS:
  void showTheOther();
  void noticeEdit(pqServerManagerModelItem* filter);
  void noticeRemoval(pqPipelineSource* filter);

private:
  struct Flickering
  {
    QPointer<pqPipelineSource> filter;
    int before = 0; ///< Its Show before the flicker.
  };

  QList<Flickering> Filters; ///< Empty while the flicker is off.
  int ShowNow = 0;           ///< The value of Show that they got last.
  QTimer Next;
};
}

#endif
