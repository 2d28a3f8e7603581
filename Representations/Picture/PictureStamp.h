// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Finds what has changed since the last picture. While a tool hovers, only its outline over
 * the picture changes. While it bends, only the tissue that it moves changes.
 */
#ifndef BrainShift_PictureStamp_h
#define BrainShift_PictureStamp_h

#include "Representations/Scene/SceneFrame.h"

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <vector>

namespace brainshift
{
struct Counters;
struct RayCastScene;

/// Remembers what the last picture depended on.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT PictureStamp
{
public:
  enum Change
  {
    Nothing,  ///< The picture would be the same.
    Bending,  ///< Only the values of the offset field changed.
    Reaching, ///< Besides, tissue can reach farther or less far: rays begin elsewhere.
    Anything  ///< The whole picture is new.
  };

  /// Compares with the last call and remembers this one. Whatever lies in front of or behind the
  /// volume counts, too, but not the props that are drawn over volumes. `settingsTime`: when the
  /// settings of the mapper changed last.
  Change change(const DrawnVolume& drawn, unsigned long long settingsTime,
    const RayCastScene& scene, const Counters& counters);

  /// The next call finds that anything has changed.
  void forget() { this->Last.clear(); }

private:
  std::vector<double> Last; // all but what bending changes
  std::vector<double> LastBending;
  std::vector<double> LastSpace;
};
}

#endif
