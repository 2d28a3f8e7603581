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

class vtkDeformedVolumeMapper;

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

  /** What draws it in this process. */
  vtkDeformedVolumeMapper* GetDeformedVolumeMapper() const;

protected:
  vtkDeformedVolumeRepresentation();
  ~vtkDeformedVolumeRepresentation() override = default;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkDeformedVolumeRepresentation(const vtkDeformedVolumeRepresentation&) = delete;
  void operator=(const vtkDeformedVolumeRepresentation&) = delete;
};

#endif
