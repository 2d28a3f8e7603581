// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCompareVolumes
 * @brief   attaches a reference volume to a volume, for pictures that compare them
 *
 * Input 0, the volume, passes through by reference with all that it carries. Input 1 is the
 * reference. The output carries it as field data (ReferenceVolume.h): its point scalars, which are
 * shared and not copied, and its grid, which is moved rigidly. Nothing is resampled. This filter
 * may stand before or after Free-Form Deformation, which bends the volume only.
 *
 * Input 2 (optional) is the cavity: where the reference lacks tissue that was removed. Colours and
 * numbers that compare the volumes ignore it. It is drawn on the reference and is moved with it.
 */
#ifndef vtkCompareVolumes_h
#define vtkCompareVolumes_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for the private part
#include <string>
#include <vector>

class VTKBRAINSHIFTFILTERS_EXPORT vtkCompareVolumes : public vtkImageAlgorithm
{
public:
  static vtkCompareVolumes* New();
  vtkTypeMacro(vtkCompareVolumes, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /** The reference (input 1): any image with point scalars of one component. */
  void SetReferenceConnection(vtkAlgorithmOutput* reference);

  /** The cavity (input 2): labels or scalars, on points or in cells, on any grid. */
  void SetCavityConnection(vtkAlgorithmOutput* cavity);

  ///@{
  /** The labels that are cavity. Default: none, which means every value above 0. */
  void AddCavityLabel(int label);
  void ClearCavityLabels();
  ///@}

  ///@{
  /**
   * Rotation of the reference about the middle of its box: degrees about x, then y, then z. Default
   * 0 0 0.
   */
  vtkSetVector3Macro(ReferenceRotation, double);
  vtkGetVector3Macro(ReferenceRotation, double);
  ///@}

  ///@{
  /** Translation of the reference after its rotation: mm, world axes. Default 0 0 0. */
  vtkSetVector3Macro(ReferenceTranslation, double);
  vtkGetVector3Macro(ReferenceTranslation, double);
  ///@}

  /** The numbers of ReferenceShow in ReferenceVolume.h. */
  enum ShowType
  {
    Both = 0,
    Deformed = 1,
    Reference = 2,
  };

  ///@{
  /**
   * Which volume is shown. One that is shown alone has its ordinary colours. Default Both.
   */
  vtkSetClampMacro(Show, int, Both, Reference);
  vtkGetMacro(Show, int);
  ///@}

  /** What to know about the last execution: sentences without the last full stop, or nothing. */
  std::string GetWarning() const;

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
