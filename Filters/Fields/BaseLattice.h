// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The base of a deformation or a fit: makes images of control points, reads such an image or a
/// displacement field on any grid into a lattice, and attaches to a fitted lattice the settings
/// that it was fitted for.
///
/// An image of control points has the field array FFDKernel, 0 or 1 as in DeformableVolume.h, or
/// AnyKernel: its displacements are the numbers that the kernel weighs. With the kernel B-spline
/// these are no displacements of tissue. An image without the array is a field, which tissue
/// follows.
///
/// Control points that were drawn with a mask do not hold it. The field array DrawnWith has the
/// numbers of FittedFor, by which a deformation with another mask is known.
///
/// The field array FittedFor holds 14 numbers: LatticeDimensions (3), Kernel, Samples, the first
/// and the last corner of the box (6, mm, world axes), and three sums of the mask's weights at the
/// nodes of the refined field (3): plain, and with two pseudo-random factors for each node. Without
/// a mask the sums are NaN. Older files have one string there, which is still read.
#ifndef BrainShift_BaseLattice_h
#define BrainShift_BaseLattice_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkImageData;

namespace brainshift
{
struct Lattice;

/** In place of a kernel: that of the lattice which takes the control points. */
constexpr int AnyKernel = -1;

/** Makes a forward image of control points, which names its kernel: the lattice's, or AnyKernel. */
VTKBRAINSHIFTFILTERS_EXPORT void setLattice(vtkImageData* image, const Lattice& lattice);

/**
 * Adds a forward field, or control points (mm, world axes), to a lattice, so that tissue at the
 * control points moves by what the base has there: a field between its points trilinearly, control
 * points by their kernel; outside the nearest value holds. Control points on the same grid and with
 * the same kernel are added as they are. Throws a Problem about a base that is wrong.
 *
 * @param base   null or without points: nothing is added
 */
VTKBRAINSHIFTFILTERS_EXPORT void addBase(Lattice& lattice, vtkImageData* base);

/**
 * The forward displacements of tissue (mm, world axes) at the points of an image: those of its
 * field, or those that its control points make.
 *
 * @param field   what fieldOf() finds
 */
VTKBRAINSHIFTFILTERS_EXPORT std::vector<glm::vec3> displacementsOfTissue(
  vtkImageData* image, vtkDataArray* field);

/** Attaches the array to a lattice. `samples`: nodes between two control points. */
VTKBRAINSHIFTFILTERS_EXPORT void attachFittedFor(
  vtkDataObject* image, const Lattice& lattice, int samples);

/**
 * Attaches to control points with which mask they are drawn; nothing without a mask.
 *
 * @param lattice   with its mask
 * @param samples   nodes between two control points
 */
VTKBRAINSHIFTFILTERS_EXPORT void attachDrawnWith(
  vtkDataObject* image, const Lattice& lattice, int samples);

/**
 * One sentence without a full stop if a base lattice was drawn with a mask that this deformation
 * does not have. Masks on other nodes are not compared: then only one that is missing is named.
 */
VTKBRAINSHIFTFILTERS_EXPORT std::string wordsOnDrawnWith(
  vtkDataObject* base, const Lattice& lattice, int samples);

/**
 * One sentence without a full stop if a base lattice was fitted for another deformation than this
 * one; empty if it was fitted for this one, or was not fitted.
 */
VTKBRAINSHIFTFILTERS_EXPORT std::string wordsOnFittedFor(
  vtkDataObject* base, const Lattice& lattice, int samples);
}

#endif
