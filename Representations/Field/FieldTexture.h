// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The offset field on the GPU: uploads the control points, refines them and inverts the map.
 */
#ifndef BrainShift_FieldTexture_h
#define BrainShift_FieldTexture_h

#include "Filters/Deformation/FieldChange.h"
#include "Filters/Deformation/OffsetField.h"
#include "Representations/Gpu/Counters.h"
#include "Representations/Gpu/Program.h"

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkSmartPointer.h"

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
/// A lattice, and where its offsets are wanted.
struct FieldRequest
{
  glm::ivec3 dimensions{ 0 }; ///< Control points a side.
  int kernel = 0;             ///< As numbered in Filters/Deformation/Kernels.h.
  int samples = 4;            ///< Nodes of the refined lattice between two control points.
  Inverse inverse = Inverse::Exact;
  std::vector<glm::vec3> inCells;          ///< Displacements, lattice cells.
  std::shared_ptr<const NodeWeights> mask; ///< Lattice::mask; null: there is none.
  FieldNodes nodes;                        ///< Where offsets are wanted, see backwardNodes.
  glm::vec3 offsetScale{ 1.0f }; ///< Of one lattice cell, in the unit that offsets are wanted in.
};

/// The textures of one window.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT FieldTexture
{
public:
  FieldTexture();
  ~FieldTexture();

  /// Uploads the control points and computes what they changed since the last call. False if a
  /// shader does not compile or a texture cannot be made.
  bool update(vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters);

  /// Offsets (restFromDeformed minus identity): RGBA32F, one texel a node, trilinear, clamped.
  vtkTextureObject* offsets() const { return this->Offsets; }

  /// Displacements (deformedFromRest minus identity), lattice cells, on the forward nodes around
  /// all that moves. Null if nothing ever moved.
  vtkTextureObject* displacements() const { return this->Displacements; }

  /// Forward nodes that may move; all others stay.
  const IndexBox& displacedNodes() const { return this->Displaced; }

  /// The nodes of the texture of displacements. Along x it may begin earlier, even before the
  /// lattice, with zeros.
  IndexBox heldNodes() const
  {
    IndexBox box = this->Displaced;
    box.first.x -= this->Lead;
    return box;
  }

  /// Nodes whose offsets the last update computed.
  const IndexBox& changed() const { return this->Changed; }

  /// Where place or light of tissue changed.
  struct Bent
  {
    bool all = false;               ///< Anywhere.
    std::vector<glm::vec3> corners; ///< Only between these positions, lattice coordinates.
  };

  /// What the last update changed.
  const Bent& bent() const { return this->LastBent; }

  /// All textures; some may be null.
  std::vector<vtkTextureObject*> textures() const
  {
    return { this->ControlPoints, this->Displacements, this->Offsets, this->MaskWeights };
  }

  void releaseGraphicsResources(vtkWindow* window);

private:
  Bent bentBy(const FieldRequest& request) const;
  bool makeOffsets(vtkOpenGLRenderWindow* window, const FieldRequest& request);
  bool makeDisplacements(vtkOpenGLRenderWindow* window, const IndexBox& nodes);
  bool upload(vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters);
  bool refine(vtkOpenGLRenderWindow* window, const FieldRequest& request, const IndexBox& nodes,
    Counters& counters);
  bool invert(vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters);

  bool uploadMask(vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters);

  vtkSmartPointer<vtkTextureObject> ControlPoints;
  vtkSmartPointer<vtkTextureObject> MaskWeights; // on the forward nodes; null: no mask
  vtkSmartPointer<vtkTextureObject> Displacements;
  IndexBox Displaced; // forward nodes of Displacements; all others stay
  int Lead = 0;       // nodes before them, which are zero (leadToSecondThread)
  vtkSmartPointer<vtkTextureObject> Offsets;
  FieldRequest Current; // what the textures show
  bool HasCurrent = false;
  IndexBox Changed;
  Bent LastBent;
  Program RefinePrograms[2]; // [times the mask's weights]
  Program InvertProgram;
};
}

#endif
