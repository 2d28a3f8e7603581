// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkWholeVolumeRepresentation
 * @brief   a volume that one process draws whole
 *
 * Data delivery, colour maps and transforms are those of ParaView's "Volume", with one difference.
 * On several MPI ranks, ParaView gives each rank a part of the volume to draw. Bent tissue crosses
 * the borders of parts, and light, picks and traces need all of it. So the first rank collects the
 * parts and draws them, and the others draw nothing of it. Surfaces in the view follow it there.
 */
#ifndef vtkWholeVolumeRepresentation_h
#define vtkWholeVolumeRepresentation_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkImageVolumeRepresentation.h"
#include "vtkNew.h" // for the legend

#include <memory> // for what is gathered

class vtkImageData;

namespace brainshift
{
class EvidenceLegend;
class GatheredVolume;
class WindowText;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkWholeVolumeRepresentation
  : public vtkImageVolumeRepresentation
{
public:
  vtkAbstractTypeMacro(vtkWholeVolumeRepresentation, vtkImageVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /** Shown or not, and the legend with it. */
  void SetVisibility(bool visible) override;

  /** Text in the upper left corner of the view, for example which of two volumes has which colour.
   * Empty (default) or null: none. */
  void SetLegend(const char* text);

  /** Whether tissue is tinted by the uncertainty of its position (one standard deviation, mm), with
   * a legend in the upper right corner of the view. Default false. */
  virtual void SetShowEvidence(bool show);

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output) override;

protected:
  vtkWholeVolumeRepresentation();
  ~vtkWholeVolumeRepresentation() override;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;
  void UpdateMapperParameters() override;

  /** Whether the data carries a reference that is shown beside the volume. */
  bool CarriesComparison() const;

private:
  vtkWholeVolumeRepresentation(const vtkWholeVolumeRepresentation&) = delete;
  void operator=(const vtkWholeVolumeRepresentation&) = delete;

  /** Whether colours distinguish a volume and a reference, so that stripes show the uncertainty. */
  virtual bool ComparesInColors() const = 0;

  void GatherParts();
  void WidenBounds();

  vtkNew<brainshift::WindowText> Legend;
  vtkSmartPointer<brainshift::EvidenceLegend> Evidence;
  bool ShowEvidence = false;
  std::unique_ptr<brainshift::GatheredVolume> Gathered;
  vtkSmartPointer<vtkImageData> Part; // of this process
  bool IsNew = false;                 // the part, since parts were gathered
  bool IsDrawnElsewhere = false;
};

#endif
