// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedVolumeReport
 * @brief   what a "Deformed Volume" or "Deformed Slices" drew, asked in the process that drew it
 *
 * With a server that draws, the client's own representation has no picture to ask. This object
 * lives with the renderer; the XML proxy of the same name brings its answers to the client.
 */
#ifndef vtkDeformedVolumeReport_h
#define vtkDeformedVolumeReport_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for what is asked

#include <string> // for the counters' text

class vtkDeformedSlicesMapper;
class vtkDeformedVolumeMapper;
class vtkPVDataRepresentation;
class vtkPVRenderView;

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkDeformedVolumeReport : public vtkObject
{
public:
  static vtkDeformedVolumeReport* New();
  vtkTypeMacro(vtkDeformedVolumeReport, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** A Deformed Volume or Deformed Slices, or a composite representation that shows one now. */
  void SetRepresentation(vtkPVDataRepresentation* representation);

  /** The view that shows the representation. */
  void SetView(vtkPVRenderView* view);

  ///@{
  /** Pixel, from the view's lower left corner, that GetTissue asks for. Default -1 -1: none. */
  vtkSetVector2Macro(Pixel, int);
  vtkGetVector2Macro(Pixel, int);
  ///@}

  /**
   * Seven numbers about the tissue at the pixel of the last picture: its position (mm, world,
   * deformed frame); 1, or 0 if no surface was hit; the unit normal (world) of its slice, or zeros
   * in a Deformed Volume. Nothing is drawn.
   */
  double* GetTissue() VTK_SIZEHINT(7);

  /**
   * What the renderer did since it was made, and what it holds on the GPU (Gpu/Counters.h): lines
   * of a name, a space and a number.
   */
  const char* GetCounters();

  ///@{
  /** Of Deformed Slices, see vtkDeformedSlicesMapper. Zeros if something else is shown. */
  double* GetSliceNormals() VTK_SIZEHINT(9);
  double* GetVoxelSteps() VTK_SIZEHINT(3);
  ///@}

protected:
  vtkDeformedVolumeReport();
  ~vtkDeformedVolumeReport() override;

private:
  vtkDeformedVolumeReport(const vtkDeformedVolumeReport&) = delete;
  void operator=(const vtkDeformedVolumeReport&) = delete;

  vtkPVDataRepresentation* ActiveRepresentation() const;
  vtkDeformedVolumeMapper* Mapper() const; // null if there is none
  vtkDeformedSlicesMapper* Slices() const; // null if there is none

  vtkWeakPointer<vtkPVDataRepresentation> Representation;
  vtkWeakPointer<vtkPVRenderView> View;
  int Pixel[2] = { -1, -1 };
  double Tissue[7] = {};
  double SliceNormals[9] = {};
  double VoxelSteps[3] = {};
  std::string Counters;
};

#endif
