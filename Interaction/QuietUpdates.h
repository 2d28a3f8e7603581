// SPDX-License-Identifier: BSD-3-Clause
// While one lives, nobody hears that the data of the proxies added to it were updated. ParaView
// asks for every array's range at such news, looks through the menu of filters and lays out its
// panels: a third of the time that one picture of a drag takes the main thread.
#ifndef BrainShift_QuietUpdates_h
#define BrainShift_QuietUpdates_h

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkSMProxy.h>
#include <vtkWeakPointer.h>

#include <vector>

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

#endif
