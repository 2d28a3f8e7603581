// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads and writes displacement fields in the files of registration programs.
///
/// | ending         | format    | world in the file | where the direction stands         |
/// |----------------|-----------|-------------------|------------------------------------|
/// | .nii, .nii.gz  | NIfTI     | see NIFTIField.cxx  | intent_name                        |
/// | .mha, .mhd     | MetaImage | LPS               | Comment                            |
/// | .nrrd, .nhdr   | NRRD      | LPS               | "displacement field type" (Slicer) |
///
/// In memory every field is RAS, mm. The fields of ITK, ANTs and elastix lead backward: from a
/// point of the image that is made to the point where its value is taken.
#ifndef BrainShift_FieldFile_h
#define BrainShift_FieldFile_h

#include "Common/FieldDirection.h"
#include "Common/Grid.h"
#include "Common/Problem.h"

#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <vector>

namespace brainshift
{
/** Displacements on a grid, and the direction they lead in. World is RAS, mm. */
struct DirectedField
{
  Grid grid;                            ///< mm, RAS
  std::vector<glm::vec3> displacements; ///< mm, RAS axes; one for each point, x fastest
  std::optional<Direction> direction;   ///< none if the file does not name it
  bool knowsSides = true;               ///< false: RAS is a guess
};

/** Reverses x and y of a field: this leads from RAS to LPS and back. */
VTKBRAINSHIFTFORMATS_EXPORT void reverseXY(DirectedField& field);

/** A format of displacement fields. Formats/README.md has the recipe for a new one. */
struct FieldFormat
{
  std::vector<std::string> (*endings)(); ///< of names of files, such as ".nii.gz"
  bool (*isOne)(const std::string& fileName);
  ///@{
  /** Throw one sentence, without a full stop, if anything goes wrong. */
  void (*read)(const std::string& fileName, DirectedField& field);
  void (*write)(const std::string& fileName, const DirectedField& field);
  ///@}
};

/** All formats of fields. brainshift_add_format writes this list. */
const std::vector<const FieldFormat*>& fieldFormats();

/** Whether the name of a file has the ending of one of the formats. */
VTKBRAINSHIFTFORMATS_EXPORT bool hasFieldEnding(const std::string& fileName);

/** Whether a file looks like a displacement field: three components, in one of the formats. */
VTKBRAINSHIFTFORMATS_EXPORT bool isFieldFile(const std::string& fileName);

/** Reads a field, or throws one sentence, without a full stop. */
VTKBRAINSHIFTFORMATS_EXPORT void readFieldFile(const std::string& fileName, DirectedField& field);

/**
 * Writes a field, or throws one sentence, without a full stop. The ending of the name chooses the
 * format. A field without a direction is written as one that leads backward.
 */
VTKBRAINSHIFTFORMATS_EXPORT void writeFieldFile(
  const std::string& fileName, const DirectedField& field);
}

#endif
