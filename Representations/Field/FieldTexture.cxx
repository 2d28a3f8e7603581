// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Field/FieldTexture.h"

#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Lattice.h"
#include "Representations/Gpu/VolumePass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

namespace brainshift
{
namespace
{
// A float texture. Null if the GPU refuses.
vtkSmartPointer<vtkTextureObject> makeTexture(
  vtkOpenGLRenderWindow* window, const glm::ivec3& count, int filter)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetMinificationFilter(filter);
  texture->SetMagnificationFilter(filter);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetWrapR(vtkTextureObject::ClampToEdge);
  // Four components: three-component floats are the slowest format to sample.
  return texture->Allocate3D(count.x, count.y, count.z, 4, VTK_FLOAT) ? texture : nullptr;
}

// Nodes of the refined displacement.
FieldNodes forwardNodesOf(const FieldRequest& request)
{
  FieldNodes nodes;
  nodes.perCell = request.samples + 1;
  nodes.count = (request.dimensions - 1) * nodes.perCell + 1;
  return nodes;
}

// Whether the fields of two requests have the same nodes, so that the textures can be kept. Where
// neither request moves anything, both fields are zero.
bool sameNodes(const FieldRequest& a, const FieldRequest& b)
{
  return a.dimensions == b.dimensions && a.samples == b.samples && a.nodes == b.nodes;
}

// Whether equal control points make equal fields. Then control points that did not change leave the
// fields as they are, wherever both have nodes.
bool sameMeaning(const FieldRequest& a, const FieldRequest& b)
{
  return a.dimensions == b.dimensions && a.samples == b.samples && a.kernel == b.kernel &&
    a.inverse == b.inverse && a.offsetScale == b.offsetScale && sameMask(a.mask, b.mask);
}

glm::vec3 texelOf(const glm::ivec3& count)
{
  return 1.0f / glm::vec3(count);
}

// Control points that the nodes depend on.
IndexBox pointsAround(const IndexBox& nodes, int perCell, const glm::ivec3& dimensions)
{
  return { glm::max(nodes.first / perCell - 1, glm::ivec3(0)),
    glm::min(nodes.last / perCell + 2, dimensions - 1) };
}

std::int64_t texels(const glm::ivec3& count)
{
  return static_cast<std::int64_t>(count.x) * count.y * count.z;
}

// A box of nodes that moves with the strokes is made anew when it holds more than this many times
// the nodes that are needed.
constexpr std::int64_t MostSpare = 2;

bool holds(const IndexBox& box, const IndexBox& needed)
{
  return needed.empty() ||
    (enclosing(box, needed) == box && texels(box.size()) <= MostSpare * texels(needed.size()));
}
}

FieldTexture::FieldTexture() = default;
FieldTexture::~FieldTexture() = default;

FieldTexture::Bent FieldTexture::bentBy(const FieldRequest& request) const
{
  if (!this->HasCurrent || !sameMeaning(this->Current, request))
  {
    return { true, {} };
  }
  // The field is blended between nodes, and light reads it half a node farther.
  const float margin = 2.0f / static_cast<float>(request.nodes.perCell);
  return { false,
    cornersOfChange(request.dimensions, this->Current.inCells, request.inCells, margin) };
}

glm::vec3 FieldTexture::farthestMove() const
{
  glm::vec3 longest(0.0f);
  for (const glm::vec3& displacement : this->Current.inCells)
  {
    longest = glm::max(longest, glm::abs(displacement));
  }
  return KernelOvershoot * longest;
}

void FieldTexture::Bent::add(const Bent& other)
{
  constexpr std::size_t mostCorners = 8192;
  this->all = this->all || other.all;
  this->corners.insert(this->corners.end(), other.corners.begin(), other.corners.end());
  if (this->corners.size() > mostCorners)
  {
    glm::vec3 low = this->corners.front();
    glm::vec3 high = low;
    for (const glm::vec3& corner : this->corners)
    {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
    this->corners.clear();
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::vec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      this->corners.push_back(glm::mix(low, high, side));
    }
  }
}

// Corrections belong to the offsets that they were found for.
void FieldTexture::roughen(bool allNew)
{
  this->Computed = this->Changed;
  if (allNew)
  {
    this->Fine.reset(this->Current.nodes);
    this->Rough = this->Unfinished = IndexBox();
    this->RoughBent = Bent();
  }
  this->Rough = enclosing(enclosing(this->Rough, this->Changed), this->Unfinished);
  this->RoughBent.add(this->LastBent);
}

void FieldTexture::leaveOutCorrections()
{
  this->Fine.leaveOut(this->Computed);
}

void FieldTexture::forgetCorrections()
{
  if (!this->Fine.codes())
  {
    return;
  }
  this->Fine.reset(this->Current.nodes);
  this->Rough = this->allNodes();
  this->RoughBent = { true, {} };
}

