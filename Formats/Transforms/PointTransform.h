// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What registration programs store: a chain of maps of points, from the fixed image to the moving
/// one.
///
/// ITK, ANTs and elastix map points of LPS. After reverseXY the chain maps points of RAS.
#ifndef BrainShift_PointTransform_h
#define BrainShift_PointTransform_h

#include "Common/FieldDirection.h"
#include "Common/Grid.h"
#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace brainshift
{
/** to = linear * from + offset; mm. */
struct AffineLink
{
  glm::dmat3 linear{ 1.0 };
  glm::dvec3 offset{ 0.0 };
};

/** Where the numbers of a link lie. Its axes need not be a rotation. */
struct LinkGrid
{
  glm::ivec3 dimensions{ 0 };      ///< points along each axis
  glm::dvec3 origin{ 0.0 };        ///< mm, of point (0, 0, 0)
  glm::dmat3 worldFromGrid{ 1.0 }; ///< columns: the steps between neighbours, mm
  glm::dmat3 gridFromWorld{ 1.0 }; ///< its inverse

  /** Grid coordinates of a position (mm). */
  glm::dvec3 at(const glm::dvec3& world) const
  {
    return this->gridFromWorld * (world - this->origin);
  }

  /** Number of points. */
  std::size_t count() const
  {
    return static_cast<std::size_t>(this->dimensions.x) * this->dimensions.y * this->dimensions.z;
  }
};

/**
 * ITK's BSplineTransform of order 3: to = base(from) + uniform cubic B-splines. One cell inside the
 * outermost coefficients the splines end; beyond, only the base counts. Slicer's fade instead, to
 * zero two cells outside of them.
 */
struct SplineLink
{
  LinkGrid grid;
  std::vector<glm::dvec3> coefficients; ///< mm, one for each point, x fastest
  AffineLink base;    ///< the bulk of ITK 3, or FNIRT's affine map; default: the identity
  bool fades = false; ///< whether those outside of the grid count as 0: Slicer, FNIRT
};

/** How displacements between the points of a field are found. */
enum class Between
{
  Linear,
  Nearest, ///< elastix with interpolation order 0
  Cubic,   ///< the MNI's: Catmull-Rom; linear within a cell of the edge; outside it the nearest
  Held,    ///< Slicer's: Catmull-Rom, quadratic in the outermost cells; outside, that of the edge
};

/** ITK's DisplacementFieldTransform: beyond half a cell outside its points, points stay, unless it
 * is Held. */
struct FieldLink
{
  LinkGrid grid;
  std::vector<glm::vec3> displacements; ///< mm, one for each point, x fastest
  Between between = Between::Linear;
};

/** ITK's and Slicer's thin plates: to = base(from) + sum of weight * distance(from, source). */
struct ThinPlateLink
{
  std::vector<glm::dvec3> sources; ///< mm: the landmarks that points are mapped from
  std::vector<glm::dvec3> weights; ///< one for each source; no unit
  AffineLink base;
};

struct PointTransform;

/** The inverse of a chain, as a file names it by the map in the other direction. */
struct InverseLink
{
  std::shared_ptr<const PointTransform> of; ///< never null
};

using TransformLink = std::variant<AffineLink, SplineLink, FieldLink, ThinPlateLink, InverseLink>;

/** Maps in the order in which points pass through them. An empty chain is the identity. */
struct PointTransform
{
  std::vector<TransformLink> links;
  bool knowsSides = true; ///< false: RAS is a guess, as of an image that a link counts from
  std::vector<std::string> stories{}; ///< what each file says and leads to, one sentence each
};

/** The least determinant of a map that can be turned round. */
constexpr double SmallestVolume = 1e-9;

/** Solved positions that miss by more (mm) are told. */
constexpr double ToldMissMm = 1e-3;

/**
 * Where the chain takes a point (mm). NaN where a field has no number.
 *
 * @param missMm   how far the inverse of a link in it misses at most, if it is to be known
 */
VTKBRAINSHIFTFORMATS_EXPORT glm::dvec3 mapped(
  const PointTransform& transform, const glm::dvec3& from, double* missMm = nullptr);

/**
 * The point that the chain takes to `to`, to 1e-6 mm where the chain does not fold and does not
 * jump; elsewhere the best one that was found. NaN where points of a field without a number are in
 * the way.
 *
 * @param missMm   how far a link misses at most, if it is to be known
 */
VTKBRAINSHIFTFORMATS_EXPORT glm::dvec3 mappedBack(
  const PointTransform& transform, const glm::dvec3& to, double* missMm = nullptr);

/** Reverses x and y on both sides: this leads from LPS to RAS and back. */
VTKBRAINSHIFTFORMATS_EXPORT void reverseXY(PointTransform& transform);

/** Makes all fields of a chain that are Linear Held, and splines fade, as Slicer shows them. */
VTKBRAINSHIFTFORMATS_EXPORT void holdFields(PointTransform& transform);

/** A link for the inverse of a chain. */
VTKBRAINSHIFTFORMATS_EXPORT TransformLink inverseOf(PointTransform transform);

/**
 * A link through thin plates from landmarks to others, both in mm and one for one. Throws the end
 * of a sentence if the sources do not span a volume, or are too many.
 */
TransformLink throughLandmarks(
  const std::vector<glm::dvec3>& sources, const std::vector<glm::dvec3>& targets);

/** The chain as one affine map; none if a link bends. */
VTKBRAINSHIFTFORMATS_EXPORT std::optional<AffineLink> affineOf(const PointTransform& transform);

/**
 * "identity", "rigid", "affine" or "nonlinear". A rigid map turns, without a mirror and without a
 * stretch of 1e-4.
 */
VTKBRAINSHIFTFORMATS_EXPORT std::string kindOf(const PointTransform& transform);

/**
 * The points of the first link that has some, as a grid to sample the chain on: four samples in
 * each cell of a B-spline, fewer if they would be more than 256 along an axis. None without such a
 * link.
 */
VTKBRAINSHIFTFORMATS_EXPORT std::optional<Grid> ownGridOf(const PointTransform& transform);

/** A chain, and the direction in which it leads between the frames of a deformed volume. */
struct DirectedTransform
{
  PointTransform chain;
  Direction direction = Direction::Backward;

  /** Where the map of one of the two directions takes a point (mm). */
  glm::dvec3 towards(Direction wanted, const glm::dvec3& from) const
  {
    return wanted == this->direction ? mapped(this->chain, from) : mappedBack(this->chain, from);
  }
};
}

#endif
