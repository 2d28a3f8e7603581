// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCompareVolumes
 * @brief   attaches a reference volume to a volume, for pictures that compare them
 *
 * Input 0 passes through by reference, with all it carries; input 1, the reference, goes along as
 * field data (ReferenceVolume.h): its point scalars, shared, and its grid, moved rigidly. Nothing
 * is resampled. It may stand before or after Free-Form Deformation, which bends the first only.
 *
 * Input 2, the optional cavity, tells where the reference lacks tissue that was removed: what
 * compares ignores it. It lies to the reference as it was drawn there, and is moved with it.
 */
#ifndef vtkCompareVolumes_h
#define vtkCompareVolumes_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for the private part
#include <vector>

class VTKBRAINSHIFTFILTERS_EXPORT vtkCompareVolumes : public vtkImageAlgorithm
{
public:
  static vtkCompareVolumes* New();
  vtkTypeMacro(vtkCompareVolumes, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The reference; any image with point scalars of one component. */
  void SetReferenceConnection(vtkAlgorithmOutput* reference);

  /** The cavity, optional: labels or scalars, on points or in cells, on any grid. */
  void SetCavityConnection(vtkAlgorithmOutput* cavity);

  ///@{
  /** Labels of the cavity. None (default): what is above 0. */
  void AddCavityLabel(int label);
  void ClearCavityLabels();
  ///@}

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

  enum ShowType
  {
    Both = 0, // as ReferenceShow in ReferenceVolume.h
    Deformed = 1,
    Reference = 2,
  };

  ///@{
  /** Which volume is shown where both are drawn; alone, in its ordinary colours. Default both. */
  vtkSetClampMacro(Show, int, Both, Reference);
  vtkGetMacro(Show, int);
  ///@}

protected:
  vtkCompareVolumes();
  ~vtkCompareVolumes() override;

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
  int Show = Both;
  std::vector<int> CavityLabels;

  struct Kept;
  std::unique_ptr<Kept> Internal;
};

#endif
