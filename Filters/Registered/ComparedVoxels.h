// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The voxels of a volume that a registration compares: not finer than it can use, on one rank.
#ifndef BrainShift_ComparedVoxels_h
#define BrainShift_ComparedVoxels_h

#include "Common/Extent.h"
#include "Common/Grid.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkImageData.h" // for its smart pointer
#include "vtkSmartPointer.h"

#include <string>

class vtkDataArray;
class vtkInformation;

namespace brainshift
{
/**
 * Voxels of at most this fraction of the distance of samples are compared. Samples are smoothed by
 * a Gaussian of 0.45 of that distance; the average over such a voxel adds 5 % to its width.
 */
constexpr double ComparedVoxelFraction = 0.5;

/** What a registration compares of a volume. */
struct ComparedVoxels
{
  vtkSmartPointer<vtkImageData> image; ///< with all that the volume carries; null: another rank's
  Grid whole{};                        ///< of the volume in the pipeline (mm, world)
  std::string remark; ///< on what is compared in place of what should be; empty: nothing
};

/** The active scalars of an image, or its first array; null unless they have one component. */
VTKBRAINSHIFTFILTERS_EXPORT vtkDataArray* comparedScalars(vtkImageData* image);

/**
 * The voxels that are compared on samples `finestMm` apart:
 *
 * - If the volume's are coarser and its file has finer levels, the coarsest of them that suits is
 *   read, as far as memory allows.
 * - If it has finer ones, and more than joinedVoxels asks for, their averages.
 * - Else the image itself.
 *
 * On several MPI ranks the first one gets them; the others send it their averages and get null. All
 * ranks must call it together, and a Problem is thrown on all.
 *
 * @param part          this rank's part; null: none
 * @param information   pipeline information of it; null with no part
 */
VTKBRAINSHIFTFILTERS_EXPORT ComparedVoxels comparedVoxels(
  vtkImageData* part, vtkInformation* information, double finestMm);

/**
 * So many voxels along each axis are averaged into one, whose sides are then at most `longestMm`. 1
 * 1 1 if fewer than 4 million would be left: in a small volume, samples may be nearer than planned.
 */
VTKBRAINSHIFTFILTERS_EXPORT glm::ivec3 joinedVoxels(const Grid& grid, double longestMm);

/** Values beyond this are no measurements: a comparison adds up squares, which would overflow. */
constexpr double LargestComparedValue = 1e17;

/** Blocks of voxels, each of which is averaged, and the numbers that are there. */
struct VoxelBlocks
{
  Extent held;       ///< of the numbers; it has the voxels of the averages that are wanted
  Extent whole;      ///< of all voxels
  glm::ivec3 joined; ///< see joinedVoxels
};

/**
 * Averages of voxels. Beyond the volume its last voxel holds. NaN where fewer than half of the
 * voxels are numbers that can be compared.
 *
 * @param numbers   of the voxels, one component, x fastest
 * @param wanted    first and last average along x, y and z, counted from 0
 * @param averages  one number for each of them, x fastest
 */
VTKBRAINSHIFTFILTERS_EXPORT void averageVoxels(
  vtkDataArray* numbers, const VoxelBlocks& blocks, const Extent& wanted, float* averages);
}

#endif
