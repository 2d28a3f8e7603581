// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps a filter selected while its inputs change. ParaView's pipeline browser moves a filter that
/// gets a second input to another place, or back, and loses it from the selection on the way. Then
/// all filters are greyed out, and the panel is empty.
#ifndef BrainShift_KeptSelection_h
#define BrainShift_KeptSelection_h

#include <QObject>
#include <QPointer>

class pqPipelineSource;

namespace brainshift
{
class KeptSelection : public QObject
{
  Q_OBJECT

public:
  /// Watches the pipeline from now on. The pipeline browser must be there already.
  explicit KeptSelection(QObject* parent);

private:
  void remember(pqPipelineSource* consumer);
  void restore(pqPipelineSource* consumer);

  QPointer<pqPipelineSource> Active; ///< The filter whose input changes, if it alone is selected.
};
}

#endif
