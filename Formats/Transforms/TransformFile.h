// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads the transforms of registration programs.
///
/// | file                              | program                  | points       |
/// |-----------------------------------|--------------------------|--------------|
/// | .tfm, .txt, .h5, .hdf5            | ITK, Slicer, ANTs        | LPS          |
/// | .mat, binary                      | ANTs (0GenericAffine)    | LPS          |
/// | .txt, "(Transform ...)"           | elastix                  | LPS          |
/// | .nii, .nii.gz, .mha, .mhd, .nrrd  | displacement fields      | FieldFile.h  |
/// | text, 16 numbers                  | NiftyReg                 | RAS          |
/// | text, 16 numbers                  | FSL flirt                | FSL's own mm |
/// | .nii, .nii.gz, intents of FSL     | FSL fnirt, convertwarp   | FSL's own mm |
/// | .nii, .nii.gz, if SPM is named    | SPM (y_, iy_)            | RAS          |
/// | .lta                              | FreeSurfer, NiTransforms | RAS, voxels  |
/// | .xfm                              | the MNI's, FreeSurfer    | RAS          |
///
/// The content decides, not the name. Between NiftyReg and FSL nothing in the file decides, so the
/// caller must name the program. All map points of the fixed image to the moving one, but for FSL's
/// matrices, .lta and .xfm, which are inverted.
#ifndef BrainShift_TransformFile_h
#define BrainShift_TransformFile_h

#include "Common/Problem.h"
#include "Formats/Transforms/PointTransform.h"

namespace brainshift
{
/** Whose a text of 16 numbers, or a NIfTI file without an intent, is. */
enum class MatrixProgram
{
  Unknown,  ///< FSL if an image is named; else such a text is refused
  FSL,      ///< from FSL mm of the moving image to those of the fixed image; it needs both images
  NiftyReg, ///< from RAS mm of the fixed image to those of the moving image
  SPM,      ///< no text: NIfTI files without an intent hold positions in RAS mm, as SPM's do
};

/** What is to be read. */
struct TransformFiles
{
  std::vector<std::string> names; ///< in the order in which points of the fixed image pass them
  std::string fixedImage;         ///< NIfTI; for FSL, and where an LTA does not say which end it is
  std::string movingImage;        ///< likewise
  MatrixProgram program = MatrixProgram::Unknown;
};

/** Whether a file looks like a transform that is no displacement field. */
VTKBRAINSHIFTFORMATS_EXPORT bool isTransformFile(const std::string& fileName);

/** Reads a chain, from RAS to RAS (mm), or throws one sentence, without a full stop. */
VTKBRAINSHIFTFORMATS_EXPORT PointTransform readTransformFiles(const TransformFiles& files);
}

#endif
