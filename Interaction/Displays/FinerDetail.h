// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Draws views again while finer voxels of their volumes arrive, and shows in the status bar which
/// level is drawn and what is still to come.
#ifndef BrainShift_FinerDetail_h
#define BrainShift_FinerDetail_h

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <map>

class pqView;

namespace brainshift
{
class FinerDetail : public QObject
{
  Q_OBJECT

public:
  explicit FinerDetail(QObject* parent);

private:
  void watch();
  void drawOn();

  QTimer Next;
  std::map<pqView*, QElapsedTimer> SinceDrawn; // views for which bricks come, or since they began
};
}

#endif
