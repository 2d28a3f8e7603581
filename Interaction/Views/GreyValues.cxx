// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/GreyValues.h"

#include <pqUndoStack.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMTrace.h>
#include <vtkSMTransferFunctionManager.h>

#include <cmath>
#include <cstddef>

namespace brainshift
{
namespace
{
constexpr std::size_t PointNumbers = 4;        // value, red, green, blue
constexpr double PixelsToDoubleWindow = 200.0; // to the right
constexpr double PixelsOfWindow = 400.0;       // upwards: the level rises by the window's length
}

bool GreyValues::begin(vtkSMProxy* display, const int pixel[2])
{
  this->Colors = vtkSMPropertyHelper(display, "LookupTable", true).GetAsProxy();
  if (!this->Colors || vtkSMPropertyHelper(this->Colors, "IndexedLookup", true).GetAsInt())
  {
    this->Colors = nullptr;
    return false;
  }
  this->Before = vtkSMPropertyHelper(this->Colors, "RGBPoints").GetDoubleArray();
  const std::size_t count = this->Before.size();
  if (count < 2 * PointNumbers || !(this->Before[count - PointNumbers] > this->Before[0]))
  {
    this->Colors = nullptr;
    return false;
  }
  this->Now = this->Before;
  this->Start[0] = pixel[0];
  this->Start[1] = pixel[1];
  return true;
}

void GreyValues::dragTo(const int pixel[2], double scale)
{
  if (!this->Colors)
  {
    return;
  }
  if (pixel[0] == this->Start[0] && pixel[1] == this->Start[1])
  {
    this->Now = this->Before; // to the bit: back at the start is no edit
    SCOPED_UNDO_EXCLUDE();
    this->set(this->Now);
    return;
  }
  const double low = this->Before.front();
  const double window = this->Before[this->Before.size() - PointNumbers] - low;
  const double right = (pixel[0] - this->Start[0]) / scale;
  const double upwards = (pixel[1] - this->Start[1]) / scale;
  const double wider = std::exp2(right / PixelsToDoubleWindow);
  const double level = low + window / 2.0 + upwards * window / PixelsOfWindow;
  for (std::size_t i = 0; i < this->Now.size(); i += PointNumbers)
  {
    const double fraction = (this->Before[i] - low) / window;
    this->Now[i] = level + wider * window * (fraction - 0.5);
  }
  SCOPED_UNDO_EXCLUDE(); // the whole drag is one step
  this->set(this->Now);
}

void GreyValues::end()
{
  if (this->Colors && this->Now != this->Before)
  {
    {
      SCOPED_UNDO_EXCLUDE();
      this->set(this->Before);
    }
    SCOPED_UNDO_SET("Window and level");
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->Colors.Get());
    vtkSMPropertyHelper(this->Colors, "AutomaticRescaleRangeMode", true)
      .Set(static_cast<int>(vtkSMTransferFunctionManager::NEVER));
    this->set(this->Now);
  }
  this->Colors = nullptr;
}

void GreyValues::set(const std::vector<double>& points)
{
  vtkSMPropertyHelper(this->Colors, "RGBPoints")
    .Set(points.data(), static_cast<unsigned int>(points.size()));
  this->Colors->UpdateVTKObjects();
}
}
