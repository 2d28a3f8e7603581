// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A legend of the tints of uncertainty (1 sd, mm) in the upper right corner of a view.
///
/// The upper left corner belongs to the legend of a comparison.
#ifndef BrainShift_EvidenceLegend_h
#define BrainShift_EvidenceLegend_h

#include "Representations/Scene/WindowText.h"

#include "vtkNew.h"
#include "vtkProp.h"

#include <array>
#include <functional>

namespace brainshift
{
class EvidenceLegend : public vtkProp
{
public:
  static EvidenceLegend* New();
  vtkTypeMacro(EvidenceLegend, vtkProp);

  /// What is shown. Stripes replace tints where colours distinguish volumes.
  enum class Shown
  {
    Nothing, ///< The volume carries no evidence.
    Tints,
    Stripes,
  };

  /// Called before each picture. Null: tints.
  std::function<Shown()> Ask;

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderOverlay(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  EvidenceLegend();
  ~EvidenceLegend() override;

private:
  EvidenceLegend(const EvidenceLegend&) = delete;
  void operator=(const EvidenceLegend&) = delete;

  void Write(vtkViewport* viewport);
  void Fit(vtkViewport* viewport, Shown shown);

  std::array<int, 4> Fitted{};             // size and dots per inch of the view, and what was shown
  std::array<vtkNew<WindowText>, 5> Lines; // a heading, then the classes
};
}

#endif
