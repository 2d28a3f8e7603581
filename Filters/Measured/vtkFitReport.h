// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFitReport
 * @brief   asks a fit about positions
 *
 * The fit may lie on a server. This object lives beside it, and the XML proxy of the same name
 * brings its answers to the client. The filter must be up to date. All numbers are mm.
 */
#ifndef vtkFitReport_h
#define vtkFitReport_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkNew.h"                     // for answers
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for what is asked

#include <vector>

class vtkDoubleArray;
class vtkFitDeformation;

class VTKBRAINSHIFTFILTERS_EXPORT vtkFitReport : public vtkObject
{
public:
  static vtkFitReport* New();
  vtkTypeMacro(vtkFitReport, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The fit: a vtkFitDeformation. Anything else gives no answers. */
  void SetFilter(vtkObject* filter);

  ///@{
  /** The positions to ask about (mm, world, rest frame), three numbers each. Default: none. */
  void AddPoint(double x, double y, double z);
  void ClearPoints();
  ///@}

  ///@{
  /** For each position where its tissue was or would be measured, and the standard deviation. */
  vtkDoubleArray* GetMeasured();
  vtkDoubleArray* GetDeviations();
  ///@}

  ///@{
  /** The equations of the fit: vtkFitDeformation::Rows and Covariance. They take no points. */
  vtkDoubleArray* GetRows();
  vtkDoubleArray* GetCovariance();
  ///@}

protected:
  vtkFitReport();
  ~vtkFitReport() override;

private:
  vtkFitReport(const vtkFitReport&) = delete;
  void operator=(const vtkFitReport&) = delete;

  vtkWeakPointer<vtkFitDeformation> Filter;
  std::vector<double> Points;
  vtkNew<vtkDoubleArray> Measured;
  vtkNew<vtkDoubleArray> Deviations;
  vtkNew<vtkDoubleArray> Rows;
  vtkNew<vtkDoubleArray> Covariance;
};

#endif
