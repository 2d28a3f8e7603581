// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMoments
 * @brief   the moments of a surgery as time steps
 *
 * Input 0 (repeatable): one volume as bent at each moment, the output of Free-Form Deformation,
 * each with strokes, fit, mask and segmentation of its own. A volume that carries no deformation is
 * one that is not bent. All have the same points.
 *
 * Output: the volume as at the time that is asked for. At a moment it is that input, unchanged; one
 * that is not bent gets the mask and the segmentation of one that is, and displacements of 0.
 * Between two moments it has what the earlier one carries, bent by displacements that are linear in
 * time. They are interpolated and not measured, so they have no deviations. Before the first moment
 * and after the last one the nearest holds. Each input is asked for its own time, so that traces or
 * volumes with time steps have those of the moment.
 */
#ifndef vtkMoments_h
#define vtkMoments_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <string> // for messages
#include <vector> // for times

class VTKBRAINSHIFTFILTERS_EXPORT vtkMoments : public vtkImageAlgorithm
{
public:
  static vtkMoments* New();
  vtkTypeMacro(vtkMoments, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  ///@{
  /**
   * The time (minutes) of each input, in their order: finite numbers in any order, all different.
   * Default: none, which means 0, 1, 2 and so on.
   */
  void AddTime(double time);
  void ClearTimes();
  ///@}

  ///@{
  /** Whether tissue moves from moment to moment (default), or stays until the next one. */
  vtkSetMacro(Interpolate, bool);
  vtkGetMacro(Interpolate, bool);
  vtkBooleanMacro(Interpolate, bool);
  ///@}

protected:
  vtkMoments() = default;
  ~vtkMoments() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkMoments(const vtkMoments&) = delete;
  void operator=(const vtkMoments&) = delete;

  // The time of each input. Throws a Problem on times that are wrong.
  std::vector<double> TimesOf(int inputs) const;

  std::vector<double> Times;
  bool Interpolate = true;
  std::string ToldFold;
};

#endif
