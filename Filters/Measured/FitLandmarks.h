// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The pairs of landmarks of a fit: first those of data sets, then those of a list of
 *        numbers. Some may be switched off.
 */
#ifndef BrainShift_FitLandmarks_h
#define BrainShift_FitLandmarks_h

#include "Filters/Fit/FittedLattice.h"
#include "Filters/Fit/Measurements.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkPointSet;

namespace brainshift
{
/** What a Fit Deformation holds of landmarks besides its inputs, and what it tells about them. */
class FitLandmarks
{
public:
  static constexpr int NumbersPerPlace = 10;

  std::vector<double> Numbers;          ///< of the list: see vtkFitDeformation::AddLandmarkPair
  std::vector<std::string> SwitchedOff; ///< names of pairs of the data sets
  vtkNew<vtkStringArray> Names;         ///< as a server sends them, and so the next
  vtkNew<vtkDoubleArray> Places;

  /** Either data set may be null. `unmatched`: set to those without a partner. */
  std::vector<PointPair> read(vtkPointSet* rest, vtkPointSet* measured, std::string& unmatched);

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
