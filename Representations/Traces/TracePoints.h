// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   TracePoints
 * @brief   the prop of Trace Points: balls that the tissue of deformed volumes fades or hides
 *
 * Drawn after the volumes and compared with the first hits of their last pictures, so that neither
 * points nor their colours make a volume be cast again. Where no deformed volume is shown they are
 * drawn when surfaces are. Positions, colours and selections are those of the prop's mapper, a
 * vtkPointGaussianMapper.
 */
#ifndef BrainShift_TracePoints_h
#define BrainShift_TracePoints_h

#include "vtkOpenGLActor.h"

#include <memory>
#include <vector>

class vtkDeformedVolumeMapper;
class vtkRenderer;

namespace brainshift
{
struct FirstHits;

class TracePoints : public vtkOpenGLActor
{
public:
  static TracePoints* New();
  vtkTypeMacro(TracePoints, vtkOpenGLActor);

  // Share of the opacity that is left of what lies behind tissue, 0 to 1.
  double HiddenOpacity = 1.0;

  // Whether a renderer shows any.
  static bool areShownIn(vtkRenderer* renderer);

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

  bool Draw(vtkRenderer* renderer, const std::vector<vtkDeformedVolumeMapper*>& volumes);
  std::vector<const FirstHits*> HitsOf(
    const std::vector<vtkDeformedVolumeMapper*>& volumes, vtkWindow* window);
  int DrawSelection(vtkRenderer* renderer);
  vtkMTimeType LookTime();

  std::unique_ptr<State> Internal;
};
}

#endif
