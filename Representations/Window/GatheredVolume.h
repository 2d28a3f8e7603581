// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// All of a volume on the first of several MPI ranks.
#ifndef BrainShift_GatheredVolume_h
#define BrainShift_GatheredVolume_h

#include "vtkImageData.h" // for its smart pointer
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class vtkDataArray;
class vtkDataSetAttributes;
class vtkMultiProcessController;

namespace brainshift
{
/**
 * Collects on the first rank the parts that MPI ranks hold of a volume. Only voxels that changed
 * are sent, so a stroke sends none. What the volume carries as field data, such as its deformation,
 * is whole on each rank and is taken from the first.
 */
class GatheredVolume
{
public:
  /**
   * Collects the volume. All ranks must call it together.
   *
   * @param part    this rank's part of the volume; null: none
   * @param whole   the whole extent; points that no part holds are 0
   * @return on the first rank, the volume; on the others, an image without points
   */
  vtkSmartPointer<vtkImageData> gather(
    vtkMultiProcessController* ranks, vtkImageData* part, const int whole[6]);

private:
  struct Known
  {
    const vtkDataArray* array;
    vtkMTimeType time; // unique among all objects
    bool operator==(const Known& o) const { return array == o.array && time == o.time; }
  };

  bool changed(vtkImageData* part, const int whole[6]);
  void place(vtkImageData* part, const int whole[6]);
  void receive(vtkMultiProcessController* ranks, int rank);

  std::vector<Known> Arrays;            // of this rank's part, as sent last
  std::vector<int> Extents;             // of this rank's part and of the whole
  vtkSmartPointer<vtkImageData> Voxels; // collected last
};
}

#endif