bool FieldTexture::correct(
  vtkOpenGLRenderWindow* window, const Accuracy& accuracy, Counters& counters)
{
  const IndexBox rough = this->Rough;
  const DrawnOffsets offsets{ this->Offsets, this->Current.nodes, this->Current.offsetScale };
  const bool done = this->Fine.correct(window, offsets, accuracy, rough, counters);
  const IndexBox& written = this->Fine.written();
  const IndexBox around = this->Fine.cells().cellsAround(rough);
  // Others were corrected, too, if all places were given away anew.
  const bool others = !(enclosing(around, written) == IndexBox{ around.first, around.last + 1 });
  this->Changed = done ? written : this->allNodes();
  this->LastBent = done && !others ? this->RoughBent : Bent{ true, {} };
  this->Rough = IndexBox();
  this->RoughBent = Bent();
  this->Unfinished = this->Fine.leftOut() ? rough : IndexBox();
  return done;
}

bool FieldTexture::update(
  vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters)
{
  const bool kept = this->HasCurrent && sameNodes(this->Current, request);
  const std::vector<glm::vec3> still(request.inCells.size(), glm::vec3(0.0f));
  const std::vector<glm::vec3>& before = kept ? this->Current.inCells : still;
  // Where nothing moves both fields stay zero, whatever they mean.
  const IndexBox points = kept && sameMeaning(this->Current, request)
    ? changedPoints(request.dimensions, before, request.inCells)
    : enclosing(changedPoints(request.dimensions, still, before),
        changedPoints(request.dimensions, still, request.inCells));
  this->Changed =
    changedBackwardNodes(points, request.dimensions, before, request.inCells, request.nodes);
  this->LastBent = this->bentBy(request);
  const bool maskIsCurrent = this->HasCurrent && sameMask(this->Current.mask, request.mask);
  this->HasCurrent = false; // not before all of it succeeded
  if (!maskIsCurrent && !this->uploadMask(window, request, counters))
  {
    return false;
  }
  if (!kept && !this->makeOffsets(window, request))
  {
    return false;
  }
  const FieldNodes forward = forwardNodesOf(request);
  const IndexBox moved =
    changedForwardNodes(changedPoints(request.dimensions, still, request.inCells), forward);
  const bool grown = !(kept && holds(this->Displaced, moved));
  if (grown && !this->makeDisplacements(window, moved))
  {
    return false;
  }
  const IndexBox nodes = grown ? moved : changedForwardNodes(points, forward);
  if (!points.empty() &&
    (!this->upload(window, request, counters) || !this->refine(window, request, nodes, counters) ||
      !this->invert(window, request, counters)))
  {
    return false;
  }
  this->Current = request;
  this->roughen(!kept);
  if (!kept)
  {
    this->Changed = { glm::ivec3(0), request.nodes.count - 1 }; // the zeros are new too
  }
  this->HasCurrent = true;
  return true;
}

// Offsets of zero.
bool FieldTexture::makeOffsets(vtkOpenGLRenderWindow* window, const FieldRequest& request)
{
  this->Offsets = makeTexture(window, request.nodes.count, vtkTextureObject::Linear);
  if (!this->Offsets)
  {
    return false;
  }
  clearVolume(window, this->Offsets);
  return true;
}

// Displacements to be refined. On the surface of the box nothing moves, except at the end of the
// lattice, beyond which the displacement of its border holds. So a clamped texture answers for all
// nodes.
bool FieldTexture::makeDisplacements(vtkOpenGLRenderWindow* window, const IndexBox& nodes)
{
  this->Displaced = nodes;
  this->Displacements = nullptr;
  this->Lead = 0;
  if (nodes.empty())
  {
    return true;
  }
  this->Lead = leadToSecondThread(0, nodes.size().x);
  this->Displacements = makeTexture(window, this->heldNodes().size(), vtkTextureObject::Nearest);
  if (!this->Displacements)
  {
    return false;
  }
  clearVolume(window, this->Displacements);
  return true;
}

bool FieldTexture::upload(
  vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters)
{
  this->ControlPoints = vtkSmartPointer<vtkTextureObject>::New();
  this->ControlPoints->SetContext(window);
  const glm::ivec3& points = request.dimensions;
  counters.latticeUploads += 1;
  counters.bytesUploaded += static_cast<std::int64_t>(request.inCells.size() * sizeof(glm::vec3));
  return this->ControlPoints->Create3DFromRaw(
    points.x, points.y, points.z, 3, VTK_FLOAT, const_cast<glm::vec3*>(request.inCells.data()));
}

bool FieldTexture::uploadMask(
  vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters)
{
  this->MaskWeights = nullptr;
  if (!request.mask)
  {
    return true;
  }
  const glm::ivec3 nodes = (request.dimensions - 1) * request.mask->perCell + 1;
  this->MaskWeights = vtkSmartPointer<vtkTextureObject>::New();
  this->MaskWeights->SetContext(window);
  counters.bytesUploaded += texels(nodes) * static_cast<std::int64_t>(sizeof(float));
  return this->MaskWeights->Create3DFromRaw(
    nodes.x, nodes.y, nodes.z, 1, VTK_FLOAT, const_cast<float*>(request.mask->values.data()));
}

