// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The voxels that each of several MPI ranks wants.
#ifndef BrainShift_SharedVolume_h
#define BrainShift_SharedVolume_h

#include "Common/Extent.h"
#include "Common/Grid.h"
#include "vtkBrainShiftCommonModule.h" // for the export macro

#include "vtkFieldData.h" // for its smart pointer
#include "vtkImageData.h" // likewise
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

class vtkDataArray;
class vtkMultiProcessController;

namespace brainshift
{
/// A volume of which ranks hold parts.
struct WholeVolume
{
  Grid grid; ///< Of all points; its origin is the first point of `extent`.
  Extent extent{ 0, -1, 0, -1, 0, -1 };
};

/// Least and greatest value of each component of the whole volume's arrays, and last of their
/// magnitude. By whether the array is of cells, and its name.
using WholeRanges = std::map<std::pair<bool, std::string>, std::vector<std::array<double, 2>>>;

/**
 * Gives each MPI rank the voxels that it wants of those that all ranks hold. It gets those that it
 * lacks; what it holds stays where the pipeline has it (PiecedArray.h). They are sent when some
 * changed or a rank wants others, so most strokes send none. What the volume carries as field data,
 * such as its deformation, is whole on each rank that holds voxels; others get it, too.
 *
 * The pipeline is not asked for other voxels than ParaView asks for: a reader would read its file
 * again whenever the requests of two consumers take turns.
 */
class VTKBRAINSHIFTCOMMON_EXPORT SharedVolume
{
public:
  /**
   * The whole volume, from the first rank that holds some of it. All ranks must call it together.
   *
   * @param part    this rank's part of the volume; null: none
   * @param whole   the whole extent
   */
  static WholeVolume wholeOf(
    vtkMultiProcessController* ranks, vtkImageData* part, const Extent& whole);

  /**
   * Exchanges voxels. All ranks must call it together.
   *
   * @param part     this rank's part of the volume; null: none
   * @param whole    what wholeOf returned
   * @param wanted   this rank's extent; empty: none
   * @param problem  why this rank cannot take part, without a full stop; empty: it can. Becomes why
   *                 one of the ranks cannot, the same on all.
   * @return the wanted extent, or an image without points; points that no part holds are 0. Null
   *         on all ranks if there is a problem: nothing was exchanged then.
   */
  vtkSmartPointer<vtkImageData> share(vtkMultiProcessController* ranks, vtkImageData* part,
    const WholeVolume& whole, const Extent& wanted, std::string& problem);

  /** The ranges of the whole volume's values, finite ones alone, since the last exchange. An array
   * of cells has none if one of points has its name. */
  const WholeRanges& ranges() const { return this->Ranges; }

  /** Bytes of the voxels that this rank has beside its part, since the last exchange. */
  double bytesReceived() const { return this->Received; }

private:
  struct Known
  {
    const vtkDataArray* array;
    vtkMTimeType time; // unique among all objects
    bool operator==(const Known& o) const { return array == o.array && time == o.time; }
  };

  // What a volume says besides its voxels.
  struct Said
  {
    vtkSmartPointer<vtkFieldData> fields;
    std::string scalars; // that are active, of points
  };

  bool changed(vtkImageData* part, const Extent& whole, const Extent& wanted);
  std::string exchange(vtkMultiProcessController* ranks, vtkImageData* part, const Extent& wanted,
    const std::string& problem);
  Said lend(vtkMultiProcessController* ranks, vtkImageData* part) const;

  WholeRanges Ranges;
  std::vector<Known> Arrays;            // of this rank's part, as sent last
  std::vector<int> Extents;             // of this rank's part, of the whole, and wanted
  double Received = 0.0;                // bytes
  int Lender = -1;                      // this rank's words go to ranks without voxels; -1: none
  vtkSmartPointer<vtkImageData> Voxels; // of the wanted extent
};
}

#endif
