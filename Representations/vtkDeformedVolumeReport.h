// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformedVolumeReport
 * @brief   reports what a "Deformed Volume" or "Deformed Slices" drew, in the process that drew it
 *
 * With a server that draws, the client's own representation has no picture to query. This object
 * lives with the renderer; the XML proxy of the same name brings its answers to the client.
 */
#ifndef vtkDeformedVolumeReport_h
#define vtkDeformedVolumeReport_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for what is asked

#include <string> // for texts

class vtkDeformedSlicesMapper;
class vtkDeformedVolumeMapper;
class vtkPVDataRepresentation;
class vtkPVRenderView;
namespace brainshift
{
struct TissueFacts;
}

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
  /** Pixel, from the view's lower left corner, that GetTissue and GetFacts report on. Default -1
   * -1: none. On several MPI ranks each rank drew a part of the picture: they all come here, and
   * the answers are those of the rank whose tissue is nearest. */
  void SetPixel(int x, int y);
  vtkGetVector2Macro(Pixel, int);
  ///@}

  /**
   * Seven numbers about the tissue at the pixel of the last picture: its position (mm, world,
   * deformed frame); 1, or 0 if no surface was hit; the unit normal (world) of its slice, or zeros
   * in a Deformed Volume. Nothing is drawn.
   */
  double* GetTissue() VTK_SIZEHINT(7);

  /**
   * Nineteen numbers about the tissue at the pixel of the last picture. Positions are mm in the
   * volume's own axes, before the transform of the representation.
   *
   *     0       1, or 0 if no surface was hit: then all numbers are 0
   *     1 - 3   position, deformed frame
   *     4 - 6   position, rest frame
   *     7, 8    1 if a deformation moves the tissue, or 0; Jacobian determinant (1: no change)
   *     9, 10   1, or 0 if unknown; the value of the nearest voxel of the drawn array
   *     11, 12  1, or 0 if unknown; the value of the nearest voxel of the reference
   *     13, 14  1, or 0 if unknown; the label of the nearest voxel: TissueFacts.h
   *     15      axes of the data: 0 unknown, 1 RAS, 2 LPS
   *     16      distance from the camera along the direction of view, mm
   *     17, 18  1, or 0 if unknown; uncertainty of the position: one standard deviation along an
   *             axis, mm, infinity where nothing was measured
   *
   * Nothing is drawn.
   */
  double* GetFacts() VTK_SIZEHINT(19);

  /** Name of the label that GetFacts returned last. Empty: the data names none. */
  const char* GetLabelName() { return this->LabelName.c_str(); }

  ///@{
  /** Position (mm, the volume's own axes) that GetSameTissue starts from. Default 0 0 0. */
  vtkSetVector3Macro(Place, double);
  vtkGetVector3Macro(Place, double);
  ///@}

  ///@{
  /** True (default): Place is in the deformed frame, GetSameTissue in the rest frame. False: the
   * reverse. */
  vtkSetMacro(ToRest, bool);
  vtkGetMacro(ToRest, bool);
  ///@}

  /** Position of the tissue at Place in the other frame, mm. Place itself if nothing bends it. */
  double* GetSameTissue() VTK_SIZEHINT(3);

  /**
   * Counts of the renderer's work since it was made, and its memory on the GPU (Gpu/GpuTask.h):
   * lines of a name, a space and a number.
   */
  const char* GetCounters();

  /**
   * Seven numbers on what a Deformed Volume or Deformed Slices draw of a finer level: the level,
   * -1: none; bricks that are there; bricks that are still to come, 0: a further picture would be
   * the same; 1 if the view has more than there is room for, or 0; 1 while more are read, so that a
   * picture a little later shows more, or 0; 1 if bricks were read that no picture has shown, or 0;
   * 1 if the volume is drawn coarser and an OME-Zarr image of it would bring such bricks, or 0.
   * Nothing is drawn.
   */
  int* GetDetail() VTK_SIZEHINT(7);

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

  void FindTissue();
  void FindFacts();
  void TakeNearest();
  double DistanceAhead() const;
  void TakeFacts(const brainshift::TissueFacts& facts);
  vtkPVDataRepresentation* ActiveRepresentation() const;
  vtkDeformedVolumeMapper* Mapper() const; // null if there is none
  vtkDeformedSlicesMapper* Slices() const; // null if there is none

  vtkWeakPointer<vtkPVDataRepresentation> Representation;
  vtkWeakPointer<vtkPVRenderView> View;
  int Pixel[2] = { -1, -1 };
  double Place[3] = {};
  bool ToRest = true;
  double Tissue[7] = {};
  double Facts[19] = {};
  std::string LabelName;
  bool IsKnown = false; // what ranks found together
  double SameTissue[3] = {};
  double SliceNormals[9] = {};
  double VoxelSteps[3] = {};
  int Detail[7] = {};
  std::string Counters;
};

#endif
