// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCompareVolumes
 * @brief   attaches a reference volume to a volume, for pictures that compare them
 *
 * Input 0 passes through by reference, with all it carries; input 1, the reference, goes along as
 * field data (ReferenceVolume.h): its point scalars, shared, and its grid, moved rigidly. Nothing
 * is resampled. It may stand before or after Free-Form Deformation, which bends the first only.
 */
#ifndef vtkCompareVolumes_h
#define vtkCompareVolumes_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkDataArray.h"               // for what is kept
#include "vtkImageAlgorithm.h"
#include "vtkSmartPointer.h" // for what is kept

class VTKBRAINSHIFTFILTERS_EXPORT vtkCompareVolumes : public vtkImageAlgorithm
{
public:
  static vtkCompareVolumes* New();
  vtkTypeMacro(vtkCompareVolumes, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The reference; any image with point scalars of one component. */
  void SetReferenceConnection(vtkAlgorithmOutput* reference);

  ///@{
  /** Turn the reference about the middle of its box: degrees about x, then y, then z. Default 0. */
  vtkSetVector3Macro(ReferenceRotation, double);
  vtkGetVector3Macro(ReferenceRotation, double);
  ///@}

  ///@{
  /** Then move it: mm, world axes. Default 0 0 0. */
  vtkSetVector3Macro(ReferenceTranslation, double);
  vtkGetVector3Macro(ReferenceTranslation, double);
  ///@}

protected:
  vtkCompareVolumes();
  ~vtkCompareVolumes() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkCompareVolumes(const vtkCompareVolumes&) = delete;
  void operator=(const vtkCompareVolumes&) = delete;

  double ReferenceRotation[3] = { 0.0, 0.0, 0.0 };
  double ReferenceTranslation[3] = { 0.0, 0.0, 0.0 };

  // The same array for the same scalars, so that whoever has it on the GPU keeps it.
  vtkSmartPointer<vtkDataArray> Voxels;
  vtkSmartPointer<vtkDataArray> Scalars; // that Voxels shows, as of ScalarsTime
  vtkMTimeType ScalarsTime = 0;
};

#endif
