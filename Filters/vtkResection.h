// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkResection
 * @brief   attaches a tumour and the cavity of its resection to a bent volume, for pictures
 *
 * Input 0, the volume, passes through by reference with all that it carries. Input 1 (optional) is
 * the tumour at rest, as it was drawn before surgery. Input 2 (optional) is the cavity, in the
 * deformed frame: where tissue was removed. Without input 2, the cavity that Compare Volumes
 * attached counts, which moves with the reference. The output carries both (Resection.h) and no
 * reference. Pictures leave out the tissue that the deformation takes into the cavity, and colour
 * the tumour that is left.
 */
#ifndef vtkResection_h
#define vtkResection_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for the private part
#include <string>
#include <vector>

class VTKBRAINSHIFTFILTERS_EXPORT vtkResection : public vtkImageAlgorithm
{
public:
  static vtkResection* New();
  vtkTypeMacro(vtkResection, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /** The tumour (input 1): labels or scalars, on points or in cells, on any grid. */
  void SetTumourConnection(vtkAlgorithmOutput* tumour);

  /** The cavity (input 2): labels or scalars, on points or in cells, on any grid. */
  void SetCavityConnection(vtkAlgorithmOutput* cavity);

  ///@{
  /** The labels that are tumour. Default: none, which means every value above 0. */
  void AddTumourLabel(int label);
  void ClearTumourLabels();
  ///@}

  ///@{
  /** The labels of input 2 that are cavity. Default: none, which means every value above 0. */
  void AddCavityLabel(int label);
  void ClearCavityLabels();
  ///@}

  ///@{
  /** Whether tissue in the cavity counts as removed (default), or is there still. */
  vtkSetMacro(RemoveTissue, bool);
  vtkGetMacro(RemoveTissue, bool);
  vtkBooleanMacro(RemoveTissue, bool);
  ///@}

  /** What to know about the last execution: sentences without the last full stop, or nothing. */
  std::string GetWarning() const;

protected:
  vtkResection();
  ~vtkResection() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkResection(const vtkResection&) = delete;
  void operator=(const vtkResection&) = delete;

  bool RemoveTissue = true;
  std::vector<int> TumourLabels;
  std::vector<int> CavityLabels;

  struct Kept;
  std::unique_ptr<Kept> Internal;
};

#endif
