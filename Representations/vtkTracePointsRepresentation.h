// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTracePointsRepresentation
 * @brief   "Trace Points": points as balls, faded or hidden behind the tissue of deformed volumes
 *
 * Delivery, colours and selections are inherited from ParaView's "Point Gaussian". A change of the
 * points does not draw the volumes anew, see Traces/TracePoints.h.
 */
#ifndef vtkTracePointsRepresentation_h
#define vtkTracePointsRepresentation_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkPointGaussianRepresentation.h"

namespace brainshift
{
class TracePoints;
}

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkTracePointsRepresentation
  : public vtkPointGaussianRepresentation
{
public:
  static vtkTracePointsRepresentation* New();
  vtkTypeMacro(vtkTracePointsRepresentation, vtkPointGaussianRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  enum HiddenPointsType
  {
    Fade = 0, ///< With HiddenOpacity.
    Hide = 1,
    Show = 2, ///< As if there were no tissue.
  };

  ///@{
  /** How points behind the tissue are drawn: Fade (default), Hide or Show. */
  void SetHiddenPoints(int hidden);
  vtkGetMacro(HiddenPoints, int);
  ///@}

  ///@{
  /** Fraction of their opacity that faded points keep, 0 to 1. Default 0.4. */
  void SetHiddenOpacity(double opacity);
  vtkGetMacro(HiddenOpacity, double);
  ///@}

  /**
   * Radius of the balls, mm: what SetSplatSize of Point Gaussian sets. Default 0: a hundredth of
   * the longest side of the points' box, and at least 4 pixels.
   */
  double GetSplatSize();

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output) override;

protected:
  vtkTracePointsRepresentation();
  ~vtkTracePointsRepresentation() override;

private:
  vtkTracePointsRepresentation(const vtkTracePointsRepresentation&) = delete;
  void operator=(const vtkTracePointsRepresentation&) = delete;

  void TellProp();

  int HiddenPoints = Fade;
  double HiddenOpacity = 0.4;
};

#endif
