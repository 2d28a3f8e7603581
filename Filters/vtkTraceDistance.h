// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTraceDistance
 * @brief   how far the points of a trace lie from the deformed cortex
 *
 * - Input 0: points in the deformed frame (mm, world), or blocks of them.
 * - Input 1: a deformable volume, the output of Free-Form Deformation.
 * - Input 2 (optional): a segmentation in the rest frame on any grid. The cortex is taken from it
 *   instead of the volume.
 * - Input 3 (optional): a cavity in the deformed frame, labels or scalars on any grid. Points and
 *   tissue do not count in it. They do not count either in the cavity that Compare
 *   Volumes attached to the volume.
 *
 * The cortex is the surface where the scalars pass Threshold, or where Label ends. It is found
 * once, at rest. After a stroke only the part that the stroke reached is moved (DeformedSurface.h),
 * so the filter follows a hand. Distances are exact for the moved triangles, which are as fine as
 * the voxels. A point is inside if the tissue that is seen there (restFromDeformed) is inside.
 *
 * Output: the points with the point array DistanceToCortex (float32, signed distance in mm,
 * positive outside; NaN for points that do not count), and the field arrays Count, Mean (of the
 * signed distances), RMS and Percentile95 (of the absolute distances), in mm, over all blocks and
 * all processes.
 */
#ifndef vtkTraceDistance_h
#define vtkTraceDistance_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkPassInputTypeAlgorithm.h"

#include <memory> // for the private part
#include <string>
#include <vector>

class vtkDoubleArray;
class vtkPointSet;

class VTKBRAINSHIFTFILTERS_EXPORT vtkTraceDistance : public vtkPassInputTypeAlgorithm
{
public:
  static vtkTraceDistance* New();
  vtkTypeMacro(vtkTraceDistance, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int ModifyRequest(vtkInformation* request, int when) override;

  enum SurfaceByType
  {
    ByThreshold = 0, ///< tissue is where scalars are at or above Threshold
    ByLabel = 1,     ///< tissue is where scalars equal Label
  };

  ///@{
  /**
   * Name of the point array in which to find tissue. Empty (default): the active scalars, or the
   * first array.
   */
  vtkSetMacro(SurfaceArray, std::string);
  vtkGetMacro(SurfaceArray, std::string);
  ///@}

  ///@{
  /** How tissue is found: ByThreshold (default) or ByLabel. */
  vtkSetClampMacro(SurfaceBy, int, ByThreshold, ByLabel);
  vtkGetMacro(SurfaceBy, int);
  ///@}

  ///@{
  /** Smallest scalar of tissue. Default 0.5: the edge of a mask of 0 and 1. */
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /** Label of the tissue. Default 1. */
  vtkSetMacro(Label, int);
  vtkGetMacro(Label, int);
  ///@}

  ///@{
  /** The deformable volume (input 1), the segmentation (input 2) and the cavity (input 3). */
  void SetDeformationConnection(vtkAlgorithmOutput* volume);
  void SetSegmentationConnection(vtkAlgorithmOutput* segmentation);
  void SetCavityConnection(vtkAlgorithmOutput* mask);
  ///@}

  ///@{
  /** The labels of the cavity. Default: none, which means every value above 0. */
  void AddCavityLabel(int label);
  void ClearCavityLabels();
  ///@}

  ///@{
  /**
   * Figures of the last execution: how many points counted, and their distances in mm, which are
   * NaN if no point counted, or if it failed.
   */
  int GetCount() const;
  double GetMean() const;
  double GetRMS() const;
  double GetPercentile95() const;
  ///@}

  /**
   * Histogram of the signed distances of the last execution: the width of its 32 bins (mm), then
   * how many points lie in each. The bins are symmetric about 0 (TraceStatistics.h). The width is 0
   * if no point counted.
   */
  vtkDoubleArray* GetHistogram();

  /**
   * RMS (mm) after none, one, and so on, to all strokes, as far as this filter measured it with the
   * same points and settings; NaN where it did not. Empty if the volume does not say its strokes.
   */
  vtkDoubleArray* GetRMSAfterStrokes();

  /** Why the last execution measured nothing: a sentence without a full stop. Empty if it did. */
  const char* GetProblem() const;

  ///@{
  /**
   * What the filter had to do: how many surfaces it found so far, and how many points of the
   * surface the last execution moved.
   */
  int GetSurfacesFound() const;
  vtkIdType GetPointsMoved() const;
  ///@}

protected:
  vtkTraceDistance();
  ~vtkTraceDistance() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTraceDistance(const vtkTraceDistance&) = delete;
  void operator=(const vtkTraceDistance&) = delete;

  std::string SurfaceArray;
  int SurfaceBy = ByThreshold;
  double Threshold = 0.5;
  int Label = 1;
  std::vector<int> CavityLabels;

  // Finds the cortex. Throws a Problem if it cannot.
  void FindCortex(vtkInformationVector** inputs);
  // Adds the array to points. False if the user aborts.
  bool Measure(vtkPointSet* points, std::vector<double>& all);
  // Measures the input, or all of its blocks, into a copy. False if the user aborts.
  bool MeasureAll(vtkDataObject* input, vtkDataObject* output, std::vector<double>& distances);
  // Notes the RMS among those after other strokes.
  void NoteRMS(vtkDataObject* points, vtkDataObject* volume);

  struct State;
  std::unique_ptr<State> Internal;
};

#endif
