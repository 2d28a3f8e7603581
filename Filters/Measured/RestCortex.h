// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The cortex at rest as a fit requests it: the nearest point, the normal there, and the anchors
/// that hold it beside the opening.
///
/// Normals are those of the surface smoothed over a few voxels: the triangles of a mask are steps.
#ifndef BrainShift_RestCortex_h
#define BrainShift_RestCortex_h

#include "Filters/Fit/Anchors.h"
#include "Filters/Traces/TriangleTree.h"

#include <cstdint>

class vtkDataArray;
class vtkImageData;

namespace brainshift
{
/** Positions are mm, world, rest frame. */
class VTKBRAINSHIFTFILTERS_EXPORT RestCortex
{
public:
  RestCortex() = default;

  /** The surface of tissue. */
  explicit RestCortex(const TissueRegion& tissue);

  /**
   * A surface that was found elsewhere. Its normals point away from the middle of its points, as
   * most of them do.
   */
  explicit RestCortex(TriangleMesh mesh);

  /**
   * The same surface without the steps between voxels of a mask: points move towards their
   * neighbours and back, which does not shrink it. Source: Taubin, "A signal processing approach to
   * fair surface design", SIGGRAPH (1995).
   */
  RestCortex smoothed() const;

  bool isEmpty() const { return this->Mesh.triangles.empty(); }

  /**
   * The nearest point to a position. Nothing if the surface is empty.
   *
   * @param hint   any triangle, or below 0; it becomes the nearest one. A near one saves time.
   */
  std::optional<SurfacePoint> nearest(const glm::dvec3& rest, int& hint) const;

  /** Some points of the surface, about 3 mm apart. */
  const std::vector<SurfacePoint>& points() const { return this->Spread; }

private:
  void findNormals();
  void turnOutwards(int inwards);
  void spread();

  TriangleMesh Mesh;
  std::vector<glm::dvec3> Normals; // of the points, unit vectors out of the tissue
  std::vector<SurfacePoint> Spread;
  TriangleTree Tree;
};

/** Finds the cortex in images, and keeps it until something that it depends on changes. */
class VTKBRAINSHIFTFILTERS_EXPORT CortexSource
{
public:
  /** All that the cortex depends on. */
  struct Request
  {
    vtkImageData* image = nullptr;
    std::string where;          ///< what messages call the image
    std::string array;          ///< name of its array; empty: as scalarsOf() says
    bool mustHaveArray = false; ///< whether it is an error if there is none of this name
    bool isLabel = false; ///< whether tissue is where scalars equal the level, or are not below it
    double level = 0.0;   ///< a threshold or a label
  };

  /** Finds it. Throws a Problem if there is none. */
  void find(const Request& request);

  /** Without a cortex it is empty. */
  const RestCortex& cortex() const { return this->Cortex; }

  /** Counts the cortices that were found: another number is another cortex. */
  std::uint64_t version() const { return this->Version; }

private:
  RestCortex Cortex;
  std::uint64_t Version = 0;
  TissueSource Tissue; // that the cortex was found in
};

/**
 * Keeps the anchors of a fit as long as nothing changes that they depend on. Choosing takes a fifth
 * of the processor time of a live step beside traces, and a hand that pulls changes neither the
 * cortex nor the opening.
 */
class AnchorChoice
{
public:
  /** Whether a position (mm, rest frame) is too near to the opening. */
  using IsOpen = std::function<bool(const glm::dvec3&)>;

  /** Anchors on a cortex whose opening is a ball. */
  const std::vector<SurfacePoint>& beside(const OpeningBall& ball, const CortexSource& cortex);

  /**
   * Anchors on a cortex whose opening is a mask.
   *
   * @param maskTime    modification time of the mask's image: another one is another mask
   * @param makeIsOpen  reads the mask; it is called only if the anchors must be chosen
   */
  const std::vector<SurfacePoint>& beside(
    std::uint64_t maskTime, const std::function<IsOpen()>& makeIsOpen, const CortexSource& cortex);

private:
  struct Key
  {
    std::uint64_t cortex = 0;
    std::uint64_t maskTime = 0; // 0: the opening is the ball
    OpeningBall ball;

    bool operator==(const Key& other) const;
  };

  const std::vector<SurfacePoint>& find(
    const Key& key, const std::function<IsOpen()>& makeIsOpen, const CortexSource& cortex);

  std::optional<Key> Known;
  std::vector<SurfacePoint> Anchors;
};
}

#endif
