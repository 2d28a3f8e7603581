// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The facts about the tissue at one position of a drawn volume.
#ifndef BrainShift_TissueFacts_h
#define BrainShift_TissueFacts_h

#include "Common/WorldAxes.h"

#include <glm/glm.hpp>

#include <functional>
#include <optional>
#include <string>

class vtkImageData;

namespace brainshift
{
struct DrawnValues;
struct SceneDeformation;

/// Positions are mm in the volume's own axes, before the transform of the vtkVolume.
struct TissueFacts
{
  glm::dvec3 deformed{ 0.0 }; ///< Where the tissue is drawn.
  glm::dvec3 rest{ 0.0 };     ///< Where it was in the volume as loaded.
  bool bent = false;          ///< Whether a deformation places the tissue. Else rest = deformed.
  double volumeRatio = 1.0;   ///< Jacobian determinant of deformedFromRest. 1: size is kept.
  /// Of the voxel that is nearest at rest: of the drawn array, or of a finer level that is drawn
  /// there.
  std::optional<double> value;
  std::optional<double> reference; ///< Of the nearest voxel of a reference that is shown.
  /// Of the nearest voxel: the value, where the volume names its own values; else the label of an
  /// attached segmentation.
  std::optional<double> label;
  std::string labelName; ///< What the data calls the label. Empty: no name.
  /// Uncertainty of its position: mm, one standard deviation along an axis, infinity where
  /// nothing was measured.
  std::optional<double> deviation;
  WorldAxes axes = WorldAxes::Unknown; ///< Meaning of the axes, as the data gives it.
};

/// The number of a finer level that is drawn at a place at rest (texture coordinates); none: the
/// volume's own voxels are drawn there.
using FinerNumber = std::function<std::optional<double>(const glm::dvec3& texture)>;

/// The facts about a position in the deformed frame. An unknown number is left out: outside
/// the volume, without a value, or of an array with several components. If the reference is shown
/// alone, the facts are about the reference, which is not bent.
TissueFacts factsAt(vtkImageData* image, const DrawnValues& values, SceneDeformation& deformation,
  const glm::dvec3& deformedMm, const FinerNumber& finerAt);

/// Maps a place (mm) of the bent volume to the same tissue at rest, or back if `toRest` is false.
glm::dvec3 sameTissue(SceneDeformation& deformation, const glm::dvec3& place, bool toRest);
}

#endif
