// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   TracePoints
 * @brief   the prop of Trace Points: balls that the tissue of deformed volumes fades or hides
 *
 * Points are drawn after the volumes and compared with the first hits of their last pictures. So a
 * change of points or of their colours casts no ray. In a view without a deformed volume, points
 * are drawn together with the surfaces. Positions, colours and selections are those of the prop's
 * mapper, a vtkPointGaussianMapper. Its scale factor is the radius (mm). If it is 0, the radius is
 * a hundredth of the points' box, and 4 pixels at least.
 */
#ifndef BrainShift_TracePoints_h
#define BrainShift_TracePoints_h

#include "Representations/Scene/OverVolumes.h"

#include <memory>
#include <vector>

class vtkRenderer;
class vtkWindow;

namespace brainshift
{
struct FirstHits;
class HitSource;

class TracePoints : public OverVolumes
{
public:
  static TracePoints* New();
  vtkTypeMacro(TracePoints, OverVolumes);

  /// Fraction of the opacity that points behind tissue keep, 0 to 1.
  double HiddenOpacity = 1.0;

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderOverlay(vtkViewport* viewport) override;
  int RenderTranslucentPolygonalGeometry(vtkViewport*) override { return 0; }
  vtkTypeBool HasTranslucentPolygonalGeometry() override { return 0; }
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  TracePoints();
  ~TracePoints() override;

private:
  struct Device; // of one window
  struct State;

  bool Draw(vtkRenderer* renderer, const std::vector<HitSource*>& volumes);
  std::vector<const FirstHits*> HitsOf(const std::vector<HitSource*>& volumes, vtkWindow* window);
  int DrawSelection(vtkRenderer* renderer);
  double SuitableRadiusIn(vtkRenderer* renderer);
  vtkMTimeType LookTime();

  std::unique_ptr<State> Internal;
};
}

#endif
