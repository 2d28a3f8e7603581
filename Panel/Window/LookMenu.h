// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Menu of the toolbar with the looks of the volume that the active view shows. It reads the volume
/// when it opens.
#ifndef BrainShift_LookMenu_h
#define BrainShift_LookMenu_h

#include <QMenu>

namespace brainshift
{
class LookMenu : public QMenu
{
  Q_OBJECT

public:
  LookMenu(QWidget* parent = nullptr);

private:
  void offer();
};
}

#endif
