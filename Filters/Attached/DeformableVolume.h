// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The contract between the Free-Form Deformation filter and all that draws, bakes or exports a
/// deformation, and its two maps.
///
/// A deformable volume is a vtkImageData, unchanged, with these field-data arrays:
///
///    FFDDisplacements  float32 x 3, nx*ny*nz tuples, x fastest: displacement of each control point
///                      (mm, world axes, before Strength). Zero: the point stays.
///    FFDDimensions     int x 3: nx ny nz, 4 to 257 each
///    FFDBox            double x 15: world position of the first control point (mm), spacing (mm),
///                      direction matrix (row by row, as vtkImageData holds it)
///    FFDKernel         int: 0 Catmull-Rom, 1 B-spline
///    FFDSamples        int: nodes of the refined field between two control points, 0 to 16
///    FFDInverse        int: 0 exact, 1 negated
///    FFDStrength       double, 0 to 1: factor on all displacements
///    FFDMaskWeights    float32, only with a mask: fraction of the displacement, 0 to 1, at each
///                      node of the refined field, (points - 1) * (FFDSamples + 1) + 1 along each
///                      axis, x fastest; the field is trilinear between the nodes
///    FFDDeviations     float32, only of a fit with Evidence: the uncertainty of the position of
///                      each control point, nx*ny*nz tuples, mm, one standard deviation along an
///                      axis; 0 or more, infinity where nothing was measured; trilinear in between
#ifndef BrainShift_DeformableVolume_h
#define BrainShift_DeformableVolume_h

#include "Common/FieldDirection.h"
#include "Filters/Deformation/PointMap.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <utility>

class vtkDataObject;
class vtkImageData;

namespace brainshift
{
/** Name of the array of the kernel. Images of control points have it, too (BaseLattice.h). */
constexpr const char* KernelName = "FFDKernel";

/** What the arrays hold. */
struct Deformation
{
  Lattice lattice; ///< before Strength
  /// Uncertainty of the position of each control point, as drawn: mm, one standard deviation along
  /// an axis, infinity where nothing was measured. Empty: not known.
  std::vector<float> deviations;
  int samples = 4;                  ///< nodes between two control points, 0 to 16
  Inverse inverse = Inverse::Exact; ///< how pictures find tissue
  double strength = 1.0;            ///< factor on all displacements, 0 to 1
};

/**
 * Attaches the arrays to a data set. Arrays of an earlier deformation are replaced. A displacement
 * field is a volume like any other from here on: its direction (FieldDirection.h) is removed.
 */
VTKBRAINSHIFTFILTERS_EXPORT void attach(vtkDataObject* volume, const Deformation& deformation);

/**
 * Whether a data set carries a deformation, well formed or not. False for null, and for a
 * displacement field (FieldDirection.h): a field is made from a deformation and is not bent by it.
 */
VTKBRAINSHIFTFILTERS_EXPORT bool carriesDeformation(vtkDataObject* volume);

/**
 * Reads what attach wrote. Throws a Problem if the data carries no deformation or if an array is
 * missing or wrong.
 */
VTKBRAINSHIFTFILTERS_EXPORT Deformation readDeformation(vtkDataObject* volume);

/** The lattice with Strength applied, as it is drawn. */
VTKBRAINSHIFTFILTERS_EXPORT Lattice effectiveLattice(const Deformation& deformation);

/** Whether a data set carries deviations. False for null. */
VTKBRAINSHIFTFILTERS_EXPORT bool carriesDeviations(vtkDataObject* volume);

/**
 * The deviation (mm) of tissue at a rest position (mm): trilinear between control points, that of
 * the nearest one outside the lattice. Infinity if a neighbour has it. There must be deviations.
 */
VTKBRAINSHIFTFILTERS_EXPORT double deviationAt(
  const Grid& lattice, const std::vector<float>& deviations, const glm::dvec3& rest);

/** The latest modification time of the attached arrays; 0 if there are none. */
VTKBRAINSHIFTFILTERS_EXPORT unsigned long long deformationTime(vtkDataObject* volume);

/** Bytes that the offset field of a lattice takes while it is computed. */
VTKBRAINSHIFTFILTERS_EXPORT double offsetFieldBytes(const Lattice& lattice, int samples);

/** Throws a Problem if the machine has too little memory for the offset field of a lattice. */
VTKBRAINSHIFTFILTERS_EXPORT void requireOffsetFieldMemory(const Lattice& lattice, int samples);

/** A map in one direction. Positions are mm along world axes. */
class VTKBRAINSHIFTFILTERS_EXPORT DirectedMap
{
public:
  /** `inverse`: how the map was made to find tissue; it decides the backward derivatives. */
  DirectedMap(PointMap map, Inverse inverse, Direction direction)
    : Map(std::move(map)) // a lattice can be large
    , Backward(inverse)
    , Towards(direction)
  {
  }

  /** Where the map takes a position. A position that is not finite stays as it is. */
  glm::dvec3 position(const glm::dvec3& from) const;

  /**
   * Derivatives of the map at `from`, which it takes to `to`: column a is d(to) / d(from_a). They
   * are not finite where a backward map meets tissue whose volume the deformation makes zero.
   */
  glm::dmat3 jacobian(const glm::dvec3& from, const glm::dvec3& to) const;

private:
  PointMap Map;
  Inverse Backward;
  Direction Towards;
};

/**
 * The normal of a surface after a map with these derivatives. It is perpendicular to the mapped
 * surface and as long as it was. If the map leaves no direction for it, the normal stays.
 */
VTKBRAINSHIFTFILTERS_EXPORT glm::dvec3 turnedNormal(
  const glm::dmat3& jacobian, const glm::dvec3& normal);

/** The map of a deformable volume. Throws a Problem if the data is none. */
VTKBRAINSHIFTFILTERS_EXPORT DirectedMap directedMapOf(vtkDataObject* volume, Direction direction);
}

#endif
