// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Workarounds for ParaView's selections; see README.md.
#ifndef BrainShift_Selections_h
#define BrainShift_Selections_h

#include <vtkSMProxy.h>
#include <vtkWeakPointer.h>

#include <QObject>

#include <vector>

class pqPipelineSource;

namespace brainshift
{
/// Keeps a filter selected while its inputs change. ParaView's pipeline browser moves a filter that
/// gets a second input to another branch, or back, and drops it from the selection. Then
/// all filters in menus and toolbars are greyed out.
///
/// And selects nothing while a session is removed: ParaView's lists select an output of a source at
/// each removal of another, and its action Delete then crashes where the source itself is gone.
class KeptSelection : public QObject
{
  Q_OBJECT

public:
  /// Watches the pipeline from now on.
  explicit KeptSelection(QObject* parent);

private:
  void keep(pqPipelineSource* consumer);

  QMetaObject::Connection Dropping; ///< While a session is removed.
};

/// Switches off the display of a selection while nothing is selected. ParaView updates that display
/// with each change of the data. During a drag it takes a tenth of the main thread's time.
class EmptySelections
{
public:
  EmptySelections() = default;
  ~EmptySelections() { this->putBack(); }
  EmptySelections(const EmptySelections&) = delete;
  EmptySelections& operator=(const EmptySelections&) = delete;

  /// Switches the display off in every view that shows the source.
  void leaveOut(pqPipelineSource* source);
  /// Switches the display on again.
  void putBack();

private:
  std::vector<vtkWeakPointer<vtkSMProxy>> Representations; ///< Those whose selection is off.
};
}

#endif
