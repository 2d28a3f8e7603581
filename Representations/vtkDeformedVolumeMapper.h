// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedVolumeMapper
 * @brief   ray casts a volume through the lattice it carries
 *
 * Draws a vtkImageData with the deformation that Free-Form Deformation attached to it (see
 * Filters/DeformableVolume.h), never resampling a voxel; a volume without a lattice is drawn as it
 * is. Colours, opacity, light and position come from the vtkVolume, as for any volume mapper.
 *
 * Where the GPU cannot draw it, the reason is reported once and VTK's software mapper draws the volume
 * undeformed.
 *
 * Method: van der Steen et al., SPIE 7169 (2009), section 2; ARCHITECTURE.md says what differs.
 */
#ifndef vtkDeformedVolumeMapper_h
#define vtkDeformedVolumeMapper_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkVolumeMapper.h"

#include <glm/vec2.hpp> // for sizes in pixels

#include <memory> // for the private part
#include <string> // for messages

class vtkDataArray;
class vtkImageData;
class vtkOpenGLRenderWindow;
class vtkVolumeProperty;
namespace brainshift
{
struct Counters;
struct Grid;
struct RayCastScene;
struct ValueLayout;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkDeformedVolumeMapper : public vtkVolumeMapper
{
public:
  static vtkDeformedVolumeMapper* New();
  vtkTypeMacro(vtkDeformedVolumeMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Step along the ray, mm. 0 (default): half the smallest voxel side. */
  vtkSetClampMacro(SampleDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SampleDistance, double);
  ///@}

  ///@{
  /** Leap over what cannot be seen. The picture is the same bit for bit. Default true. */
  vtkSetMacro(EmptySpaceSkipping, bool);
  vtkGetMacro(EmptySpaceSkipping, bool);
  ///@}

  enum NormalTextureType
  {
    HalfResolution = 0, // the paper's choice: an eighth of the memory, softer light
    FullResolution = 1,
    OnTheFly = 2, // no texture: six more reads for each lit sample
  };

  ///@{
  /** Where the gradients that light needs come from. Default full resolution. */
  vtkSetClampMacro(NormalTexture, int, HalfResolution, OnTheFly);
  vtkGetMacro(NormalTexture, int);
  ///@}

  ///@{
  /**
   * Draw fewer pixels while the window asks for interactive rates, as many as hold the rate; the
   * still picture has them all. Default true.
   */
  vtkSetMacro(AdaptiveQuality, bool);
  vtkGetMacro(AdaptiveQuality, bool);
  ///@}

  /**
   * Tissue position (mm, world, deformed frame) that the last picture shows at a pixel counted from
   * the renderer's lower left corner, without drawing again: where the opacity along the ray reaches
   * one half. False where it does not.
   */
  bool Pick(vtkRenderer* renderer, int x, int y, double position[3]);

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  ///@{
  /** Box that the deformed volume can reach, mm. */
  using vtkVolumeMapper::GetBounds;
  double* GetBounds() VTK_SIZEHINT(6) override;
  ///@}

  /** What was done since the mapper was made, and what it holds on the GPU now. */
  const brainshift::Counters& GetCounters();

protected:
  vtkDeformedVolumeMapper();
  ~vtkDeformedVolumeMapper() override;

private:
  vtkDeformedVolumeMapper(const vtkDeformedVolumeMapper&) = delete;
  void operator=(const vtkDeformedVolumeMapper&) = delete;

  // Draws deformed. False, with one sentence in `problem`, if this GPU cannot.
  bool Draw(vtkRenderer* renderer, vtkVolume* volume, std::string& problem);
  void DrawUndeformed(vtkRenderer* renderer, vtkVolume* volume, const std::string& problem);

  void AskTheGpu();
  int ImageScale(vtkOpenGLRenderWindow* window, const glm::ivec2& size) const;
  void UpdateDeformation(vtkImageData* image);
  bool PrepareTissue(vtkOpenGLRenderWindow* window, vtkVolumeProperty* property,
    vtkDataArray* scalars, const brainshift::Grid& grid, const brainshift::ValueLayout& layout,
    brainshift::RayCastScene& scene, std::string& problem);
  void UpdateVisibility(vtkOpenGLRenderWindow* window);
  bool PrepareSpace(vtkOpenGLRenderWindow* window, const brainshift::Grid& grid,
    const brainshift::ValueLayout& layout, brainshift::RayCastScene& scene, std::string& problem);
  void DescribeView(vtkRenderer* renderer, vtkVolume* volume, const brainshift::Grid& grid,
    const brainshift::ValueLayout& layout, brainshift::RayCastScene& scene);

  double SampleDistance = 0.0;
  bool EmptySpaceSkipping = true;
  int NormalTexture = FullResolution;
  bool AdaptiveQuality = true;

  struct State; // textures, programs and what they were made from
  std::unique_ptr<State> Internal;
};

#endif
