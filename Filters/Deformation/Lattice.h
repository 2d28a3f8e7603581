// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The control points of a free-form deformation, the strokes that move them, and the cubic between
/// them.
///
/// Method: van der Steen et al., SPIE 7169 (2009), section 2: a lattice that drives a free-form
/// deformation, control points moved one by one, as a group within a radius, or by an ellipsoid.
/// Free-form deformation: Sederberg and Parry, "Free-form deformation of solid geometric models",
/// SIGGRAPH 1986; with cubic B-splines: Rueckert et al., "Nonrigid registration using free-form
/// deformations", IEEE Transactions on Medical Imaging 18 (1999).
#ifndef BrainShift_Lattice_h
#define BrainShift_Lattice_h

#include "Common/Grid.h"
#include "Filters/Deformation/Stroke.h"

#include <memory>
#include <string>

namespace brainshift
{
/** Fewest control points along an axis: a cubic kernel spans four of them. */
constexpr int SmallestLatticeSide = 4;

/** Most control points along an axis: 257^3 hold 200 MB of numbers. More is a dense field. */
constexpr int LargestLatticeSide = 257;

/**
 * Longest displacement of a control point, in cells of the axis with the smallest spacing. Within
 * it, positions fit single precision and numbers of nodes fit an integer.
 */
constexpr double LongestDisplacementCells = 10000.0;

/** The fraction of the displacement that holds at each node of a refined field: MaskWeights.h. */
struct NodeWeights
{
  int perCell = 1;           ///< nodes for each lattice cell along an axis
  std::vector<float> values; ///< 0 to 1, one for each node, x fastest
};

/** Control points and how far each of them is moved. */
struct Lattice
{
  Grid grid;      ///< control points over the volume's box, rest frame
  int kernel = 0; ///< KernelCatmullRom or KernelBSpline, see Kernels.h

  /** mm, world axes; one for each control point, x fastest. Zero: the point stays. */
  std::vector<glm::vec3> displacements;

  /**
   * Null: the cubic between the control points is the whole deformation. Otherwise deformedFromRest
   * is the refined field times these weights, trilinear between its nodes.
   */
  std::shared_ptr<const NodeWeights> mask;
};

/** Whether two masks have equal weights. Two masks that are null are equal. */
BRAINSHIFT_DEFORMATION_EXPORT bool sameMask(
  const std::shared_ptr<const NodeWeights>& a, const std::shared_ptr<const NodeWeights>& b);

/** A lattice whose displacements are all zero. */
BRAINSHIFT_DEFORMATION_EXPORT Lattice makeLattice(const Grid& grid, int kernel);

/** Throws a Problem if a side has fewer or more control points than a lattice may have. */
BRAINSHIFT_DEFORMATION_EXPORT void requireLatticeSides(const glm::ivec3& sides);

/**
 * Throws a Problem if a displacement is no number or longer than LongestDisplacementCells.
 *
 * @param cause   what displaces, as the end of "... is displaced by"
 */
BRAINSHIFT_DEFORMATION_EXPORT void requireDisplacements(
  const Lattice& lattice, const std::string& cause);

/**
 * Turns values at the control points into the coefficients of a uniform cubic B-spline that has
 * these values there. Beyond the ends the value of the end holds.
 *
 * Source: Unser, Aldroubi and Eden, "B-spline signal processing: part II", IEEE Transactions on
 * Signal Processing 41 (1993): the direct B-spline transform, here with other ends.
 */
BRAINSHIFT_DEFORMATION_EXPORT void toBSplineCoefficients(
  const Grid& grid, std::vector<glm::dvec3>& values);

/**
 * Moves the control points that a stroke reaches. The weights depend on where the lattice was
 * before, and never on the stroke's vector. A disabled stroke changes nothing.
 *
 * Soft lengthens the vector of its control points, at most fivefold, so that without a mask the
 * tissue at the anchor moves by the stroke's vector. The radius must hold enough control points.
 */
BRAINSHIFT_DEFORMATION_EXPORT void applyStroke(Lattice& lattice, const Stroke& stroke);

/** The displacement (mm, world axes) of the tissue at one rest position (mm, world). */
BRAINSHIFT_DEFORMATION_EXPORT glm::dvec3 displacementOfTissue(
  const Lattice& lattice, const glm::dvec3& rest);

/** The rest position (mm, world) of the tissue that one deformed position (mm, world) shows. */
BRAINSHIFT_DEFORMATION_EXPORT glm::dvec3 tissueAt(
  const Lattice& lattice, const glm::dvec3& deformed);

/**
 * How far (mm) a stroke has taken the tissue at its anchor along its vector. 0 for a disabled
 * stroke. The length of the vector was asked for; a coarse lattice, the fold guard and a mask leave
 * less of it. For Move, the tissue is that at the control point in the rest frame.
 *
 * @param before   the lattice that the stroke was applied to
 * @param after    the same lattice with the stroke
 */
BRAINSHIFT_DEFORMATION_EXPORT double achievedDisplacement(
  const Lattice& before, const Lattice& after, const Stroke& stroke);

/**
 * The displacements of all control points, counted in lattice cells along the lattice's own axes.
 * Maps and shaders compute with these, because positions and displacements then share one unit.
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<glm::vec3> displacementsInCells(const Lattice& lattice);

/**
 * Displacement at a position, from the 64 control points around it. Outside the lattice the value
 * at the nearest point of the lattice holds.
 *
 * @param dimensions      control points along each axis
 * @param displacements   one for each control point, in any unit; the result has that unit
 * @param position        lattice coordinates: cells from the first control point
 */
BRAINSHIFT_DEFORMATION_EXPORT glm::vec3 cubicDisplacement(const glm::ivec3& dimensions, int kernel,
  const glm::vec3* displacements, const glm::dvec3& position);

/**
 * Derivatives of cubicDisplacement: column a is the derivative along lattice axis a. A column is 0
 * if the position lies outside the lattice along that axis.
 */
BRAINSHIFT_DEFORMATION_EXPORT glm::mat3 cubicGradient(const glm::ivec3& dimensions, int kernel,
  const glm::vec3* displacements, const glm::dvec3& position);

/** A displacement and its derivatives at one position. */
struct CubicValue
{
  glm::vec3 displacement;
  glm::mat3 gradient;
};

/**
 * cubicDisplacement and cubicGradient at once, in a third of their time.
 *
 * @param displacements   as above; the fourth number of each is not read, and lets the processor
 *                        add four numbers in one step
 */
BRAINSHIFT_DEFORMATION_EXPORT CubicValue cubicValue(const glm::ivec3& dimensions, int kernel,
  const glm::vec4* displacements, const glm::dvec3& position);
}

#endif
