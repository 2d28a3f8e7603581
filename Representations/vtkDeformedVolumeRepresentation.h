// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedVolumeRepresentation
 * @brief   "Deformed Volume": ParaView's "Volume" with our ray caster
 *
 * Data delivery, colour maps, opacity and transforms are inherited from "Volume". The mapper
 * differs, and the view gets the bounds of the deformed volume. A view that shows one draws all its
 * volumes from back to front.
 */
#ifndef vtkDeformedVolumeRepresentation_h
#define vtkDeformedVolumeRepresentation_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkNew.h"                             // for the order
#include "vtkWholeVolumeRepresentation.h"

#include <memory> // for the smoothing
#include <set>    // for warnings that were given
#include <string> // for its sentences

class vtkDeformedVolumeMapper;
class vtkPiecewiseFunction;
class vtkVolumeOrder;

namespace brainshift
{
class EdgeSmoothing;
class MovingWindow;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkDeformedVolumeRepresentation
  : public vtkWholeVolumeRepresentation
{
public:
  static vtkDeformedVolumeRepresentation* New();
  vtkTypeMacro(vtkDeformedVolumeRepresentation, vtkWholeVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Shown or not. While it is shown, its view sorts its volumes. */
  void SetVisibility(bool visible) override;

  /** Step along the ray, mm. 0 (default): half the smallest voxel side. */
  void SetSampleDistance(double distance);

  /** Skip empty space along the rays: an identical picture, sooner. Default true. */
  void SetEmptySpaceSkipping(bool skipping);

  /** Gradients for light: 0 half resolution, 1 full resolution (default), 2 on the fly. */
  void SetNormalTexture(int normals);

  /** Draw fewer pixels while moving, so that pictures come fast enough. Default true. */
  void SetAdaptiveQuality(bool adaptive);

  /** Count samples that are taken and skipped, which costs time. Default false. */
  void SetCountSamples(bool count);

  /** Cast no rays for a picture that would be identical to the last one. Default false. */
  void SetKeepPicture(bool keep);

  ///@{
  /** Draw chosen labels of the volume's segmentation alone. Default false; none chosen. */
  void SetDrawSegment(bool segment);
  void AddDrawnLabel(int label);
  void ClearDrawnLabels();
  ///@}

  /** Whether tissue is tinted by the uncertainty of its position; see vtkDeformedVolumeMapper. */
  void SetShowEvidence(bool show) override;

  ///@{
  /** Strength of ambient occlusion, 0 to 1, and its radius (mm); see vtkDeformedVolumeMapper. */
  void SetAmbientOcclusion(double darkness);
  void SetOcclusionRadius(double radius);
  ///@}

  ///@{
  /**
   * Factor on opacity, 0 to 1, for a gradient: how much the scalar changes over a mean voxel side.
   * Linear between those that were added. None (default): opacity depends on the scalar alone.
   */
  void AddGradientOpacity(double gradient, double factor);
  void ClearGradientOpacity();
  ///@}

  /** The mapper that draws it in this process. */
  vtkDeformedVolumeMapper* GetDeformedVolumeMapper() const;

  /** Most memory of the GPU to use, MiB. 0 (default): all that the driver gives. */
  void SetMemoryLimit(double limit);

  ///@{
  /** How a reference that the data carries is shown; see vtkDeformedVolumeMapper. */
  void SetComparison(int comparison);
  void SetComparisonColors(int colors);
  void SetReferenceRange(double low, double high);
  void SetAgreementDistance(double distance);
  ///@}

  ///@{
  /** Light effects of "Volume" that are not drawn. A warning is given once if they are on. */
  void SetGlobalIlluminationReach(float reach);
  void SetVolumetricScatteringBlending(float blending);
  void SetRequestedRenderMode(int mode);
  ///@}

protected:
  vtkDeformedVolumeRepresentation();
  ~vtkDeformedVolumeRepresentation() override;

  std::string WhyWhole() const override;
  std::string WhyDataIsWhole() const override;
  void WidenByTissue(vtkImageData* volume, double bounds[6]) override;
  const brainshift::Lattice* LatticeOf(vtkImageData* volume) override;
  void CountVisible(vtkImageData* volume, brainshift::TissueCounts& counts) override;
  void SetDrawnPart(const brainshift::DrawnPart* part) override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

  void UpdateMapperParameters() override;

private:
  vtkDeformedVolumeRepresentation(const vtkDeformedVolumeRepresentation&) = delete;
  void operator=(const vtkDeformedVolumeRepresentation&) = delete;

  bool ComparesInColors() const override;
  void TellOnce(bool unsupported, const std::string& sentence);
  void PreparePicture(vtkObject* caller, unsigned long, void*);

  vtkNew<vtkVolumeOrder> Order;
  vtkNew<vtkPiecewiseFunction> GradientFactors;
  std::unique_ptr<brainshift::EdgeSmoothing> Smoothing;
  std::unique_ptr<brainshift::MovingWindow> Moving;
  unsigned long RenderStart = 0; // observer of the view's renderer
  float GlobalIlluminationReach = 0.0f;
  float VolumetricScatteringBlending = 0.0f;
  int RequestedRenderMode = 0;
  std::set<std::string> Told;
};

#endif
