// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps the links between our views away from ParaView's link manager. That one empties the undo
/// stack when a link goes. An undo step that takes views or displays back takes their links back
/// too, and ParaView then crashes in the step that it is just undoing.
#ifndef BrainShift_QuietLinks_h
#define BrainShift_QuietLinks_h

#include <QObject>

#include <vtkWeakPointer.h>

#include <utility>
#include <vector>

class pqServer;
class vtkObject;
class vtkSMSessionProxyManager;

namespace brainshift
{
class QuietLinks : public QObject
{
public:
  /// Watches the servers that there are and that come.
  explicit QuietLinks(QObject* parent);
  ~QuietLinks() override;

private:
  void watch(pqServer* server);
  /// Observer of what is registered. True: no other observer gets it.
  bool onRegister(vtkObject* manager, unsigned long event, void* information);

  std::vector<std::pair<vtkWeakPointer<vtkSMSessionProxyManager>, unsigned long>> Observers;
};
}

#endif
