// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A view that undo or redo brings back looks as it looked when it went. ParaView gives it the
/// camera, mouse and background of a new view.
#ifndef BrainShift_RevivedViews_h
#define BrainShift_RevivedViews_h

#include <QObject>

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <map>
#include <string>

class pqView;
class vtkSMProperty;

namespace brainshift
{
class RevivedViews : public QObject
{
public:
  /// Watches the views that go and come.
  explicit RevivedViews(QObject* parent);
  ~RevivedViews() override;

private:
  using Properties = std::map<std::string, vtkSmartPointer<vtkSMProperty>>;

  void keep(pqView* going);
  void restore(pqView* back);

  std::map<vtkTypeUInt32, Properties> Kept; ///< by the view's global number, which comes back
};
}

#endif
