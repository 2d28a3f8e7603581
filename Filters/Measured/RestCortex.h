// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The cortex at rest as a fit asks for it: the nearest point and the normal there.
 *
 * Normals are those of the surface smoothed over a few voxels: the triangles of a mask are steps.
 */
#ifndef BrainShift_RestCortex_h
#define BrainShift_RestCortex_h

#include "Filters/Fit/Measurements.h"
#include "Filters/Traces/TissueSurface.h"
#include "Filters/Traces/TriangleTree.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkSmartPointer.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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
  void findNormals(const TissueRegion& tissue);

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

  /** Finds it. Returns one sentence, without a full stop, if there is none. */
  std::string find(const Request& request);

  /** Without a cortex it is empty. */
  const RestCortex& cortex() const { return this->Cortex; }

  /** Counts the cortices that were found: another number is another cortex. */
  std::uint64_t version() const { return this->Version; }

private:
  RestCortex Cortex;
  std::uint64_t Version = 0;
  vtkSmartPointer<vtkDataArray> Scalars; // that the cortex was found in, as of ScalarsTime
  unsigned long long ScalarsTime = 0;
  Grid ScalarsGrid;
  bool IsLabel = false;
  double Level = 0.0;
};
}

#endif
