// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps a filter selected while its inputs change. ParaView's pipeline browser moves a filter that
/// gets a second input to another place, or back, and loses it from the selection on the way. Then
/// all filters in menus and toolbars are greyed out.
#ifndef BrainShift_KeptSelection_h
#define BrainShift_KeptSelection_h

#include <QObject>

class pqPipelineSource;

namespace brainshift
{
class KeptSelection : public QObject
{
  Q_OBJECT

public:
  /// Watches the pipeline from now on.
  explicit KeptSelection(QObject* parent);

private:
  void keep(pqPipelineSource* consumer);
};
}

#endif
