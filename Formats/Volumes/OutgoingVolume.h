// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A volume on its way into a file: one point array of an image, placed in RAS millimetres.
///
/// The one road out, as PlacedVolume is the one road in. Formats take what is here and say nothing
/// of images, worlds and types that no file holds.
#ifndef BrainShift_OutgoingVolume_h
#define BrainShift_OutgoingVolume_h

#include "Common/Grid.h"
#include "Common/WorldAxes.h"
#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkSmartPointer.h"

#include <string>

class vtkDataArray;
class vtkImageData;
class vtkInformation;

namespace brainshift
{
/**
 * What a file says of itself if nobody knew the sides of the patient: NIfTI in its description,
 * MetaImage and NRRD in a comment. Readers honour it. The voxels of such a file lie where they lay,
 * as if the world were RAS.
 */
constexpr const char* UnknownSidesNote = "sides of the patient not known";

/** What to know about such a file, without a full stop. */
constexpr const char* UnknownSidesWritten =
  "The world axes of the input are unknown: the file is written as RAS, with a remark";

/**
 * What a MetaImage of three floating numbers says of itself if they are no displacements. The
 * reader of fields honours it; other programs pass over it.
 */
constexpr const char* NoFieldNote = "components of a volume, no displacement field";

/** A number of a voxel as files know it. */
struct VoxelNumber
{
  enum class Kind
  {
    Unsigned,
    Signed,
    Floating
  };
  Kind kind = Kind::Floating;
  int bytes = 4; ///< 1, 2 or 4; floating: 4 or 8
};

/** What a file gets. */
struct OutgoingVolume
{
  Grid grid;                       ///< mm, RAS; its direction may be a mirrored rotation
  bool knowsSides = true;          ///< false: RAS is a guess
  Template space = Template::None; ///< whose space RAS is
  bool isField = false;            ///< its numbers are displacements
  bool isLabelMap = false;         ///< its numbers are labels
  bool smallIsBright = false;      ///< whether stations show small numbers bright
  std::string unit;                ///< of its numbers; empty: not known
  VoxelNumber type;
  vtkSmartPointer<vtkDataArray> numbers; ///< x fastest, components side by side in memory

  int components() const;
  const char* bytes() const;         ///< of all numbers
  std::size_t bytesOfVoxel() const;  ///< all components
  std::size_t bytesOfVolume() const; ///< all voxels
};

/**
 * Takes a point array of an image, or throws one sentence, without a full stop.
 *
 * @param arrayName   empty: the active scalars, else the first array of numbers
 * @param world       what the user says of the world; Unknown: what the image says (WorldAxes.h)
 * @param warning     one sentence, without a full stop, on what the user must know; may stay empty
 */
VTKBRAINSHIFTFORMATS_EXPORT void takeOut(vtkImageData* image, const std::string& arrayName,
  WorldAxes world, OutgoingVolume& volume, std::string& warning);

/**
 * The grid of an extent of an image, in RAS. Throws a sentence if no file can hold it.
 *
 * @param extent   the whole one, of which the image may have a part
 * @param world    as in takeOut
 */
Grid outgoingGrid(vtkImageData* image, const int extent[6], WorldAxes world);

/**
 * What a container of one time, "file" or "store", leaves out of several: a sentence, without a
 * full stop. Empty: nothing.
 */
std::string noteOfTimes(
  vtkImageData* image, vtkInformation* pipeline, const std::string& container);

/**
 * Whether NIfTI needs a transform for this grid. Without one, and with both codes 0, it has the
 * voxels along the axes, the first at 0 0 0, and claims no place in a patient.
 */
bool needsTransform(const Grid& grid);

/** The same grid with x and y reversed: this leads from RAS to LPS and back. */
Grid withReversedXY(const Grid& grid);
}

#endif
