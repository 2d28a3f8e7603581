// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Texts that name what their matrix leads from and to: FreeSurfer's .lta and the MNI's .xfm.
///
/// Both lead from one image to another: an LTA from the points of its src to those of its dst, an
/// XFM from those of its source to those of its target. FreeSurfer's and the MNI's programs write
/// the moving image as the first and the fixed image as the second, so a chain, which leads from
/// the fixed image to the moving one, is their inverse.
#ifndef BrainShift_MatrixText_h
#define BrainShift_MatrixText_h

#include "Formats/Transforms/PointTransform.h"

namespace brainshift
{
/** Images that say which end of a file is the fixed one. Empty: not named. */
struct NamedImages
{
  std::string fixed;
  std::string moving;
};

/** Whether a text is FreeSurfer's LTA. */
bool isLTAText(const std::string& text);

/**
 * Adds the map of an LTA, in RAS, from the fixed to the moving image, or throws the end of a
 * sentence. The matrix leads from src, the moving image, to dst. NiTransforms exchanges the names
 * of the ends, and images that are named may have the geometry of the other end. Returns whether
 * the map was inverted.
 */
bool addLTAText(const std::string& text, const NamedImages& images, PointTransform& transform);

/** Whether a text is the MNI's XFM. */
bool isXFMText(const std::string& text);

/**
 * Adds the maps of an XFM, likewise: the fixed image is its target.
 *
 * @param fileName   the file itself: displacement volumes are named relative to its folder
 */
void addXFMText(const std::string& text, const std::string& fileName, PointTransform& transform);
}

#endif
