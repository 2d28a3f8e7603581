// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Asks what is known of the tissue under the cursor: position in both frames, intensity, label,
/// how it is bent. The process that drew the picture answers, so it works with a server too, and
/// the answer belongs to the picture that is seen.
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
  bool bent = false;               ///< Whether a deformation places it. Else rest = deformed.
  double volumeShare = 1.0;        ///< Jacobian determinant. 1: the tissue keeps its size.
  std::optional<double> intensity; ///< Of the nearest voxel, in the array that is shown.
  std::optional<double> reference; ///< Of the nearest voxel of a reference that is shown.
  /// Its label: as the colour map calls it; else as the data calls it, with its number; else the
  /// number. Empty: none.
  QString label;
  /// How far its place can be believed: mm, one standard deviation along an axis, infinity where
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
  /// `counts`: says which displays are asked; without it, all are.
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
