// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Looks: colours and opacities that show a kind of tissue, made for one volume.
#ifndef BrainShift_Look_h
#define BrainShift_Look_h

#include "Filters/Looks/Intensities.h"

#include <array>

namespace brainshift
{
/** What made the values. It is a guess from the histogram. */
enum class VolumeKind
{
  MR,         ///< any units
  CT,         ///< Hounsfield units
  Ultrasound, ///< nothing outside the fan; more dark than bright
  Labels      ///< a mask or a label map: it has no look
};

/** How a volume is drawn. */
struct Look
{
  std::vector<std::array<double, 4>> colors;    ///< value, red, green, blue (0 to 1)
  std::vector<std::array<double, 2>> opacities; ///< value, opacity (0 to 1)
  bool drawsSegment = false;                    ///< draws the attached segmentation alone
  double tissue = 0.0;                          ///< what is above this value is seen
};

/**
 * Tells the kinds apart. CT has air near -1000 and much of it. Ultrasound has one value outside its
 * fan and, within it, ever fewer voxels the brighter they are.
 */
VTKBRAINSHIFTFILTERS_EXPORT VolumeKind kindOf(const Intensities& values);

/** "MR", "CT", "Ultrasound" or "Labels". */
VTKBRAINSHIFTFILTERS_EXPORT std::string nameOf(VolumeKind kind);

/** A look (preset) of one kind of volume, or of several. A name may have a row for each kind. */
struct LookRow
{
  const char* name; ///< also of its icon: look-see-through.png
  const char* tip;  ///< what it shows, one sentence
  bool ofSegment;   ///< shows the segmentation alone, where there is one
  bool (*fits)(VolumeKind kind, const Intensities& values);
  Look (*make)(const Intensities& values);
};

/** All looks. A volume gets the first one that fits, and offers the others in this order. */
VTKBRAINSHIFTFILTERS_EXPORT const std::vector<LookRow>& lookTable();

/** Names of the looks of a volume. The first one is what it gets at first. */
VTKBRAINSHIFTFILTERS_EXPORT std::vector<std::string> looksOf(const Intensities& values);

/** The look of that name; without colours if it is none of looksOf. */
VTKBRAINSHIFTFILTERS_EXPORT Look makeLook(const std::string& name, const Intensities& values);
}

#endif
