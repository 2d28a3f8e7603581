// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Measured points and masks as data sets hold them, and the pairs of landmarks of a fit.
#ifndef BrainShift_MeasuredPoints_h
#define BrainShift_MeasuredPoints_h

#include "Filters/Deformation/MaskWeights.h"
#include "Filters/Fit/FittedLattice.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h" // for what a function returns
#include "vtkStringArray.h"

class vtkInformation;
class vtkPointSet;

namespace brainshift
{
/** Positions (mm, world) of all points; none without points. */
std::vector<glm::dvec3> positionsOf(vtkPointSet* points);

/** Pairs of landmarks, and what they are called. */
struct NamedPairs
{
  std::vector<PointPair> pairs;
  std::vector<std::string> names; ///< as many as pairs
  std::string unmatched;          ///< those without a partner, with commas between; at most ten
  std::string repeated;           ///< names that a list has more than once, likewise
};

/** How landmarks find their partners. */
struct PairingRule
{
  bool byOrder = false; ///< whether names do not count
  ///@{
  /** Names of landmarks whose data set has none. */
  std::vector<std::string> restNames;
  std::vector<std::string> measuredNames;
  ///@}
};

/**
 * The pairs of landmarks at rest and measured: matchLandmarks with the point array Label. The point
 * array Weight of those at rest gives weights. Both may be null. A pair is called by its label at
 * rest, or by its number among those at rest, from 1 on.
 */
VTKBRAINSHIFTFILTERS_EXPORT NamedPairs landmarkPairs(
  vtkPointSet* rest, vtkPointSet* measured, const PairingRule& rule = {});

/**
 * Asks for the part of a point set that is this MPI rank's. Call it in RequestUpdateExtent. Most
 * sources of points know no parts: the first rank gets all, and keeps it for all who ask.
 *
 * @param points   pipeline information of an input; null does nothing
 */
void askForOwnPoints(vtkInformation* points);

/**
 * The points of all MPI ranks, in the order of the ranks, on each of them. If all ranks have the
 * same points, these are copies of each other and count once. All ranks must call it, or none.
 */
vtkSmartPointer<vtkPointSet> pointsOfAllRanks(vtkPointSet* own);

/** The space within a distance of a mask, beyond the mask's own image too. It takes no memory. */
class VTKBRAINSHIFTFILTERS_EXPORT NearMask
{
public:
  /** Keeps a reference to the mask. `byMm`: distance, 0 or more. */
  NearMask(const Mask& mask, double byMm);

  /** Whether the middle of a voxel that is inside lies within the distance of a position. */
  bool holds(const glm::dvec3& position) const;

private:
  const Mask& Voxels;
  double ByMm;
  glm::ivec3 First{ 0 };  // of the voxels that are inside
  glm::ivec3 Behind{ 0 }; // one more than the last of them; none are inside if both are equal
};

/**
 * What a Fit Deformation holds of landmarks besides its inputs, and what it reports about them. The
 * pairs of data sets come first, then those of a list of numbers. Some may be switched off.
 */
class FitLandmarks
{
public:
  static constexpr int NumbersPerPlace = 10;

  std::vector<double> Numbers;          ///< of the list: see vtkFitDeformation::AddLandmarkPair
  std::vector<std::string> SwitchedOff; ///< names of pairs of the data sets
  PairingRule Rule;
  vtkNew<vtkStringArray> Names; ///< as a server sends them, and so the next
  vtkNew<vtkDoubleArray> Places;

  /** Either data set may be null. The pairs of the list come last. */
  NamedPairs read(vtkPointSet* rest, vtkPointSet* measured);

  /** Writes Places: see vtkFitDeformation::GetLandmarkPlaces. Empty without a result. */
  void place(const FittedLattice& fitted, const std::vector<PointPair>& pairs);
};

/**
 * How far (mm) a fit without a pair misses it: Fit::leaveOneOut, and for a pair that is switched
 * off how far the fit misses it, before the fold guard and the mask change the bend. NaN if nothing
 * is known.
 */
std::vector<double> leaveOneOut(const FittedLattice& fitted, const std::vector<PointPair>& pairs);
}

#endif
