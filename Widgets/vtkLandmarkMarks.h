// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLandmarkMarks
 * @brief   numbered marks of landmarks over a picture
 *
 * Each pair has a ring where its tissue is drawn, a cross where it was measured, and a line from
 * the cross to where the fit puts it: the residual. Marks have one size in pixels however far away
 * they are, and nothing hides them.
 */
#ifndef vtkLandmarkMarks_h
#define vtkLandmarkMarks_h

#include "Widgets/LandmarkMark.h"
#include "vtkBrainShiftWidgetsModule.h" // for the export macro
#include "vtkProp.h"

#include <memory>
#include <vector>

class VTKBRAINSHIFTWIDGETS_EXPORT vtkLandmarkMarks : public vtkProp
{
public:
  static vtkLandmarkMarks* New();
  vtkTypeMacro(vtkLandmarkMarks, vtkProp);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Replaces all marks. Default: none. */
  void SetMarks(const std::vector<brainshift::LandmarkMark>& marks);
  const std::vector<brainshift::LandmarkMark>& GetMarks() const;

  void ReleaseGraphicsResources(vtkWindow* window) override;
  int RenderOverlay(vtkViewport* viewport) override;

protected:
  vtkLandmarkMarks();
  ~vtkLandmarkMarks() override;

private:
  vtkLandmarkMarks(const vtkLandmarkMarks&) = delete;
  void operator=(const vtkLandmarkMarks&) = delete;

  struct Parts;
  std::unique_ptr<Parts> Internal;
};

#endif
