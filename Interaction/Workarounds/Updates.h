// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Workarounds for what ParaView does after each change; see README.md.
#ifndef BrainShift_Updates_h
#define BrainShift_Updates_h

#include <pqDataRepresentation.h>

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkSMProxy.h>
#include <vtkWeakPointer.h>

#include <QList>
#include <QPointer>

#include <vector>

namespace brainshift
{
/// While such an object lives, the proxies added to it do not announce updates of their data.
/// ParaView answers an update with ranges of all arrays, a new menu of filters and a new layout of
/// its panels. That takes a third of the main thread's time for one picture of a drag.
class QuietUpdates
{
public:
  QuietUpdates()
  {
    this->First->SetAbortFlagOnExecute(1);
    this->First->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  }
  ~QuietUpdates()
  {
    for (const vtkWeakPointer<vtkSMProxy>& proxy : this->Proxies)
    {
      if (proxy) // a script may delete it while it is drawn
      {
        proxy->RemoveObserver(this->First);
      }
    }
  }
  QuietUpdates(const QuietUpdates&) = delete;
  QuietUpdates& operator=(const QuietUpdates&) = delete;

  /// From now on the proxy announces no update.
  void add(vtkSMProxy* proxy)
  {
    constexpr float beforeAllOthers = 1e6f;
    proxy->AddObserver(vtkCommand::UpdateDataEvent, this->First, beforeAllOthers);
    this->Proxies.emplace_back(proxy);
  }

private:
  vtkNew<vtkCallbackCommand> First;
  std::vector<vtkWeakPointer<vtkSMProxy>> Proxies;
};

/// Keeps the pictures of Deformed Volumes while a tool is in hand. Hovering then redraws only the
/// outlines over them and casts no rays.
class KeptPictures
{
public:
  ~KeptPictures() { this->letGo(); }

  /// Keeps the picture of a representation from now on.
  void keep(pqDataRepresentation* display);
  /// Keeps none any more.
  void letGo();

private:
  QList<QPointer<pqDataRepresentation>> Kept;
};
}

#endif
