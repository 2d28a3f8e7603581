// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLatticeRepresentation
 * @brief   control points and tool outlines over a picture
 *
 * Draws control points with thin lines between neighbours, highlights some of them, and draws the
 * outlines of a tool. It gets only the control points near the cursor, so a picture costs the same
 * for every size of lattice. Positions: mm, world axes, deformed frame.
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

  /** How lines are drawn. */
  enum Pen
  {
    Strong, ///< The edge of a tool.
    Weak,   ///< Within a tool.
    Mark,   ///< The point of interest, or the displacement of a pull.
    Hold,   ///< Pinned tissue.
    NumberOfPens,
  };

  /** Control points with lines between neighbours. */
  void SetControlPoints(const std::vector<brainshift::ControlPoint>& points);
  const std::vector<brainshift::ControlPoint>& GetControlPoints() const;

  /** Positions of control points that cannot be picked, drawn as faint dots. */
  void SetFaint(const std::vector<glm::dvec3>& positions);

  /** Highlighted positions: selected, or under the cursor. */
  void SetHighlights(const std::vector<glm::dvec3>& positions);

  /** Positions drawn as small white balls: the tissue of pulls and pins. */
  void SetDots(const std::vector<glm::dvec3>& positions);

  /** Lines drawn with a pen. */
  void SetLines(Pen pen, const std::vector<brainshift::Polyline>& lines);

  /** Removes everything. */
  void Clear();

  ///@{
  /** The number of things drawn, by kind. */
  int GetNumberOfControlPoints() const;
  int GetNumberOfFaint() const;
  int GetNumberOfHighlights() const;
  int GetNumberOfDots() const;
  int GetNumberOfLines(int pen) const;
  ///@}

  void BuildRepresentation() override;
  double* GetBounds() VTK_SIZEHINT(6) override;
  void GetActors(vtkPropCollection* actors) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  /** Draws translucent lines last and simply. VTK's own pass for translucent surfaces works on all
   * pixels of the view three times. On a software driver that takes as long as the volume. */
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
