// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads and writes displacement fields in the files of registration programs.
 *
 * | ending         | format    | world in the file | where the direction stands         |
 * |----------------|-----------|-------------------|------------------------------------|
 * | .nii, .nii.gz  | NIfTI     | see NIFTIField.h  | intent_name                        |
 * | .mha, .mhd     | MetaImage | LPS               | Comment                            |
 * | .nrrd, .nhdr   | NRRD      | LPS               | "displacement field type" (Slicer) |
 *
 * In memory every field is RAS, mm. The fields of ITK, ANTs and elastix lead backward: from a point
 * of the image that is made to the point where its value is taken.
 */
#ifndef BrainShift_FieldFile_h
#define BrainShift_FieldFile_h

#include "Formats/Fields/DirectedField.h"
#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <string>
#include <vector>

namespace brainshift
{
/** A format of displacement fields. Formats/README.md has the recipe for a new one. */
struct FieldFormat
{
  std::vector<std::string> (*endings)(); ///< of names of files, such as ".nii.gz"
  bool (*isOne)(const std::string& fileName);
  ///@{
  /** Return one sentence, without a full stop, on what went wrong; empty if nothing did. */
  std::string (*read)(const std::string& fileName, DirectedField& field);
  std::string (*write)(const std::string& fileName, const DirectedField& field);
  ///@}
};

/** All formats of fields. brainshift_add_format writes this list. */
const std::vector<const FieldFormat*>& fieldFormats();

/** Whether a file looks like a displacement field: three components, in one of the formats. */
VTKBRAINSHIFTFORMATS_EXPORT bool isFieldFile(const std::string& fileName);

/**
 * Reads a field.
 *
 * @return one sentence, without a full stop, on what went wrong; empty if nothing did
 */
VTKBRAINSHIFTFORMATS_EXPORT std::string readFieldFile(
  const std::string& fileName, DirectedField& field);

/**
 * Writes a field. The ending of the name chooses the format. A field without a direction is written
 * as one that leads backward.
 *
 * @return one sentence, without a full stop, on what went wrong; empty if nothing did
 */
VTKBRAINSHIFTFORMATS_EXPORT std::string writeFieldFile(
  const std::string& fileName, const DirectedField& field);
}

#endif
