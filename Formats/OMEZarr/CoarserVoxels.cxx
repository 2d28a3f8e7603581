// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/CoarserVoxels.h"

#include "Common/Problem.h"

#include "vtkSetGet.h" // for the macro that visits types

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace brainshift
{
namespace
{
// Along one axis of space: where voxels lie between those of a coarser level.
struct Along
{
  std::int64_t first = 0;              // coarse voxel that is read
  std::int64_t count = 1;              // that are read
  std::vector<std::int64_t> low{ 0 };  // of each voxel: the coarse one below it, from `first` on
  std::vector<double> fraction{ 0.0 }; // of the way to the next
  std::int64_t step = 0;               // numbers from one coarse voxel to the next
  std::int64_t toStep = 0;             // numbers from one voxel to the next
};

double voxelsOf(const OMELevel& level, const OMEAxes& axes)
{
  double voxels = 1.0;
  for (const int axis : axes.space)
  {
    voxels *= axis < 0 ? 1.0 : static_cast<double>(level.array.shape[std::size_t(axis)]);
  }
  return voxels;
}

Along alongOf(const OMELevel& fine, const OMELevel& coarse, std::size_t axis, const ZarrBox& part)
{
  Along along;
  along.low.clear();
  along.fraction.clear();
  const auto last = static_cast<double>(coarse.array.shape[axis] - 1);
  for (std::int64_t i = 0; i < part.count[axis]; ++i)
  {
    const double position =
      fine.translation[axis] + fine.scale[axis] * static_cast<double>(part.first[axis] + i);
    const double index = (position - coarse.translation[axis]) / coarse.scale[axis];
    if (!std::isfinite(index))
    {
      throw Problem("has no place along an axis");
    }
    const double held = std::clamp(index, 0.0, last);
    along.low.push_back(static_cast<std::int64_t>(held));
    along.fraction.push_back(held - std::floor(held));
  }
  const auto [least, most] = std::minmax_element(along.low.begin(), along.low.end());
  along.first = *least;
  along.count = std::min(*most + 1, static_cast<std::int64_t>(last)) - along.first + 1;
  for (std::int64_t& low : along.low)
  {
    low -= along.first;
  }
  return along;
}

template <typename T>
T between(const T* corner, const std::array<Along, 3>& axes, const std::array<std::size_t, 3>& at)
{
  double sum = 0.0;
  for (unsigned int i = 0; i < 8; ++i)
  {
    double weight = 1.0;
    std::int64_t offset = 0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const Along& along = axes[axis];
      const bool isNext = ((i >> axis) & 1U) != 0;
      const double fraction = along.fraction[at[axis]];
      weight *= isNext ? fraction : 1.0 - fraction;
      offset += isNext ? along.step : 0;
    }
    if (weight == 1.0)
    {
      return corner[offset]; // a double does not hold every whole number of 8 bytes
    }
    sum += weight > 0.0 ? weight * static_cast<double>(corner[offset]) : 0.0; // not NaN * 0
  }
  return static_cast<T>(std::is_floating_point_v<T> ? sum : std::round(sum));
}

template <typename T>
void interpolate(const std::string& coarse, const std::array<Along, 3>& axes, char* numbers)
{
  const auto* const from = reinterpret_cast<const T*>(coarse.data());
  auto* const to = reinterpret_cast<T*>(numbers);
  std::array<std::size_t, 3> at{};
  for (at[2] = 0; at[2] < axes[2].low.size(); ++at[2])
  {
    for (at[1] = 0; at[1] < axes[1].low.size(); ++at[1])
    {
      for (at[0] = 0; at[0] < axes[0].low.size(); ++at[0])
      {
        std::int64_t offset = 0;
        std::int64_t toOffset = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          offset += axes[axis].low[at[axis]] * axes[axis].step;
          toOffset += static_cast<std::int64_t>(at[axis]) * axes[axis].toStep;
        }
        to[toOffset] = between(from + offset, axes, at);
      }
    }
  }
}

// Fills a part of one channel and time.
void fillFrom(const ZarrStore& store, const OMEImage& image, std::array<const OMELevel*, 2> levels,
  const ZarrBox& part)
{
  const auto [fine, coarse] = levels;
  const ZarrType& type = fine->array.type;
  const bool isNearest = image.isLabelMap || type.isBoolean ||
    (type.bytes == 8 && type.vtkType != VTK_DOUBLE); // doubles would round them
  ZarrBox box{ part.first, std::vector<std::int64_t>(part.count.size(), 1), nullptr,
    std::vector<std::int64_t>(part.count.size(), 0) };
  std::array<Along, 3> axes;
  std::int64_t step = 1;
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (image.axes.space[i] < 0)
    {
      continue;
    }
    const auto axis = static_cast<std::size_t>(image.axes.space[i]);
    axes[i] = alongOf(*fine, *coarse, axis, part);
    axes[i].step = box.steps[axis] = step;
    axes[i].toStep = part.steps[axis];
    box.first[axis] = axes[i].first;
    box.count[axis] = axes[i].count;
    step *= axes[i].count;
    for (double& fraction : axes[i].fraction)
    {
      fraction = isNearest ? std::round(fraction) : fraction;
    }
  }
  std::string numbers(static_cast<std::size_t>(step) * type.bytes, '\0');
  box.numbers = numbers.data();
  readZarrBox(store, coarse->array, box, [](double) { return true; });
  switch (type.vtkType)
  {
    vtkTemplateMacro(interpolate<VTK_TT>(numbers, axes, part.numbers));
  }
}

// Fills a part with all its channels.
void fillChannels(const ZarrStore& store, const OMEImage& image,
  std::array<const OMELevel*, 2> levels, const ZarrBox& part)
{
  const int channel = image.axes.channel;
  const std::int64_t channels = channel < 0 ? 1 : part.count[std::size_t(channel)];
  for (std::int64_t i = 0; i < channels; ++i)
  {
    ZarrBox one = part;
    if (channel >= 0)
    {
      const auto axis = static_cast<std::size_t>(channel);
      one.first[axis] += i;
      one.count[axis] = 1;
      one.numbers += i * part.steps[axis] * static_cast<std::int64_t>(levels[0]->array.type.bytes);
    }
    fillFrom(store, image, levels, one);
  }
}

// Whether a level has the same channels and times, and numbers of the same type.
bool isAlike(const OMEImage& image, const OMELevel& fine, const OMELevel& coarse)
{
  bool isSame = fine.array.type.vtkType == coarse.array.type.vtkType;
  for (const int axis : { image.axes.time, image.axes.channel })
  {
    isSame = isSame &&
      (axis < 0 || fine.array.shape[std::size_t(axis)] == coarse.array.shape[std::size_t(axis)]);
  }
  return isSame;
}
}

std::size_t fillFromCoarser(
  const ZarrStore& store, const OMEImage& image, std::size_t level, const ZarrDamage& damage)
{
  const OMELevel& fine = image.levels[level];
  for (std::size_t i = 0; i < image.levels.size(); ++i)
  {
    const OMELevel& coarse = image.levels[i];
    if (voxelsOf(coarse, image.axes) < voxelsOf(fine, image.axes) && isAlike(image, fine, coarse) &&
      problemOf([&] { fillChannels(store, image, { &fine, &coarse }, damage.part); }).empty())
    {
      return i;
    }
  }
  throw Problem(damage.reason + "; no coarser level has its voxels");
}
}
