// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds grids, strips and depth shafts among the contacts of electrodes: which contact is at which
/// row and column, which are missing, and the distance between neighbours. No VTK.
///
/// The number in a label says where a contact is on its sheet; the shape is the one in which
/// neighbours are equally far from each other. Without such labels the order is found in the
/// positions alone. Positions are mm, in any frame.
///
/// Sorting the contacts of grids of known geometry by the distances between them: LaPlante et al.,
/// "The interactive electrode localization utility", International Journal of Computer Assisted
/// Radiology and Surgery 12 (2017). Here the geometry is found, too.
#ifndef BrainShift_ContactArrays_h
#define BrainShift_ContactArrays_h

#include "Common/Export.h" // for the export macro

#include <glm/glm.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
/** A contact of an electrode. */
struct Contact
{
  glm::dvec3 position{ 0.0 }; ///< mm, its middle
  std::string label;          ///< such as LTG12; empty: it has none
  std::string group;          ///< its electrode; empty: that is what is before the label's number
};

enum class ArrayKind
{
  Grid,
  Strip,
  Depth,
  Unknown ///< too few contacts, or no order in them
};

/** "grid", "strip", "depth" or "unknown". */
BRAINSHIFT_DEFORMATION_EXPORT const char* nameOf(ArrayKind kind);

/** What is known of an electrode before. */
struct ArrayHint
{
  std::string group;
  ArrayKind kind = ArrayKind::Unknown; ///< Unknown: nothing is known
  int rows = 0;                        ///< 0: not known; rows and columns may be exchanged
  int columns = 0;
  double pitchMm = 0.0; ///< 0: not known
};

/**
 * Reads a hint: the group, an equals sign, and any of a shape, a kind and a pitch with blanks
 * between them: "LTG=8x8", "A=depth", "G=grid 4x8 10mm". Throws a Problem on anything else.
 */
BRAINSHIFT_DEFORMATION_EXPORT ArrayHint hintIn(const std::string& text);

/** The contacts of one electrode. */
struct ContactArray
{
  std::string name; ///< the group; empty for contacts without labels
  ArrayKind kind = ArrayKind::Unknown;
  int rows = 0;         ///< 1 for a strip or a shaft; 0 if there is no order
  int columns = 0;      ///< contacts in a row
  double pitchMm = 0.0; ///< distance between neighbours along the sheet or the shaft
  bool byLabels = true; ///< whether the labels say the order; false: the positions do
  /** rows * columns numbers of contacts, row after row; none: the contact is missing. */
  std::vector<std::optional<std::size_t>> contacts;
  /**
   * Of the same places. A contact without a label has an empty one. A missing contact that no
   * number names is called by its row and column, such as r2c3, with the electrode before that
   * if there are several: G-r2c3, 2-r2c3.
   */
  std::vector<std::string> labels;
  std::vector<std::size_t> members; ///< all contacts of the electrode, in or out of order
  std::vector<std::string> doubts;  ///< sentences without a full stop
};

/**
 * The depth of a position below the cortex at rest in mm, negative outside. It tells shafts from
 * strips.
 */
using DepthBelowCortex = std::function<double(const glm::dvec3& position)>;

/** All electrodes, in the order of their first contacts. */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<ContactArray> recogniseArrays(
  const std::vector<Contact>& contacts, const std::vector<ArrayHint>& hints = {},
  const DepthBelowCortex& depth = {});
}

#endif
