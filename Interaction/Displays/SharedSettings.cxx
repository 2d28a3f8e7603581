// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/SharedSettings.h"

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSessionProxyManager.h>

namespace brainshift
{
vtkSMProxy* sharedSettings()
{
  vtkSMProxyManager* all = vtkSMProxyManager::GetProxyManager();
  vtkSMSessionProxyManager* session = all ? all->GetActiveSessionProxyManager() : nullptr;
  return session ? session->GetProxy("settings", "BrainShiftSettings") : nullptr;
}

bool wantsBlueAndOrange()
{
  constexpr int blueAndOrange = 1; // as Representations/Scene/Tints.h numbers them
  vtkSMProxy* settings = sharedSettings();
  return settings && vtkSMPropertyHelper(settings, "ComparisonColors").GetAsInt() == blueAndOrange;
}
}
