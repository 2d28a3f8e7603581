// SPDX-License-Identifier: BSD-3-Clause
// Tells a tool what lies under the cursor in a view of a Free-Form Deformation: tissue, control
// points, and how pixels and millimetres lie to each other. Asked of the server, so that it holds
// wherever data and picture are. Positions: mm, world, deformed frame; pixels from the view's lower
// left corner.
#ifndef BrainShift_ViewProbe_h
#define BrainShift_ViewProbe_h

#include "LatticeProbe.h"

#include <vtkSmartPointer.h>

#include <QPointer>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

class KeptPictures;
class pqPipelineSource;
class pqRenderView;
class vtkRenderer;
class vtkSMProxy;

// Tissue under the cursor.
struct Spot
{
  glm::dvec3 position{ 0.0 };
  std::optional<glm::dvec3> slice; // unit normal of the slice that shows it; none in a volume
};

class ViewProbe
{
public:
  // `kept` outlives it.
  ViewProbe(pqPipelineSource* deformation, pqRenderView* view, KeptPictures& kept);

  // Where the picture drawn last shows tissue; nothing is drawn. None where it shows none, or the
  // volume is shown neither as Deformed Volume nor as Deformed Slices.
  std::optional<Spot> spotAt(const glm::dvec2& pixel);

  // Control points within `radius` mm of a spot, and those that moved within `movedRadius`; in a
  // slice, only what lies near the slice.
  std::vector<brainshift::Handle> handlesNear(const Spot& spot, double radius, double movedRadius);
  // Control points within `pixels` of what lies under a pixel; none beside slices.
  std::vector<brainshift::Handle> handlesUnder(const glm::dvec2& pixel, double pixels);

  // The control points' grid, rest frame; none before the filter was applied.
  std::optional<brainshift::Grid> lattice();
  double strength() const;

  // Property of the filter; the middle of the volume where the filter has none.
  glm::dvec3 pointOfInterest();
  void setPointOfInterest(const glm::dvec3& position); // one undo step

  // Where the camera looks: unit.
  glm::dvec3 ahead() const;
  // Eye to scene, in the plane through `depth` across `normal`.
  glm::dvec3 positionAt(
    const glm::dvec2& pixel, const glm::dvec3& depth, const glm::dvec3& normal) const;
  glm::dvec2 pixelOf(const glm::dvec3& position) const;
  double millimetresPerPixel(const glm::dvec3& position) const;
  struct Ray
  {
    glm::dvec3 origin;
    glm::dvec3 direction; // unit
  };
  Ray rayAt(const glm::dvec2& pixel) const;

private:
  vtkRenderer* renderer() const;

  QPointer<pqPipelineSource> Deformation;
  QPointer<pqRenderView> View;
  KeptPictures& Kept;
  vtkSmartPointer<vtkSMProxy> Picture; // DeformedVolumeReport
  LatticeProbe Points;
};

#endif
