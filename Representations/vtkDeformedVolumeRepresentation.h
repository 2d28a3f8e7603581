// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedVolumeRepresentation
 * @brief   "Deformed Volume": ParaView's "Volume" with our ray caster
 *
 * Everything "Volume" does with data delivery, colour maps, opacity and transforms is inherited;
 * only the mapper differs, and the bounds told to the view are those of the deformed volume.
 */
#ifndef vtkDeformedVolumeRepresentation_h
#define vtkDeformedVolumeRepresentation_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkImageVolumeRepresentation.h"
#include "vtkWeakPointer.h" // for the renderer

#include <set>    // for what was told
#include <string> // for the counters' text

class vtkDeformedVolumeMapper;
class vtkRenderer;

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkDeformedVolumeRepresentation
  : public vtkImageVolumeRepresentation
{
public:
  static vtkDeformedVolumeRepresentation* New();
  vtkTypeMacro(vtkDeformedVolumeRepresentation, vtkImageVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Step along the ray, mm. 0 (default): half the smallest voxel side. */
  void SetSampleDistance(double distance);

  /** Leap over what cannot be seen: the same picture, sooner. Default true. */
  void SetEmptySpaceSkipping(bool skipping);

  /** Gradients for light: 0 half resolution, 1 full resolution (default), 2 on the fly. */
  void SetNormalTexture(int normals);

  /** Draw fewer pixels while moving, to hold the rate. Default true. */
  void SetAdaptiveQuality(bool adaptive);

  /** Most memory of the GPU to use, MiB. 0 (default): all that the driver gives. */
  void SetMemoryLimit(double limit);

  ///@{
  /** Light effects of ParaView's "Volume" that are not drawn: told once if they are asked for. */
  void SetGlobalIlluminationReach(float reach);
  void SetVolumetricScatteringBlending(float blending);
  void SetRequestedRenderMode(int mode);
  ///@}

  ///@{
  /**
   * Asks which tissue the last picture shows at a pixel, counted from the view's lower left corner;
   * GetPickedTissue then gives its position (mm, world, deformed frame) and 1, or zeros where no
   * surface was hit. Nothing is drawn.
   */
  void SetPickedPixel(int x, int y);
  vtkGetVector4Macro(PickedTissue, double);
  ///@}

  /** What the renderer did since it was made (Counters.h): lines of a name, a space, a number. */
  const char* GetCounters();

protected:
  vtkDeformedVolumeRepresentation();
  ~vtkDeformedVolumeRepresentation() override = default;

  bool AddToView(vtkView* view) override;

  void UpdateMapperParameters() override;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkDeformedVolumeRepresentation(const vtkDeformedVolumeRepresentation&) = delete;
  void operator=(const vtkDeformedVolumeRepresentation&) = delete;

  vtkDeformedVolumeMapper* Mapper() const;

  void TellOnce(bool unsupported, const std::string& sentence);

  float GlobalIlluminationReach = 0.0f;
  float VolumetricScatteringBlending = 0.0f;
  int RequestedRenderMode = 0;
  std::set<std::string> Told;
  std::string CountersText;
  double PickedTissue[4] = { 0.0, 0.0, 0.0, 0.0 };
  vtkWeakPointer<vtkRenderer> Renderer; // of the view this representation is shown in
};

#endif
