// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds the tissue under the contacts of grids: their positions at rest, on the cortex before it
/// moved, and the shift there. No VTK.
///
/// A contact was measured on the bent cortex. Where its tissue was at rest cannot be read off the
/// contact alone: the cortex may have slid under it. What is known: the tissue was on the cortex at
/// rest; the shift is smooth, a Gaussian process (Process.h), and 0 beyond the opening; and the
/// sheet bends easily but hardly stretches, so neighbours are the pitch apart along rows and
/// columns. It may shear, as a cloth on a ball does. Neighbouring parts of it stretch alike, so a
/// missing row is as long as those beside it. Unknown are, for each place of a sheet, the
/// bent position (3 numbers) and the position at rest on the surface (2 numbers). The sum of all
/// squares, each over its variance, is minimised by damped Gauss-Newton steps:
///
/// - measured contact minus bent position,
/// - distance of bent neighbours minus the pitch: the stiffness of the sheet, whose strain is a
///   smooth field and a little of each pair alone,
/// - distance of neighbours at rest minus the pitch: tissue under it is stretched little,
/// - bent position minus position at rest: the shift, by the covariance of the process.
///
/// Places without a contact have no first term; their positions are predictions. Contacts that
/// their neighbours contradict get less weight: one that floats does not lift the cortex.
///
/// The methods that it is compared with, and what it takes from them:
/// - nearest point of the cortex, as in many pipelines;
/// - Hermes et al., "Automated electrocorticographic electrode localization on individually
///   rendered brain surfaces", Journal of Neuroscience Methods 185 (2010): along the normal of the
///   grid;
/// - Dykstra et al., "Individualized localization and cortical surface-based registration of
///   intracranial electrodes", NeuroImage 59 (2012): displacements and changes of distances between
///   contacts as an energy, contacts on the surface as a constraint.
///
/// Here the shift is a field with a covariance and the sheet has a known pitch, so noise in the
/// contacts is averaged and missing ones are predicted.
#ifndef BrainShift_SheetFit_h
#define BrainShift_SheetFit_h

#include "Filters/Fit/Measurements.h"

namespace brainshift
{
/** The contacts of a grid as they were measured. */
struct Sheet
{
  int rows = 0;
  int columns = 0;
  double pitchMm = 0.0; ///< above 0
  /** rows * columns positions (mm, measured frame), row after row; none: the contact is missing. */
  std::vector<std::optional<glm::dvec3>> contacts;
};

/** Deviations are standard deviations. Lengths are mm, stretches are fractions of the pitch. */
struct SheetSettings
{
  /** Factor on the stiffness of the sheets, 0 to 100: 1 is silicone; 0: they stretch freely. */
  double stiffness = 1.0;
  double stretch = 0.02;         ///< of each pair of neighbours alone, along rows and columns
  double shear = 0.1;            ///< of each diagonal alone
  Matern strain{ 40.0, 0.05 };   ///< of the sheet, alike where it is near (mm along the flat sheet)
  double tissueStretch = 0.15;   ///< of the tissue under it: loosely, as tissue is no sheet
  double contactDeviation = 0.5; ///< of a measured contact along each axis
  double tissueDeviation = 0.2;  ///< of a contact from the smooth shift
  double anchorDeviation = 1.0;  ///< of cortex beyond the opening
  Matern kernel{ 60.0, 8.0 };    ///< of the shift: that of FitSettings::surfaceKernel
  double slide = 0.5; ///< deviation of the shift along the cortex, as a fraction of that across it
  int steps = 60;     ///< most Gauss-Newton steps
  double stepToleranceMm = 0.002;
};

/** What is known of a place of a sheet. */
struct SheetPlace
{
  glm::dvec3 rest{ 0.0 }; ///< mm, rest frame: on the cortex
  glm::dvec3 bent{ 0.0 }; ///< mm, measured frame: on the bent cortex, where rest came to be
  double deviation = 0.0; ///< mm: standard deviation of rest along each axis of the cortex
  /**
   * mm: how far the contact is outside of the bent cortex, negative if it is buried, as all other
   * contacts say. NaN for a missing one.
   */
  double outside = 0.0;
  double outsideDeviation = 0.0; ///< mm: what is expected of it
  /** mm: the measured contact from where all others predict it; NaN for a missing one. */
  double leftOut = 0.0;

  /** Whether the contact is not on the cortex. */
  bool isOff() const;
};

/** Most places of all sheets together. */
constexpr std::size_t MostSheetPlaces = 600;

/**
 * Finds the places of all sheets, in their order. Several sheets are solved together: all are on
 * one cortex.
 *
 * @param surface   the cortex at rest; its second argument is the number of a place
 * @param anchors   cortex beyond the opening
 *
 * Throws a Problem on a sheet without contacts or too many places, a setting out of its range, or
 * a cortex that has no point.
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<std::vector<SheetPlace>> fitSheets(
  const std::vector<Sheet>& sheets, const RestSurface& surface,
  const std::vector<SurfacePoint>& anchors, const SheetSettings& settings = {});

/** Positions of a sheet whose missing contacts are filled in smoothly, without a cortex. */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<glm::dvec3> filledSheet(const Sheet& sheet);
}

#endif
