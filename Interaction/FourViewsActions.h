// SPDX-License-Identifier: BSD-3-Clause
// The toolbar button that lays out the four views of the active volume: brainshift.four_views.
#ifndef BrainShift_FourViewsActions_h
#define BrainShift_FourViewsActions_h

#include <QActionGroup>

class FourViewsActions : public QActionGroup
{
  Q_OBJECT

public:
  explicit FourViewsActions(QObject* parent);

private:
  void layOut();
};

#endif
