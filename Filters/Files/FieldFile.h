// SPDX-License-Identifier: BSD-3-Clause
// Displacement fields in the files of registration programs.
//
//   .nii .nii.gz   NIfTI. Written with intent 1006 (DISPVECT), RAS, which ITK from 5.4 turns into
//                  LPS when it reads; intent_name tells the direction. Read: intents 1006 (RAS),
//                  1007 as ITK, ANTs and elastix write it (LPS) and as NiftyReg does (RAS;
//                  intent_p1 0: positions, 1: displacements).
//   .mha .mhd      MetaImage, LPS; Comment tells the direction.
//   .nrrd .nhdr    NRRD, LPS; "displacement field type" tells the direction as Slicer does.
//
// In memory all is RAS, mm. ITK's, ANTs' and elastix' fields lead backward: from a point of the
// image that is made to where its value is taken.
#ifndef BrainShift_FieldFile_h
#define BrainShift_FieldFile_h

#include "Filters/Attached/DirectedMap.h"
#include "Filters/Deformation/Grid.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
struct FieldFile
{
  Grid grid;                            // mm, RAS
  std::vector<glm::vec3> displacements; // mm, RAS axes; x fastest
  std::optional<Direction> direction;   // as far as the file tells
};

// The same field with x and y reversed: from RAS to LPS and back.
VTKBRAINSHIFTFILTERS_EXPORT void reverseXY(FieldFile& field);

// Whether a file looks like a displacement field: three components, in one of the formats.
VTKBRAINSHIFTFILTERS_EXPORT bool isFieldFile(const std::string& fileName);

// One sentence on what went wrong; empty if nothing did.
VTKBRAINSHIFTFILTERS_EXPORT std::string readFieldFile(
  const std::string& fileName, FieldFile& field);
VTKBRAINSHIFTFILTERS_EXPORT std::string writeFieldFile(
  const std::string& fileName, const FieldFile& field);
}

#endif
