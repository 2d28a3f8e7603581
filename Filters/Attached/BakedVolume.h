// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A part of a bent volume that is made block by block, from inputs that hold the tissue of a block
/// each. The numbers are those of a bake of the whole volume, bit for bit.
#ifndef BrainShift_BakedVolume_h
#define BrainShift_BakedVolume_h

#include "Common/SharedVolume.h"
#include "Filters/Attached/Resample.h"

#include "vtkSmartPointer.h"

#include <optional>
#include <vector>

class vtkDataArray;
class vtkDataSetAttributes;
class vtkImageData;

namespace brainshift
{
/** The lowest value of each component of the arrays of points and of cells, see lowestOf. */
struct LowestValues
{
  std::vector<std::vector<double>> points;
  std::vector<std::vector<double>> cells;

  /** Takes the values of a part, too. */
  void add(vtkImageData* part);
};

/** What a block needs beside what its input holds. */
struct LackingBlock
{
  std::optional<Extent> extent; ///< points; together with those that are held
  bool lowest = false;          ///< the lowest values of the whole volume
  bool stopped = false;
};

/** A part of the deformed frame. */
class BakedVolume
{
public:
  /**
   * @param volume    all of it
   * @param asked     the part
   */
  BakedVolume(const WholeVolume& volume, const Grid& lattice, const BackwardMap& backward,
    const Extent& asked)
    : Volume(volume)
    , Lattice(lattice)
    , Backward(backward)
    , Asked(asked)
  {
  }

  /**
   * The voxels of the volume that a block needs, as far as the lattice bounds it.
   *
   * @param block   within what is asked for
   */
  static Extent restOf(
    const WholeVolume& volume, const brainshift::Lattice& lattice, const Extent& block);

  /**
   * Bakes a block. If something lacks, the block is not right: bake it again with that.
   *
   * @param input    has the block's own points, and those around them where its tissue rests
   * @param lowest   of the whole volume; null: not known
   */
  LackingBlock bake(vtkImageData* input, const Extent& block, const LowestValues* lowest,
    Reading reading, const std::function<bool(double)>& proceed);

  /** Gives the arrays of all blocks to an image. */
  void giveTo(vtkImageData* image) const;

private:
  struct Arrays
  {
    std::vector<vtkSmartPointer<vtkDataArray>> all; ///< null for those that are not numbers
    std::string scalars;                            ///< the name of the active ones
    bool isMade = false;
  };

  ResampleGeometry geometryOf(const Extent& held, const Extent& block, bool cells) const;
  void make(vtkDataSetAttributes* from, bool cells, Arrays& arrays) const;

  WholeVolume Volume;
  Grid Lattice;
  const BackwardMap& Backward;
  Extent Asked;
  Arrays Points;
  Arrays Cells;
};
}

#endif
