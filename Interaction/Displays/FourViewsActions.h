// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The toolbar button that lays out four views of the active volume. It calls
/// brainshift.four_views. A Compare Volumes that is shown for the first time takes over the preset
/// of its volume, in all four views where they are laid out: brainshift.show_comparison.
#ifndef BrainShift_FourViewsActions_h
#define BrainShift_FourViewsActions_h

#include <QActionGroup>

class pqPipelineSource;

namespace brainshift
{
class FourViewsActions : public QActionGroup
{
  Q_OBJECT

public:
  explicit FourViewsActions(QObject* parent);

private:
  void layOut();
  void watchComparison(pqPipelineSource* source);
};
}

#endif
