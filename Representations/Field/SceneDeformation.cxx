// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Field/SceneDeformation.h"

#include "Common/Guard.h"
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Representations/Scene/FieldPlace.h"

#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <sstream>

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
  this->Map.reset();
  this->Problem = sentenceThrownBy("The deformation", [&] {
    if (carriesDeformation(image))
    {
      this->read(image);
      this->deformed = true;
    }
  });
  problem = this->Problem;
  return problem.empty();
}

void SceneDeformation::require(vtkImageData* image)
{
  if (!this->Problem.empty())
  {
    this->Problem.clear();
    this->time = 0;
  }
  std::string problem;
  this->update(image, problem);
  throwIfAny(this->Problem);
}

void SceneDeformation::read(vtkImageData* image)
{
  Deformation source = readDeformation(image);
  this->lattice = effectiveLattice(source);
  requireOffsetFieldMemory(this->lattice, source.samples);
  this->deviations = std::move(source.deviations);
  this->request.dimensions = this->lattice.grid.dimensions;
  this->request.kernel = this->lattice.kernel;
  this->request.samples = source.samples;
  this->request.inverse = source.inverse;
  this->request.inCells = displacementsInCells(this->lattice);
  this->request.nodes = backwardNodes(this->lattice.grid, this->request.inCells, source.samples);
  this->request.mask = this->lattice.mask;
  this->moved = movedHull(this->lattice.grid.dimensions, this->request.inCells);
}

const PointMap& SceneDeformation::map()
{
  if (!this->Map)
  {
    this->Map = std::make_unique<PointMap>(this->lattice, this->request.inverse);
  }
  return *this->Map;
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
    sizes.corrected = true;
    sizes.masked = this->request.mask != nullptr;
  }
}

double allowedMissMm(const glm::dvec3& spacing)
{
  constexpr double leastMm = 0.05;
  constexpr double ofVoxel = 0.05;
  return std::max(leastMm, ofVoxel * std::min({ spacing.x, spacing.y, spacing.z }));
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
  const bool corrects = this->Corrects && !gpu.moving;
  if (this->FieldTime != deformation.time || this->OffsetScale != offsetScale)
  {
    if (!this->compute(gpu, deformation, offsetScale))
    {
      return false;
    }
    change = { this->Field.changed(), this->Field.bent() };
    if (!corrects)
    {
      this->Field.leaveOutCorrections();
    }
  }
  if (this->Field.isRough() && corrects)
  {
    this->correct(gpu, deformation, values);
    change.computed = enclosing(change.computed, this->Field.changed());
    change.bent = this->Field.bent();
  }
  field = bentField(values, lattice, deformation.request.nodes);
  field.offsets = this->Field.offsets();
  field.moved = deformation.moved;
  field.corrections.codes = this->Field.fine().codes();
  field.corrections.values = this->Field.fine().corrections();
  return true;
}

bool DeviceDeformation::compute(
  GpuTask& gpu, SceneDeformation& deformation, const glm::vec3& offsetScale)
{
  deformation.request.offsetScale = offsetScale;
  const glm::ivec3& nodes = deformation.request.nodes.count; // no fewer than the mask's
  const int longest = std::max({ nodes.x, nodes.y, nodes.z });
  const int limit = vtkTextureObject::GetMaximumTextureSize3D(gpu.window);
  if (longest > limit)
  {
    return gpu.fail("The deformation takes " + std::to_string(longest) +
      " nodes along one axis; the GPU takes at most " + std::to_string(limit) +
      ". Decrease Samples or Lattice Dimensions, or the strokes that lead far out of the volume");
  }
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
  return true;
}

// Without corrections the picture is less exact, but it is a picture.
void DeviceDeformation::correct(
  GpuTask& gpu, SceneDeformation& deformation, const DrawnValues& values)
{
  Accuracy accuracy;
  accuracy.map = &deformation.map();
  accuracy.mmFromCell = glm::vec3(deformation.lattice.grid.spacing);
  accuracy.allowedMm = static_cast<float>(allowedMissMm(values.grid.spacing));
  const bool corrected = this->Field.correct(gpu.window, accuracy, gpu.counters);
  if (!corrected)
  {
    gpu.remarks.emplace_back(
      "This GPU cannot make the 3D textures that make the drawn deformation exact");
  }
  else if (this->Field.fine().leftOut())
  {
    std::ostringstream remark;
    remark
      << "The deformation varies so strongly that parts of it are drawn with errors of more than "
      << roundedText(accuracy.allowedMm) << " mm. Increase Samples for a more exact picture";
    gpu.remarks.push_back(remark.str());
  }
}

bool DeviceDeformation::askForMemory(
  GpuTask& gpu, GpuMemory& memory, MemoryNeed need, double limitMiB)
{
  this->MostCorrectionBytes =
    std::max({ this->MostCorrectionBytes, this->Field.fine().bytes(), need.corrections });
  need.corrections = need.corrections > 0 ? this->MostCorrectionBytes : 0;
  gpu.problem = memory.ask(gpu.window, need, limitMiB);
  this->Corrects = gpu.problem.empty();
  if (!this->Corrects && need.corrections > 0)
  {
    need.corrections = 0;
    const std::string refused = gpu.problem;
    gpu.problem = memory.ask(gpu.window, need, limitMiB);
    if (gpu.problem.empty())
    {
      gpu.remarks.push_back(refused + ". So the deformation is drawn less exactly");
    }
    else
    {
      gpu.problem = refused; // names all that would be needed
    }
    this->Field.forgetCorrections();
  }
  gpu.lacksMemory = !gpu.problem.empty();
  return !gpu.lacksMemory;
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
  this->MostCorrectionBytes = 0;
}
}
