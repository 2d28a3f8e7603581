// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The corrections of an offset field on the GPU of one window, see FineCells.h.
#ifndef BrainShift_FineTextures_h
#define BrainShift_FineTextures_h

#include "Representations/Field/FineCells.h"
#include "Representations/Gpu/GpuTask.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h" // for its smart pointer

class vtkOpenGLRenderWindow;

namespace brainshift
{
/// An offset field on the GPU.
struct DrawnOffsets
{
  vtkTextureObject* texture = nullptr; ///< RGBA32F; the fourth number becomes FineCells::reaches.
  FieldNodes nodes;
  glm::vec3 scale{ 1.0f }; ///< Of one lattice cell, in the texture's unit.
};

/// Textures for the corrections, and for where they are.
class FineTextures
{
public:
  /// There are no corrections. `nodes`: those of the offset field.
  void reset(const FieldNodes& nodes);

  /// Forgets the corrections in the cells around some nodes, whose offsets have changed.
  void leaveOut(const IndexBox& changedNodes);

  /// Finds the corrections in the cells around some nodes anew. False if a texture cannot be made:
  /// then there are no corrections at all.
  bool correct(vtkOpenGLRenderWindow* window, const DrawnOffsets& offsets, const Accuracy& accuracy,
    const IndexBox& changedNodes, Counters& counters);

  /// Nodes whose fourth number the last correction has written.
  const IndexBox& written() const { return this->Written; }

  /// Whether the last correction has left out some that are needed.
  bool leftOut() const { return this->LeftOut; }

  /// FineCells::code of each cell, one float; as many texels as nodes. Null: no cell had
  /// corrections since the last reset.
  vtkTextureObject* codes() const { return this->Codes; }

  /// The corrections, lattice cells: SlotsInRow slots along x, RowsInLayer along y.
  vtkTextureObject* corrections() const { return this->Corrections; }

  const FineCells& cells() const { return this->Fine; }

  /// What both textures take, bytes.
  std::int64_t bytes() const;

  /// All textures; some may be null.
  std::vector<vtkTextureObject*> textures() const { return { this->Codes, this->Corrections }; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool correctAround(vtkOpenGLRenderWindow* window, const DrawnOffsets& offsets,
    const Accuracy& accuracy, const IndexBox& changedNodes, Counters& counters);
  bool correctSome(vtkOpenGLRenderWindow* window, const DrawnOffsets& offsets,
    const Accuracy& accuracy, const IndexBox& cells, Counters& counters);
  bool makeCodes(vtkOpenGLRenderWindow* window, const glm::ivec3& count);
  bool makeRoom(vtkOpenGLRenderWindow* window);
  void uploadCodes(const IndexBox& cells, Counters& counters);
  void uploadReaches(const DrawnOffsets& offsets, const IndexBox& nodes,
    const std::vector<glm::vec4>& texels, const IndexBox& cells, Counters& counters);
  bool uploadCorrections(vtkOpenGLRenderWindow* window, Counters& counters);

  FineCells Fine;
  IndexBox Written;
  bool LeftOut = false;
  vtkSmartPointer<vtkTextureObject> Codes;
  vtkSmartPointer<vtkTextureObject> Corrections;
};
}

#endif
