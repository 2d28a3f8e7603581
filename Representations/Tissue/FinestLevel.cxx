// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/FinestLevel.h"

#include "Representations/Gpu/GpuTask.h"
#include "Representations/Tissue/TissueTextures.h"

#include "vtkTextureObject.h"

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int CoarsestSide = 32; // texels; a head has 8 mm for each

long long texelsOf(const ValueLayout& layout)
{
  const glm::ivec3& side = layout.dimensions;
  return static_cast<long long>(side.x) * side.y * side.z;
}

// A sentence on what the user can do, or nothing.
std::string wayOut(FinerBy finerBy)
{
  switch (finerBy)
  {
    case FinerBy::Level:
      return ". With a lower Memory Limit of its OME-Zarr Reader, all voxels are drawn where the "
             "view needs them";
    case FinerBy::Pyramid:
      return ". Saved as an OME-Zarr image, all its voxels are drawn where the view needs them: "
             "press Draw All Voxels in the status bar, or call brainshift.draw_from_pyramid";
    case FinerBy::Nothing:
      break;
  }
  return {};
}

std::string remarkOn(const std::string& problem, const glm::ivec3& joined, FinerBy finerBy)
{
  return problem + ". So it is drawn coarser: one value for " + std::to_string(joined.x) + " x " +
    std::to_string(joined.y) + " x " + std::to_string(joined.z) + " voxels" + wayOut(finerBy);
}
}

glm::ivec3 voxelsPerTexel(
  const glm::ivec3& voxels, const glm::dvec3& spacing, int level, int longest)
{
  const double side = (level + 1) * std::min({ spacing.x, spacing.y, spacing.z });
  const glm::dvec3 joined = glm::round(side / spacing);
  const glm::ivec3 least = (voxels + longest - 1) / longest;
  return glm::max(glm::ivec3(glm::clamp(joined, glm::dvec3(1.0), glm::dvec3(voxels))), least);
}

bool FinestLevel::draw(GpuTask& gpu, TissueRequest& tissue, const MemoryNeed& need, double limitMiB,
  const std::function<bool()>& attempt)
{
  const ValueLayout whole = tissue.values.layout;
  const Circumstances now{ whole.voxels,
    need.scalars + need.gradients + need.colors + need.segment + need.images + need.reference,
    limitMiB, ScalarTexture::givenBack() };
  if (!(this->Found == now))
  {
    this->Refused = this->Found.givenBack == now.givenBack ? this->Refused : 0;
    this->Found = now;
    this->Level = 0;
    this->Problem.clear();
  }
  const std::size_t remarks = gpu.remarks.size();
  const int longest = vtkTextureObject::GetMaximumTextureSize3D(gpu.window);
  if (this->Problem.empty() && glm::any(glm::greaterThan(whole.dimensions, glm::ivec3(longest))))
  {
    this->Problem = textureProblem(gpu.window, whole.dimensions); // level 0 joins voxels, too
  }
  for (int level = this->Level;; ++level)
  {
    const glm::ivec3 joined =
      voxelsPerTexel(whole.voxels, tissue.values.grid.spacing, level, longest);
    tissue.values.layout = joined == glm::ivec3(1) ? whole : coarser(whole, joined);
    const ValueLayout& layout = tissue.values.layout;
    if (this->attempt(gpu, layout, attempt))
    {
      this->Level = level;
      this->Found.givenBack = ScalarTexture::givenBack(); // on the way, by this volume
      gpu.counters.gpuVoxelsPerTexel = static_cast<std::int64_t>(joined.x) * joined.y * joined.z;
      const bool isCoarser = !layout.isWhole();
      gpu.counters.gpuNeedsPyramid = isCoarser && tissue.finerBy == FinerBy::Pyramid ? 1 : 0;
      if (isCoarser)
      {
        gpu.remarks.push_back(remarkOn(this->Problem, joined, tissue.finerBy));
      }
      return true;
    }
    this->Problem = this->Problem.empty() ? gpu.problem : this->Problem;
    const glm::ivec3& side = layout.dimensions;
    if (!gpu.lacksMemory || std::max({ side.x, side.y, side.z }) <= CoarsestSide)
    {
      gpu.problem = gpu.lacksMemory ? this->Problem : gpu.problem;
      this->Level = 0;
      this->Problem.clear();
      this->Found.givenBack = ScalarTexture::givenBack();
      gpu.counters.gpuNeedsPyramid = 0;
      return false;
    }
    gpu.remarks.resize(remarks); // of what was not drawn
  }
}

bool FinestLevel::attempt(
  GpuTask& gpu, const ValueLayout& layout, const std::function<bool()>& attempt)
{
  gpu.lacksMemory = gpu.refused = false;
  gpu.problem.clear();
  const std::string problem = textureProblem(gpu.window, layout.dimensions);
  if (!problem.empty())
  {
    return gpu.refuse(problem);
  }
  const long long texels = texelsOf(layout);
  if (this->Refused > 0 && texels >= this->Refused)
  {
    return gpu.refuse(refusedTexture(layout.dimensions));
  }
  if (attempt())
  {
    return true;
  }
  this->Refused = gpu.refused ? texels : this->Refused;
  return false;
}
}
