// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVolumeOrder
 * @brief   draws a renderer's volumes from back to front
 *
 * Volumes are blended one over the other in the order they were added, whichever is nearer. This
 * culler removes nothing: it sorts the volumes, VTK's own too, by the depth of their boxes'
 * middles, and leaves all other props where they are. Boxes with the same middle keep their order.
 */
#ifndef vtkVolumeOrder_h
#define vtkVolumeOrder_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkCuller.h"

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkVolumeOrder : public vtkCuller
{
public:
  static vtkVolumeOrder* New();
  vtkTypeMacro(vtkVolumeOrder, vtkCuller);

  ///@{
  /** Sort at all. Default true. */
  vtkSetMacro(Enabled, bool);
  vtkGetMacro(Enabled, bool);
  ///@}

  double Cull(vtkRenderer* renderer, vtkProp** props, int& count, int& initialized) override;

protected:
  vtkVolumeOrder();
  ~vtkVolumeOrder() override;

private:
  vtkVolumeOrder(const vtkVolumeOrder&) = delete;
  void operator=(const vtkVolumeOrder&) = delete;

  bool Enabled = true;
};

#endif
