// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Field/SceneDeformation.h"

#include "Filters/Attached/HostMemory.h"
#include "Representations/Gpu/GpuTask.h"
#include "Representations/Scene/FieldPlace.h"

#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

namespace brainshift
{
bool SceneDeformation::update(vtkImageData* image, std::string& problem)
{
  const unsigned long long latest = deformationTime(image);
  if (latest == this->time)
  {
    return true;
  }
  this->time = latest;
  this->deformed = false; // not before all of it succeeded
  Deformation source;
  if (!carriesDeformation(image) || !readDeformation(image, source, problem))
  {
    return problem.empty();
  }
  this->lattice = effectiveLattice(source);
  problem = offsetFieldProblem(this->lattice, source.samples);
  if (!problem.empty())
  {
    return false;
  }
  this->request.dimensions = this->lattice.grid.dimensions;
  this->request.kernel = this->lattice.kernel;
  this->request.samples = source.samples;
  this->request.inverse = source.inverse;
  this->request.inCells = displacementsInCells(this->lattice);
  this->request.nodes = backwardNodes(this->lattice.grid, this->request.inCells, source.samples);
  this->request.mask = this->lattice.mask;
  this->moved = movedHull(this->lattice.grid.dimensions, this->request.inCells);
  this->deformed = true;
  return true;
}

void SceneDeformation::widen(double bounds[6]) const
{
  if (this->deformed)
  {
    widenByNodes(this->lattice.grid, this->request.nodes, bounds);
  }
}

void SceneDeformation::addSizes(DrawnSizes& sizes) const
{
  if (this->deformed)
  {
    sizes.forwardNodes = (this->request.dimensions - 1) * (this->request.samples + 1) + 1;
    sizes.backwardNodes = this->request.nodes.count;
    sizes.masked = this->request.mask != nullptr;
  }
}

bool DeviceDeformation::update(GpuTask& gpu, SceneDeformation& deformation,
  const DrawnValues& values, SceneField& field, Change& change)
{
  change = Change();
  if (!deformation.deformed)
  {
    field = restField(values.layout);
    return true;
  }
  const Grid& lattice = deformation.lattice.grid;
  const glm::vec3 offsetScale(textureFromLattice(values, lattice));
  if (this->FieldTime != deformation.time || this->OffsetScale != offsetScale)
  {
    deformation.request.offsetScale = offsetScale;
    this->Timer.Start();
    const bool updated = this->Field.update(gpu.window, deformation.request, gpu.counters);
    this->Timer.Stop();
    if (!updated)
    {
      return gpu.fail("The deformation's shaders do not compile or its 3D float textures cannot be "
                      "made on this GPU");
    }
    this->FieldTime = deformation.time;
    this->OffsetScale = offsetScale;
    change = { this->Field.changed(), this->Field.bent() };
  }
  field = bentField(values, lattice, deformation.request.nodes);
  field.offsets = this->Field.offsets();
  field.moved = deformation.moved;
  return true;
}

void DeviceDeformation::askTime(std::int64_t& microseconds)
{
  constexpr std::int64_t nanosecondsInMicrosecond = 1000;
  if (this->Timer.Stopped() && this->Timer.Ready())
  {
    microseconds =
      static_cast<std::int64_t>(this->Timer.GetElapsedNanoseconds()) / nanosecondsInMicrosecond;
  }
}

void DeviceDeformation::releaseGraphicsResources(vtkWindow* window)
{
  this->Field.releaseGraphicsResources(window);
  this->Timer.ReleaseGraphicsResources();
}
}
