// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLatticeRepresentation
 * @brief   control points and tool outlines over a picture
 *
 * Draws what a tool gives it: control points with thin lines between neighbours, some of them
 * highlighted, and outlines. It is given little, so that it costs a picture nothing, whatever the
 * size of the lattice. All positions are mm, world axes, deformed frame.
 */
#ifndef vtkLatticeRepresentation_h
#define vtkLatticeRepresentation_h

#include "Widgets/LatticeShapes.h"
#include "vtkBrainShiftWidgetsModule.h" // for the export macro
#include "vtkWidgetRepresentation.h"

#include <memory>
#include <vector>

class VTKBRAINSHIFTWIDGETS_EXPORT vtkLatticeRepresentation : public vtkWidgetRepresentation
{
public:
  static vtkLatticeRepresentation* New();
  vtkTypeMacro(vtkLatticeRepresentation, vtkWidgetRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Pen
  {
    Strong, // the edge of a tool
    Weak,   // what lies within
    Mark,   // the point of interest
    NumberOfPens,
  };

  /** Control points with lines between neighbours. */
  void SetHandles(const std::vector<brainshift::Handle>& handles);
  const std::vector<brainshift::Handle>& GetHandles() const;

  /** Positions of control points that are told, but not within reach. */
  void SetFaint(const std::vector<glm::dvec3>& positions);

  /** Highlighted positions: selected, or under the cursor. */
  void SetHighlights(const std::vector<glm::dvec3>& positions);

  /** Lines drawn with a pen. */
  void SetLines(Pen pen, const std::vector<brainshift::Polyline>& lines);

  /** Nothing is drawn afterwards. */
  void Clear();

  /** Points, and lines of all kinds, that are drawn. */
  int GetNumberOfHandles() const;
  int GetNumberOfFaint() const;
  int GetNumberOfHighlights() const;
  int GetNumberOfLines(int pen) const;

  void BuildRepresentation() override;
  double* GetBounds() VTK_SIZEHINT(6) override;
  void GetActors(vtkPropCollection* actors) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  /** What can be seen through is drawn last and simply: VTK's pass for such surfaces works on all
   * pixels of the view, three times, which takes a software driver as long as the volume. */
  int RenderOverlay(vtkViewport* viewport) override;

protected:
  vtkLatticeRepresentation();
  ~vtkLatticeRepresentation() override;

private:
  vtkLatticeRepresentation(const vtkLatticeRepresentation&) = delete;
  void operator=(const vtkLatticeRepresentation&) = delete;

  double Box[6];
  struct Parts;
  std::unique_ptr<Parts> Internal;
};

#endif
