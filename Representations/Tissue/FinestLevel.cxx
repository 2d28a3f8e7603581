// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/FinestLevel.h"

#include "Representations/Gpu/GpuTask.h"
#include "Representations/Tissue/TissueTextures.h"

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int CoarsestSide = 32; // texels: nobody wants to see fewer

long long texelsOf(const ValueLayout& layout)
{
  const glm::ivec3& side = layout.dimensions;
  return static_cast<long long>(side.x) * side.y * side.z;
}

std::string remarkOn(const std::string& problem, const glm::ivec3& joined)
{
  return problem + ". So it is drawn coarser: one value for " + std::to_string(joined.x) + " x " +
    std::to_string(joined.y) + " x " + std::to_string(joined.z) + " voxels";
}
}

glm::ivec3 voxelsPerTexel(const glm::ivec3& voxels, const glm::dvec3& spacing, int level)
{
  const double side = (level + 1) * std::min({ spacing.x, spacing.y, spacing.z });
  const glm::dvec3 joined = glm::round(side / spacing);
  return glm::ivec3(glm::clamp(joined, glm::dvec3(1.0), glm::dvec3(voxels)));
}

bool FinestLevel::draw(GpuTask& gpu, TissueRequest& tissue, const std::function<bool()>& attempt)
{
  const ValueLayout whole = tissue.values.layout;
  const std::size_t remarks = gpu.remarks.size();
  std::string problem; // of level 0
  for (int level = 0;; ++level)
  {
    if (level > 0)
    {
      const glm::ivec3 joined = voxelsPerTexel(whole.voxels, tissue.values.grid.spacing, level);
      tissue.values.layout = coarser(whole, joined);
    }
    const ValueLayout& layout = tissue.values.layout;
    if (this->attempt(gpu, layout, attempt))
    {
      const glm::ivec3& joined = layout.perTexel;
      gpu.counters.gpuVoxelsPerTexel = static_cast<std::int64_t>(joined.x) * joined.y * joined.z;
      if (level > 0)
      {
        gpu.remarks.push_back(remarkOn(problem, joined));
      }
      return true;
    }
    problem = level == 0 ? gpu.problem : problem;
    const glm::ivec3& side = layout.dimensions;
    if (!gpu.lacksMemory || std::max({ side.x, side.y, side.z }) <= CoarsestSide)
    {
      gpu.problem = gpu.lacksMemory ? problem : gpu.problem;
      return false;
    }
    gpu.remarks.resize(remarks); // of what was not drawn
  }
}

bool FinestLevel::attempt(
  GpuTask& gpu, const ValueLayout& layout, const std::function<bool()>& attempt)
{
  if (this->RefusedAt != ScalarTexture::givenBack())
  {
    this->Refused = 0;
  }
  gpu.lacksMemory = gpu.refused = false;
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
  if (gpu.refused)
  {
    this->Refused = texels;
    this->RefusedAt = ScalarTexture::givenBack();
  }
  return false;
}
}