bool FieldTexture::refine(vtkOpenGLRenderWindow* window, const FieldRequest& request,
  const IndexBox& nodes, Counters& counters)
{
  const glm::mat4 weights = kernelPolynomials(request.kernel);
  const int perCell = request.samples + 1;
  const IndexBox displaced = this->heldNodes();
  glm::ivec3 count = request.dimensions;
  // A box of control points, which becomes, axis by axis, a box of nodes counted from the first
  // displaced one.
  IndexBox box = pointsAround(nodes, perCell, request.dimensions);
  // What is refined along x only, and along x and y only, is not kept: the next stroke computes
  // what it needs of these anew, and their memory is worth more.
  vtkSmartPointer<vtkTextureObject> coarse = this->ControlPoints;
  for (int axis = 0; axis < 3; ++axis)
  {
    const glm::vec3 coarseTexel = texelOf(count);
    count[axis] = displaced.size()[axis];
    box.first[axis] = nodes.first[axis] - displaced.first[axis];
    box.last[axis] = nodes.last[axis] - displaced.first[axis];
    vtkTextureObject* mask = axis == 2 ? this->MaskWeights : nullptr;
    Program& program = this->RefinePrograms[mask != nullptr];
    const vtkSmartPointer<vtkTextureObject> refined =
      axis == 2 ? this->Displacements : makeTexture(window, count, vtkTextureObject::Nearest);
    if (!refined || !program.use(window, refineSource(mask != nullptr), counters))
    {
      return false;
    }
    glm::vec3 unit(0.0f);
    unit[axis] = 1.0f;
    if (mask)
    {
      program.set("maskWeights", mask);
      program.set("maskTexel", texelOf((request.dimensions - 1) * perCell + 1));
    }
    program.set("coarse", coarse.Get());
    program.set("coarseTexel", coarseTexel);
    program.set("axis", unit);
    program.set("points", static_cast<float>(request.dimensions[axis]));
    program.set("perCell", static_cast<float>(perCell));
    program.set("firstNode", glm::vec3(displaced.first));
    program.set("weights", weights);
    runVolumePass(window, program.get()->GetHandle(), { refined }, box.first, box.size());
    coarse->Deactivate();
    if (mask)
    {
      mask->Deactivate();
    }
    coarse = refined;
  }
  return true;
}

bool FieldTexture::invert(
  vtkOpenGLRenderWindow* window, const FieldRequest& request, Counters& counters)
{
  if (!this->InvertProgram.use(window, invertSource(), counters))
  {
    return false;
  }
  const int perCell = request.nodes.perCell;
  const IndexBox displaced = this->heldNodes();
  const glm::vec3 texel = texelOf(displaced.size());
  this->InvertProgram.set("refined", this->Displacements.Get());
  this->InvertProgram.set("refinedFromNode", texel);
  this->InvertProgram.set("refinedOfNodeZero", (0.5f - glm::vec3(displaced.first)) * texel);
  this->InvertProgram.set("lastNode", glm::vec3((request.dimensions - 1) * perCell));
  this->InvertProgram.set("perCell", static_cast<float>(perCell));
  this->InvertProgram.set("firstNode", glm::vec3(request.nodes.first * perCell));
  this->InvertProgram.set("offsetScale", request.offsetScale);
  this->InvertProgram.set("negated", request.inverse == Inverse::Negated ? 1 : 0);
  runVolumePass(window, this->InvertProgram.get()->GetHandle(), { this->Offsets },
    this->Changed.first, this->Changed.size());
  this->Displacements->Deactivate();
  counters.texelsRefined += texels(this->Changed.size());
  return true;
}

std::vector<vtkTextureObject*> FieldTexture::textures() const
{
  std::vector<vtkTextureObject*> all = this->Fine.textures();
  all.insert(all.end(),
    { this->ControlPoints.Get(), this->Displacements.Get(), this->Offsets.Get(),
      this->MaskWeights.Get() });
  return all;
}

void FieldTexture::releaseGraphicsResources(vtkWindow* window)
{
  this->Fine.releaseGraphicsResources(window);
  this->Rough = this->Unfinished = IndexBox();
  this->RoughBent = Bent();
  for (vtkTextureObject* texture : { this->ControlPoints.Get(), this->Displacements.Get(),
         this->Offsets.Get(), this->MaskWeights.Get() })
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  this->ControlPoints = nullptr;
  this->Offsets = nullptr;
  this->MaskWeights = nullptr;
  this->Displacements = nullptr;
  this->Displaced = IndexBox();
  this->HasCurrent = false;
  this->RefinePrograms[0].forget();
  this->RefinePrograms[1].forget();
  this->InvertProgram.forget();
}
}
