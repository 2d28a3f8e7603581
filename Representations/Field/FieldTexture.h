// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The offset field on the GPU: uploads the control points, refines them, inverts the map and
/// corrects it.
#ifndef BrainShift_FieldTexture_h
#define BrainShift_FieldTexture_h

#include "Representations/Field/FineTextures.h"
#include "Representations/Gpu/Program.h"

#include <memory>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
struct NodeWeights;

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

  /// Corrects what the updates since the last call have changed, so that the field misses by no
  /// more than `accuracy` allows. False if a texture cannot be made: then nothing is corrected.
  /// Each update is followed by this or by leaveOutCorrections.
  bool correct(vtkOpenGLRenderWindow* window, const Accuracy& accuracy, Counters& counters);

  /// Leaves the field trilinear between its nodes where the last update has changed it.
  void leaveOutCorrections();

  /// Leaves it so everywhere, and gives their memory back.
  void forgetCorrections();

  /// Whether there is something to correct.
  bool isRough() const { return !this->Rough.empty(); }

  /// Offsets (restFromDeformed minus identity): RGBA32F, one texel a node, trilinear, clamped. The
  /// fourth number is at least FineCells::reaches.
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

  /// What is added to the offsets.
  const FineTextures& fine() const { return this->Fine; }

  /// How far tissue may be from where it rests along each axis, lattice cells.
  glm::vec3 farthestMove() const;

  /// Nodes that the last update or correction computed.
  const IndexBox& changed() const { return this->Changed; }

  /// Where place or light of tissue changed.
  struct Bent
  {
    bool all = false;               ///< Anywhere.
    std::vector<glm::vec3> corners; ///< Only between these positions, lattice coordinates.

    /// Takes what another change has changed, too.
    void add(const Bent& other);
  };

  /// What the last update or correction changed.
  const Bent& bent() const { return this->LastBent; }

  /// All textures; some may be null.
  std::vector<vtkTextureObject*> textures() const;

  void releaseGraphicsResources(vtkWindow* window);

private:
  Bent bentBy(const FieldRequest& request) const;
  void roughen(bool allNew);
  IndexBox allNodes() const { return { glm::ivec3(0), this->Current.nodes.count - 1 }; }
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
  FineTextures Fine;
  IndexBox Computed;         // nodes of the last update
  IndexBox Rough;            // nodes that were computed since the last correction
  Bent RoughBent;            // what these changed
  IndexBox Unfinished;       // nodes around cells for which there was no place left
  Program RefinePrograms[2]; // [times the mask's weights]
  Program InvertProgram;
};
}

#endif
