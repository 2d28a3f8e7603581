// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Draws the pointer over the pictures of all 3D and slice views: a ball at its tip, a shaft, and
/// the points of the trace that is being recorded. It is drawn in a layer above the picture, so no
/// ray is cast for it, and tissue does not hide it.
#ifndef BrainShift_TipDrawing_h
#define BrainShift_TipDrawing_h

#include <QHash>
#include <QPointer>

#include <glm/glm.hpp>

#include <memory>
#include <vector>

class pqDataRepresentation;
class pqRenderView;

namespace brainshift
{
class TipDrawing
{
public:
  TipDrawing();
  ~TipDrawing();
  TipDrawing(const TipDrawing&) = delete;
  TipDrawing& operator=(const TipDrawing&) = delete;

  /// Shows the tip (mm, world) and the direction of the shaft, a unit vector, and draws.
  void show(const glm::dvec3& tip, const glm::dvec3& shaft);
  /// Shows no tip, and draws.
  void hide();
  /// The recorded points (mm, world). They are drawn with the next tip.
  void setTrace(const std::vector<double>& points);
  /// While the deformation changes, draw interactive pictures: still ones cast all rays anew.
  void setBending(bool bends) { this->Bending = bends; }
  bool isShown() const { return this->Shown; }
  /// Leaves a view that goes away.
  void leave(pqRenderView* view);
  /// Leaves all views, and lets pictures go that were kept.
  void leaveAll();

private:
  void enterViews();
  void draw();

  struct Parts;
  std::unique_ptr<Parts> Internal;
  bool Shown = false;
  bool Bending = false;
};
}

#endif
