// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The part of a reference that one of several MPI ranks draws.
///
/// A reference lies in the deformed frame, which is cut into a box for each rank
/// (Window/RankParts.h). Every rank's pipeline brings all of it. So a rank takes what its box needs
/// by itself, and its card holds no more.
#ifndef BrainShift_ReferencePart_h
#define BrainShift_ReferencePart_h

#include "Common/Extent.h"
#include "Common/RankAgreement.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include "vtkDataArray.h" // for its smart pointer
#include "vtkSmartPointer.h"

#include <glm/glm.hpp>

class vtkImageData;

namespace brainshift
{
struct PlacedVoxels;

/// Cuts the references that one display carries, one after the other.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT ReferencePart
{
public:
  /**
   * Leaves of the reference and its cavity that a volume carries the voxels that a box needs. They
   * are not copied, and in the same arrays as in the last call if they are the same, so that a card
   * keeps them.
   *
   * @param volume  changed: its field data
   * @param box     of the deformed frame (mm, world), with what is read beside it
   * @param haloMm  how much more is taken, so that a reference that moves needs no other voxels
   */
  void cut(vtkImageData* volume, const Box& box, double haloMm);

private:
  struct Piece
  {
    const vtkDataArray* whole = nullptr; // that this is a piece of, as of `time`
    vtkMTimeType time = 0;               // unique among all objects
    Extent extent{ 0, -1, 0, -1, 0, -1 };
    vtkSmartPointer<vtkDataArray> voxels;

    // Returns the first point that is left.
    glm::ivec3 cut(PlacedVoxels& placed, const Box& box, double haloMm);
  };

  Piece Voxels;
  Piece Cavity;
};
}

#endif
