// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a mapper keeps for each window that draws it: textures and programs belong to a window.
#ifndef BrainShift_WindowDevices_h
#define BrainShift_WindowDevices_h

#include "vtkOpenGLRenderWindow.h"
#include "vtkWeakPointer.h"

#include <map>

namespace brainshift
{
/// One `Device` for each window, made on first use. The type has a function Release(vtkWindow*),
/// which is called when the window lets go.
template <typename Device>
class WindowDevices
{
public:
  /// The device of a window.
  Device& of(vtkOpenGLRenderWindow* window)
  {
    Entry& entry = this->Entries[window];
    entry.window = window;
    return entry.device;
  }

  /// The device of a window. Null if the window has drawn nothing.
  Device* find(vtkWindow* window)
  {
    const auto found = this->Entries.find(window);
    return found == this->Entries.end() ? nullptr : &found->second.device;
  }

  /// Releases the device of a window and forgets it.
  void release(vtkWindow* window)
  {
    Device* device = this->find(window);
    if (!device)
    {
      return;
    }
    // When ParaView closes a view, the context of another window is current. There the numbers of
    // our buffers may mean something else.
    auto context = vtkOpenGLRenderWindow::SafeDownCast(window);
    context->PushContext();
    device->Release(window);
    context->PopContext();
    this->Entries.erase(window);
  }

  /// Calls visit(device) for each window, with its OpenGL context current.
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

  /// Calls visit(device) for each window. No OpenGL context is current.
  template <typename Visit>
  void visitAnyhow(const Visit& visit)
  {
    for (auto& [key, entry] : this->Entries)
    {
      visit(entry.device);
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
