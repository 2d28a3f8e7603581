// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedSlicesRepresentation
 * @brief   "Deformed Slices": planes through a volume and the lattice that it carries
 *
 * Data delivery, colour maps and transforms are those of ParaView's "Volume": the volume stays on
 * the server that draws it. vtkDeformedSlicesMapper draws the planes; its header explains the
 * properties.
 */
#ifndef vtkDeformedSlicesRepresentation_h
#define vtkDeformedSlicesRepresentation_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkNew.h"                             // for the private part
#include "vtkWholeVolumeRepresentation.h"

class vtkDeformedSlicesMapper;
class vtkPolyData;
namespace brainshift
{
class OrientationMarks;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkDeformedSlicesRepresentation
  : public vtkWholeVolumeRepresentation
{
public:
  static vtkDeformedSlicesRepresentation* New();
  vtkTypeMacro(vtkDeformedSlicesRepresentation, vtkWholeVolumeRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void SetVisibility(bool visible) override;

  ///@{
  /** Passed on to the mapper; see there. */
  void SetShowSagittal(bool show);
  void SetShowCoronal(bool show);
  void SetShowAxial(bool show);
  void SetSlicePosition(double x, double y, double z);
  void SetCrosshair(bool show);
  void SetSliceInterpolation(int interpolation);
  void SetMemoryLimit(double mebibytes);
  void SetOpacity(double opacity);
  void SetMapOpacity(bool map);
  void SetComparison(int comparison);
  void SetComparisonColors(int colors);
  void SetCheckerSize(double size);
  void SetReferenceRange(double black, double white);
  void SetFullGradient(double fraction);
  void SetSimilarityWindow(double mm);
  void SetWipePosition(double x, double y, double z);
  ///@}

  ///@{
  /** Letters R L A P S I at the edges of a view that looks along an axis. Default false. */
  void SetOrientationMarks(bool marks);
  vtkGetMacro(OrientationMarks, bool);
  ///@}

  ///@{
  /**
   * Meaning of the world axes for the patient: 0 (default): as the volume's reader has attached
   * (WorldAxes.h); 1: RAS; 2: LPS.
   */
  void SetWorldAxes(int axes);
  vtkGetMacro(WorldAxes, int);
  ///@}

  /** Whether tissue is tinted by the uncertainty of its position; see vtkDeformedSlicesMapper. */
  void SetShowEvidence(bool show) override;

  /** The mapper that draws it in this process. */
  vtkDeformedSlicesMapper* GetDeformedSlicesMapper() const;

protected:
  vtkDeformedSlicesRepresentation();
  ~vtkDeformedSlicesRepresentation() override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output) override;

  void WidenByTissue(vtkImageData* volume, double bounds[6]) override;
  const brainshift::Lattice* LatticeOf(vtkImageData* volume) override;
  double ReadsBesideMm(vtkImageData* volume) const override;
  void SetDrawnPart(const brainshift::DrawnPart* part) override;

private:
  vtkDeformedSlicesRepresentation(const vtkDeformedSlicesRepresentation&) = delete;
  void operator=(const vtkDeformedSlicesRepresentation&) = delete;

  // Called when the renderer of the view starts a picture.
  void PreparePicture();

  // The process that shows the picture draws the letters. It may not have the volume: the
  // meaning of the axes is sent there separately.
  void DeliverAxes(vtkInformationRequestKey* request, vtkInformation* input);

  bool ComparesInColors() const override;

  // Shows the marks that are wanted.
  void ShowMarks();

  // Sets the axes of the marks: those that the user chose, or else those of the volume.
  void UpdateMarks();

  unsigned long RenderStart = 0; // observer of the renderer
  bool OrientationMarks = false;
  int WorldAxes = 0;
  int AttachedAxes = 0;          // those of the volume
  vtkNew<vtkPolyData> AxesPiece; // AttachedAxes and the grid's axes
  vtkSmartPointer<brainshift::OrientationMarks> Marks;
};

#endif
