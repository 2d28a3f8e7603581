// SPDX-License-Identifier: BSD-3-Clause
#include "Plugin/SliceGreys.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Displays/VolumeLook.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Plugin/FirstLook.h"
#include "Plugin/FirstSight.h"

#include <pqDataRepresentation.h>
#include <pqUndoStack.h>

#include <vtkNew.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSession.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMTransferFunctionManager.h>

#include <QTimer>
#include <QVariant>

#include <array>

namespace brainshift
{
namespace
{
// Qt properties of a display: numbers of the colour map before it became slices, and of its greys.
constexpr const char* Before = "BrainShiftColorsBefore";
constexpr const char* Greys = "BrainShiftGreys";
// Annotation of a colour map, which state files keep: it is the greys of slices. four_views of the
// Python module sets it, too.
constexpr const char* AreGreys = "BrainShift.SliceGreys";

QString arrayOf(pqDataRepresentation* display)
{
  return vtkSMPropertyHelper(display->getProxy(), "ColorArrayName").GetInputArrayNameToProcess();
}

// Another display of the same array of the volume, or of what is made of it, with colours that
// satisfy a condition; null if there is none.
template <typename Condition>
pqDataRepresentation* displayBeside(pqDataRepresentation* display, const Condition& holds)
{
  pqServerManagerModel* model = serverManagerModel();
  for (auto other : model->findItems<pqDataRepresentation*>())
  {
    vtkSMProxy* colors = other->getLookupTableProxy();
    if (other != display && colors && holds(other, colors) && arrayOf(other) == arrayOf(display) &&
      (isMadeOf(sourceOf(other), sourceOf(display)) ||
        isMadeOf(sourceOf(display), sourceOf(other))))
    {
      return other;
    }
  }
  return nullptr;
}

vtkSMProxy* newGreys(pqDataRepresentation* display)
{
  const std::vector<double> window = tissueWindow(display);
  if (window.size() != 2)
  {
    return nullptr;
  }
  const QString name =
    QString("Slices_%1_%2").arg(display->getProxy()->GetGlobalIDAsString(), arrayOf(display));
  vtkNew<vtkSMTransferFunctionManager> manager;
  vtkSMProxy* greys = manager->GetColorTransferFunction(
    name.toUtf8().constData(), display->getProxy()->GetSessionProxyManager());
  const std::array<double, 8> points{ window[0], 0, 0, 0, window[1], 1, 1, 1 };
  vtkSMPropertyHelper(greys, "ColorSpace").Set("RGB");
  vtkSMPropertyHelper(greys, "RGBPoints").Set(points.data(), points.size());
  vtkSMPropertyHelper(greys, "AutomaticRescaleRangeMode", true)
    .Set(static_cast<int>(vtkSMTransferFunctionManager::NEVER));
  vtkSMPropertyHelper(greys, "ScalarRangeInitialized", true).Set(1);
  greys->SetAnnotation(AreGreys, "1");
  greys->UpdateVTKObjects();
  return greys;
}

void setColors(pqDataRepresentation* display, vtkSMProxy* colors)
{
  vtkSMPropertyHelper(display->getProxy(), "LookupTable").Set(colors);
  display->getProxy()->UpdateVTKObjects();
}

void keepGreys(pqDataRepresentation* display)
{
  vtkSMProxy* colors = display->getLookupTableProxy();
  if (!showsSlices(display) || !colors || !isLook(colors) ||
    pqApplicationCore::instance()->isLoadingState())
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  pqDataRepresentation* slices =
    displayBeside(display, [](pqDataRepresentation* other, vtkSMProxy* own) {
      return !isLook(own) && showsSlices(other);
    });
  if (vtkSMProxy* greys = slices ? slices->getLookupTableProxy() : newGreys(display))
  {
    display->setProperty(Before, colors->GetGlobalID());
    display->setProperty(Greys, greys->GetGlobalID());
    setColors(display, greys);
    display->renderViewEventually();
  }
}
}

void keepGreysSoon(pqDataRepresentation* display)
{
  if (showsSlices(display) && display->getLookupTableProxy() &&
    isLook(display->getLookupTableProxy()))
  {
    QTimer::singleShot(0, display, [display] { keepGreys(display); });
  }
}

namespace
{
// Those that the display had before it became slices. False if they are not known.
bool takeOldColorsBack(pqDataRepresentation* display)
{
  const auto number = [&](const char* name) {
    return display->property(name).value<vtkTypeUInt32>();
  };
  auto colors =
    vtkSMProxy::SafeDownCast(display->getProxy()->GetSession()->GetRemoteObject(number(Before)));
  if (!colors || display->getLookupTableProxy()->GetGlobalID() != number(Greys))
  {
    return false;
  }
  setColors(display, colors);
  return true;
}
}

void takeColorsBack(pqDataRepresentation* display)
{
  vtkSMProxy* present = display->getLookupTableProxy();
  if (!present || !present->HasAnnotation(AreGreys) || takeOldColorsBack(display) ||
    !showsVolume(display) || isReplayed())
  {
    return;
  }
  // The greys of Four Views, or of a state file.
  pqDataRepresentation* volume =
    displayBeside(display, [](pqDataRepresentation* other, vtkSMProxy* own) {
      return !own->HasAnnotation(AreGreys) && showsVolume(other);
    });
  if (volume)
  {
    shareColors(display, volume);
  }
  else
  {
    showFirstLook(display);
  }
}
}
