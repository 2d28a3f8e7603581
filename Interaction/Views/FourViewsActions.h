// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The toolbar button that lays out four views of the active volume. It calls
/// brainshift.four_views.
#ifndef BrainShift_FourViewsActions_h
#define BrainShift_FourViewsActions_h

#include <QActionGroup>

namespace brainshift
{
class FourViewsActions : public QActionGroup
{
  Q_OBJECT

public:
  explicit FourViewsActions(QObject* parent);

private:
  void layOut();
};
}

#endif
