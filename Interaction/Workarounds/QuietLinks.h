// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps the links between our views away from ParaView's link manager. That one empties the undo
/// stack when a link goes. An undo step that takes views or displays back takes their links back
/// too, and ParaView then crashes in the step that it is just undoing.
///
/// A link of ParaView also follows a view or display that is gone, and crashes. So our links leave
/// out what goes, and take it in again when undo or redo brings it back. ParaView does
/// not know them, for undo would drop them and redo make others; only states have them.
#ifndef BrainShift_QuietLinks_h
#define BrainShift_QuietLinks_h

#include <QObject>

#include <vtkSmartPointer.h>
#include <vtkType.h>
#include <vtkWeakPointer.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

class pqServer;
class vtkObject;
class vtkSMPropertyLink;
class vtkSMProxy;
class vtkSMSessionProxyManager;

namespace brainshift
{
using ManagerObservers =
  std::vector<std::pair<vtkWeakPointer<vtkSMSessionProxyManager>, unsigned long>>;

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
  /// Observer of what is no longer registered.
  bool onUnRegister(vtkObject* manager, unsigned long event, void* information);
  /// Writes the links into a state.
  void onSaveState(vtkObject* manager, unsigned long event, void* information);
  void takeOver(vtkSMSessionProxyManager* manager);
  void leaveOut(vtkSMProxy* gone);
  void takeIn(vtkSMSessionProxyManager* manager);

  /// One property of a view or display that is gone, and the link that it belongs to.
  struct LeftOut
  {
    vtkSmartPointer<vtkSMPropertyLink> link;
    vtkTypeUInt32 proxy; ///< global number: undo brings the proxy back under it
    std::string property;
  };

  std::set<std::pair<std::string, vtkSmartPointer<vtkSMPropertyLink>>> Links; ///< with names
  std::vector<LeftOut> Gone;
  ManagerObservers Observers;
};

/// Keeps each table of colours until its server goes. ParaView's editor of colours links a display
/// to each table that the display has shown, and never removes the link. The next change of the
/// display follows it to a table that undo or a separate colour map has dropped: a crash.
class KeptColors : public QObject
{
public:
  /// Watches the servers that there are and that come.
  explicit KeptColors(QObject* parent);
  ~KeptColors() override;

private:
  void watch(pqServer* server);
  void forget(pqServer* server);
  /// Observer of what is registered.
  void onRegister(vtkObject* manager, unsigned long event, void* information);

  std::set<vtkSmartPointer<vtkSMProxy>> Tables;
  ManagerObservers Observers;
};
}

#endif
