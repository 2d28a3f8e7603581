// SPDX-License-Identifier: BSD-3-Clause
// Tells a tool what lies under the cursor in a view of a Free-Form Deformation: tissue, control
// points, and how pixels and millimetres lie to each other. Asked of the server, so that it holds
// wherever data and picture are. Positions: mm, world, deformed frame; pixels from the view's lower
// left corner.
#ifndef BrainShift_ViewProbe_h
#define BrainShift_ViewProbe_h

#include "Grid.h"
#include "LatticeShapes.h"

#include <pqDataRepresentation.h>
#include <vtkSmartPointer.h>

#include <QPointer>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

class pqPipelineSource;
class pqRenderView;
class vtkRenderer;
class vtkSMProxy;

class ViewProbe
{
public:
  ViewProbe(pqPipelineSource* deformation, pqRenderView* view);
  ~ViewProbe();

  // Where the picture drawn last shows tissue; nothing is drawn. None where it shows none, or the
  // volume is not shown as Deformed Volume.
  std::optional<glm::dvec3> tissueAt(const glm::dvec2& pixel);

  // Control points within `radius` mm of a position, and those that moved.
  std::vector<brainshift::Handle> handlesNear(const glm::dvec3& position, double radius);
  // Control points within `pixels` of what lies under a pixel, and those that moved.
  std::vector<brainshift::Handle> handlesUnder(const glm::dvec2& pixel, double pixels);

  // The control points' grid, rest frame; none before the filter was applied.
  std::optional<brainshift::Grid> lattice();
  double strength() const;

  // Property of the filter; the middle of the volume where the filter has none.
  glm::dvec3 pointOfInterest();
  void setPointOfInterest(const glm::dvec3& position); // one undo step

  // Eye to scene, in the plane through `depth` that is parallel to the screen.
  glm::dvec3 positionAt(const glm::dvec2& pixel, const glm::dvec3& depth) const;
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
  pqDataRepresentation* shownAs() const; // null unless as Deformed Volume
  // While a tool is in hand, only what lies over the picture changes from event to event.
  void keepPictureOf(pqDataRepresentation* shown);
  std::vector<brainshift::Handle> ask();

  QPointer<pqPipelineSource> Deformation;
  QPointer<pqRenderView> View;
  QPointer<pqDataRepresentation> Kept; // whose picture is kept
  vtkSmartPointer<vtkSMProxy> Picture; // DeformedVolumeReport
  vtkSmartPointer<vtkSMProxy> Points;  // LatticeReport
};

#endif
