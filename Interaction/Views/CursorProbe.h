// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Properties of the tissue under the cursor: position in both frames, intensity, label,
/// deformation. The process that drew the picture computes them, so this works with a server too,
/// and they belong to the picture on the screen.
#ifndef BrainShift_CursorProbe_h
#define BrainShift_CursorProbe_h

#include "Common/WorldAxes.h"

#include <vtkSmartPointer.h>

#include <QPointer>
#include <QString>

#include <glm/glm.hpp>

#include <functional>
#include <optional>

class pqDataRepresentation;
class pqRenderView;
class vtkSMProxy;

namespace brainshift
{
/// Positions: mm, in the volume's own axes, before Translation, Orientation and Scale.
struct CursorTissue
{
  glm::dvec3 deformed{ 0.0 };      ///< Where it is drawn.
  glm::dvec3 rest{ 0.0 };          ///< Where it was in the volume as loaded.
  bool bent = false;               ///< Whether a deformation moves it. Else rest = deformed.
  double jacobian = 1.0;           ///< Determinant. 1: the tissue keeps its volume.
  std::optional<double> intensity; ///< Of the nearest voxel, in the array that is shown.
  std::optional<double> reference; ///< Of the nearest voxel of a reference that is shown.
  /// Its label: the name in the colour map; else the name in the data, with its number; else the
  /// number. Empty: none.
  QString label;
  /// Uncertainty of its position: one standard deviation along an axis (mm), infinity where
  /// nothing was measured. None: unknown.
  std::optional<double> deviation;
  WorldAxes axes = WorldAxes::Unknown;
};

class CursorProbe
{
public:
  /// The tissue that the last picture shows at a pixel, from the lower left corner of the view. Of
  /// several volumes, the one in front. Draws nothing. None where no Deformed Volume or Deformed
  /// Slices is hit, and while the picture is older than the data.
  /// `counts`: whether a display is included; without it, all are.
  std::optional<CursorTissue> tissueAt(pqRenderView* view, int x, int y,
    const std::function<bool(pqDataRepresentation*)>& counts = {});

  /// Lets go of view and volumes.
  void forget();

private:
  QPointer<pqRenderView> View;
  vtkSmartPointer<vtkSMProxy> Report; ///< A DeformedVolumeReport of View.
};
}

#endif
