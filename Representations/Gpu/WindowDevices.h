// SPDX-License-Identifier: BSD-3-Clause
// What a mapper keeps for each window that draws it: textures and programs belong to a context.
#ifndef BrainShift_WindowDevices_h
#define BrainShift_WindowDevices_h

#include "vtkOpenGLRenderWindow.h"
#include "vtkWeakPointer.h"

#include <map>

namespace brainshift
{
// `Device` is made on first use and has Release(vtkWindow*), called when the window lets go.
template <typename Device>
class WindowDevices
{
public:
  Device& of(vtkOpenGLRenderWindow* window)
  {
    Entry& entry = this->Entries[window];
    entry.window = window;
    return entry.device;
  }

  // Null if the window has drawn nothing.
  Device* find(vtkWindow* window)
  {
    const auto found = this->Entries.find(window);
    return found == this->Entries.end() ? nullptr : &found->second.device;
  }

  void release(vtkWindow* window)
  {
    Device* device = this->find(window);
    if (!device)
    {
      return;
    }
    // Closing a view, ParaView leaves another window's context current, where our buffers' numbers
    // may mean something else.
    auto context = vtkOpenGLRenderWindow::SafeDownCast(window);
    context->PushContext();
    device->Release(window);
    context->PopContext();
    this->Entries.erase(window);
  }

  // Calls visit(device) with each window's context current.
  template <typename Visit>
  void visit(const Visit& visit)
  {
    for (auto& [key, entry] : this->Entries)
    {
      if (entry.window)
      {
        entry.window->MakeCurrent();
        visit(entry.device);
      }
    }
  }

private:
  struct Entry
  {
    Device device;
    vtkWeakPointer<vtkOpenGLRenderWindow> window;
  };
  std::map<vtkWindow*, Entry> Entries;
};
}

#endif
