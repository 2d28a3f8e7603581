// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds tissue and control points under the cursor in a view of a Free-Form Deformation. It also
/// converts between pixels and millimetres. The server computes the results, so it works
/// wherever data and picture are. Positions: mm, world axes, deformed frame. Pixels: from the lower
/// left corner of the view.
#ifndef BrainShift_ViewProbe_h
#define BrainShift_ViewProbe_h

#include "Common/Grid.h"
#include "Widgets/LatticeShapes.h"

#include <vtkSmartPointer.h>

#include <QPointer>

#include <optional>

class pqPipelineSource;
class pqRenderView;
class vtkRenderer;
class vtkSMProxy;

namespace brainshift
{
/// Finds control points of a Free-Form Deformation. The server computes the results, so it works
/// wherever the data is. Positions: mm, world axes.
class LatticeProbe
{
public:
  explicit LatticeProbe(vtkSMProxy* deformation);

  /// The grid of the control points in the rest frame. None before the filter was applied.
  std::optional<Grid> lattice() const;

  /// Limits a search to a layer around a plane. Without a plane there is no limit.
  struct Plane
  {
    glm::dvec3 point{ 0.0 };
    glm::dvec3 normal{ 0.0 };   ///< Unit length.
    double halfThickness = 0.0; ///< mm. 0: there is no plane.
  };
  /// Control points drawn within `radius` (mm) of a position, and moved ones within `movedRadius`.
  std::vector<ControlPoint> around(
    const glm::dvec3& position, double radius, double movedRadius, const Plane& plane);

  /// Positions around a ray.
  struct Cone
  {
    glm::dvec3 apex{ 0.0 };
    glm::dvec3 direction{ 0.0 }; ///< Unit length.
    double radius = 0.0;         ///< mm, at the apex.
    double growth = 0.0;         ///< Of the radius, mm per mm.
  };
  /// Control points drawn within a cone.
  std::vector<ControlPoint> within(const Cone& cone);

  /// Rest positions of drawn tissue or, if not `toRest`, drawn positions of tissue at rest.
  /// Empty before the filter was applied.
  std::vector<glm::dvec3> sameTissue(const std::vector<glm::dvec3>& positions, bool toRest);

private:
  std::vector<ControlPoint> fetch();

  vtkSmartPointer<vtkSMProxy> Report;
};

/// The point that the stamp aims at (mm, world axes): the property PointOfInterest of a Free-Form
/// Deformation, or the centre of its volume if the property is 0 0 0 and that is outside.
glm::dvec3 pointOfInterestOf(vtkSMProxy* deformation);

class KeptPictures;

/// Tissue under the cursor.
struct Spot
{
  glm::dvec3 position{ 0.0 };
  std::optional<glm::dvec3> slice; ///< Unit normal of its slice. None in a volume.
};

class ViewProbe
{
public:
  /// `kept` outlives the probe.
  ViewProbe(pqPipelineSource* deformation, pqRenderView* view, KeptPictures& kept);

  /// Whether the view shows the volume as Deformed Volume or Deformed Slices, where it is.
  bool works() const;

  /// The tissue that the last picture shows at a pixel. Draws nothing. None where the picture shows
  /// no tissue, and unless works().
  std::optional<Spot> spotAt(const glm::dvec2& pixel);

  /// Control points within `radius` (mm) of a spot, and moved ones within `movedRadius`. In a
  /// slice, only those near the slice.
  std::vector<ControlPoint> controlPointsNear(const Spot& spot, double radius, double movedRadius);
  /// Control points within `pixels` of the line of sight through a pixel. None in views of slices,
  /// and unless works().
  std::vector<ControlPoint> controlPointsUnder(const glm::dvec2& pixel, double pixels);

  /// Rest position of tissue from its drawn position. None before the filter was applied.
  std::optional<glm::dvec3> restOf(const glm::dvec3& position);
  /// Where tissue at rest is drawn. As many as `rest`, or none before the filter was applied.
  std::vector<glm::dvec3> drawnAt(const std::vector<glm::dvec3>& rest);

  /// The grid of the control points in the rest frame. None before the filter was applied.
  std::optional<Grid> lattice();
  /// The property Strength of the filter.
  double strength() const;

  /// That of the filter: pointOfInterestOf.
  glm::dvec3 pointOfInterest();

  /// The direction of view, unit length.
  glm::dvec3 ahead() const;
  /// Where the line of sight through a pixel meets the plane through `depth` with this normal.
  glm::dvec3 positionAt(
    const glm::dvec2& pixel, const glm::dvec3& depth, const glm::dvec3& normal) const;
  glm::dvec2 pixelOf(const glm::dvec3& position) const;
  double millimetresPerPixel(const glm::dvec3& position) const;
  /// See Common/ScreenScale.h.
  double screenScale() const;
  struct Ray
  {
    glm::dvec3 origin;
    glm::dvec3 direction; ///< Unit length.
  };
  Ray rayAt(const glm::dvec2& pixel) const;

private:
  vtkRenderer* renderer() const;

  QPointer<pqPipelineSource> Deformation;
  QPointer<pqRenderView> View;
  KeptPictures& Kept;
  vtkSmartPointer<vtkSMProxy> Picture; ///< A DeformedVolumeReport.
  LatticeProbe Points;
};
}

#endif
