// SPDX-License-Identifier: BSD-3-Clause
// Shows a volume and its reference in turn, so that what differs flickers: Show of Compare Volumes,
// of those that the active view shows, or else of all. It is no edit: nothing of it is undone, and
// in the end Show is what it was.
#ifndef BrainShift_Flicker_h
#define BrainShift_Flicker_h

#include <QList>
#include <QObject>
#include <QPointer>
#include <QTimer>

class pqPipelineSource;
class pqServerManagerModelItem;

class Flicker : public QObject
{
  Q_OBJECT

public:
  explicit Flicker(QObject* parent);

  // Whether there is a Compare Volumes that was applied.
  static bool isPossible();

public Q_SLOTS:
  // The reference comes first. Edits of the filter in the panel, a state file to be written, and
  // the end of the last filter turn it off.
  void turn(bool on);

Q_SIGNALS:
  void turned(bool on);

private Q_SLOTS:
  void showTheOther();
  void noticeEdit(pqServerManagerModelItem* filter);
  void noticeRemoval(pqPipelineSource* filter);

private:
  struct Flickering
  {
    QPointer<pqPipelineSource> filter;
    int before = 0; // its Show
  };

  QList<Flickering> Filters; // none: off
  int Shown = 0;             // what they were told last
  QTimer Next;
};

#endif
