// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTraceDistance
 * @brief   how far the points of a trace lie from the deformed cortex
 *
 * Input 0: points in the deformed frame (mm, world), blocks of them too. Input 1: the deformable
 * volume. Input 2 (optional): a segmentation at rest on any grid, which the cortex is taken from
 * instead of the volume. Input 3 (optional): a cavity mask in the deformed frame, labels or scalars
 * on any grid: where it is above 0, neither points nor tissue count; nor do they in the cavity that
 * Compare Volumes attached to the volume.
 *
 * The cortex is where the scalars pass Threshold, or where Label ends. It is found once, at rest;
 * after a stroke only what the stroke reached is moved (DeformedSurface.h), so the filter follows a
 * hand. Distances are exact for the moved triangles, which are as fine as the voxels. A point is
 * inside if the tissue seen at it, restFromDeformed, is.
 *
 * Output: the points with DistanceToCortex (float32, mm, positive outside; not a number for points
 * that do not count), and field arrays Count, Mean (signed), RMS and Percentile95 (of absolute
 * distances), over all blocks and all processes.
 */
#ifndef vtkTraceDistance_h
#define vtkTraceDistance_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkPassInputTypeAlgorithm.h"

#include <memory> // for the private part
#include <string>
#include <vector>

class vtkPointSet;

class VTKBRAINSHIFTFILTERS_EXPORT vtkTraceDistance : public vtkPassInputTypeAlgorithm
{
public:
  static vtkTraceDistance* New();
  vtkTypeMacro(vtkTraceDistance, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum SurfaceByType
  {
    ByThreshold = 0, // scalars at or above Threshold are tissue
    ByLabel = 1,     // scalars equal to Label are
  };

  ///@{
  /** Name of the scalars that tell tissue; empty (default): the active ones, or the first. */
  vtkSetMacro(SurfaceArray, std::string);
  vtkGetMacro(SurfaceArray, std::string);
  ///@}

  ///@{
  /** ByThreshold (default) or ByLabel. */
  vtkSetClampMacro(SurfaceBy, int, ByThreshold, ByLabel);
  vtkGetMacro(SurfaceBy, int);
  ///@}

  ///@{
  /** Least scalar of tissue. Default 0.5: the edge of a mask of 0 and 1. */
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /** Label of the tissue. Default 1. */
  vtkSetMacro(Label, int);
  vtkGetMacro(Label, int);
  ///@}

  ///@{
  /** Inputs 1, 2 and 3. */
  void SetDeformationConnection(vtkAlgorithmOutput* volume);
  void SetSegmentationConnection(vtkAlgorithmOutput* segmentation);
  void SetCavityConnection(vtkAlgorithmOutput* mask);
  ///@}

  ///@{
  /** Of the last execution: points that counted; mm, not a number if there were none. */
  int GetCount() const;
  double GetMean() const;
  double GetRMS() const;
  double GetPercentile95() const;
  ///@}

  ///@{
  /** What the filter redid so far: surfaces found; points of the surface moved by the last run. */
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

  // Returns what keeps the filter from knowing the cortex; empty if nothing does.
  std::string FindCortex(vtkInformationVector** inputs);
  // Adds the array to points; false if the user aborts.
  bool Measure(vtkPointSet* points, std::vector<double>& all);

  struct State;
  std::unique_ptr<State> Internal;
};

#endif
