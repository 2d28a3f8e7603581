// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Looks/Look.h"

#include <algorithm>
#include <iterator>

namespace brainshift
{
namespace
{
using Colors = std::vector<std::array<double, 4>>;
using Opacities = std::vector<std::array<double, 2>>;

// At 0 the darkest tissue that is seen, at 1 the brightest.
const Colors SkinColors{ { 0.0, 0.76, 0.55, 0.45 }, { 0.3, 0.87, 0.68, 0.57 },
  { 1.0, 0.99, 0.88, 0.80 } };
const Colors BrainColors{ { 0.0, 0.55, 0.31, 0.28 }, { 0.35, 0.84, 0.66, 0.60 },
  { 1.0, 0.97, 0.89, 0.84 } };
const Colors UltrasoundColors{ { 0.0, 0.20, 0.10, 0.03 }, { 0.4, 0.77, 0.50, 0.22 },
  { 1.0, 1.0, 0.93, 0.78 } };
const Colors GlassColors{ { 0.0, 0.62, 0.52, 0.48 }, { 0.5, 0.90, 0.76, 0.68 },
  { 1.0, 1.0, 0.97, 0.93 } };

// In Hounsfield units.
const Colors BoneColors{ { 150.0, 0.62, 0.46, 0.35 }, { 400.0, 0.90, 0.83, 0.70 },
  { 1200.0, 1.0, 0.98, 0.94 } };
const Opacities BoneOpacities{ { 150.0, 0.0 }, { 300.0, 1.0 } };
const Colors CTSkinColors{ { -350.0, 0.76, 0.55, 0.45 }, { -50.0, 0.87, 0.68, 0.57 },
  { 400.0, 0.99, 0.88, 0.80 } };
const Opacities CTSkinOpacities{ { -400.0, 0.0 }, { -200.0, 1.0 } };
const Colors VesselColors{ { 100.0, 0.55, 0.06, 0.05 }, { 250.0, 0.86, 0.25, 0.18 },
  { 450.0, 0.90, 0.83, 0.70 }, { 1200.0, 1.0, 0.98, 0.94 } };
const Opacities VesselOpacities{ { 120.0, 0.0 }, { 220.0, 0.35 }, { 400.0, 0.35 },
  { 700.0, 0.15 } };
const Opacities CTBrainOpacities{ { 5.0, 0.0 }, { 25.0, 1.0 }, { 80.0, 1.0 }, { 100.0, 0.0 } };

constexpr double Air = -850.0; // HU, and lower
constexpr double LeastAir = 0.02;
constexpr double LowestOfCT = -500.0;
constexpr double LeastOutside = 0.15; // of a volume with ultrasound: outside the fan
constexpr double DarkMode = 0.25;     // of the values' range: the commonest echo is darker
constexpr double MostRise = 1.5;      // from a valley
constexpr double Noise = 0.01;        // of the commonest

// The part of the voxels below a value.
double shareBelow(const Histogram& histogram, double value)
{
  double below = 0.0;
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin)
  {
    below += histogram.middle(bin) < value ? histogram.counts[bin] : 0.0;
  }
  return below / histogram.total();
}

bool isCT(const Intensities& values)
{
  return values.lowest <= LowestOfCT && values.highest > 0.0 &&
    shareBelow(values.all, Air) >= LeastAir;
}

// Whether there are ever fewer voxels the brighter they are, but for noise, from a dark mode on.
bool fallsFromDark(const std::vector<double>& counts)
{
  // Wide enough to be smooth. The ends hold what lies outside the fan, and rare values.
  std::array<double, 32> parts{};
  for (std::size_t bin = 1; bin + 1 < counts.size(); ++bin)
  {
    parts[bin * parts.size() / counts.size()] += counts[bin];
  }
  const auto mode = std::max_element(parts.begin(), parts.end());
  double valley = *mode;
  bool rises = false;
  for (auto part = mode; part != parts.end(); ++part)
  {
    valley = std::min(valley, *part);
    rises = rises || *part > MostRise * valley + Noise * *mode;
  }
  return !rises && mode - parts.begin() <= DarkMode * parts.size();
}

bool isUltrasound(const Intensities& values)
{
  const std::vector<double>& counts = values.all.counts;
  return counts.front() >= LeastOutside * values.all.total() && fallsFromDark(counts);
}

Colors between(const Colors& colors, double low, double high)
{
  Colors placed = colors;
  for (auto& color : placed)
  {
    color[0] = low + color[0] * (high - low);
  }
  return placed;
}

// The numbers at a value, linear between points and even beyond them. Points begin with a value.
template <std::size_t Size>
std::array<double, Size> at(const std::vector<std::array<double, Size>>& points, double value)
{
  const auto after = std::find_if(
    points.begin(), points.end(), [&](const auto& point) { return point[0] >= value; });
  std::array<double, Size> result = after == points.end() ? points.back() : *after;
  if (after != points.end() && after != points.begin())
  {
    const auto& low = *(after - 1);
    const double within = (value - low[0]) / (result[0] - low[0]);
    for (std::size_t i = 1; i < Size; ++i)
    {
      result[i] = low[i] + within * (result[i] - low[i]);
    }
  }
  result[0] = value;
  return result;
}

// The same curve from the lowest to the highest value: ParaView's editors then show both curves
// over the range of the data.
template <std::size_t Size>
std::vector<std::array<double, Size>> over(
  const Intensities& values, const std::vector<std::array<double, Size>>& points)
{
  std::vector<std::array<double, Size>> curve{ at(points, values.lowest) };
  std::copy_if(points.begin(), points.end(), std::back_inserter(curve),
    [&](const auto& point) { return point[0] > values.lowest && point[0] < values.highest; });
  curve.push_back(at(points, std::max(values.highest, values.lowest + values.all.width())));
  return curve;
}

Look made(
  const Intensities& values, const Colors& colors, const Opacities& opacities, double tissue)
{
  return { over(values, colors), over(values, opacities), false, tissue };
}

Look solid(const Intensities& values, const Colors& colors, double low, double full)
{
  const double top = std::max(percentile(values.all, 0.995), full + (full - low));
  return made(
    values, between(colors, low, top), { { low, 0.0 }, { full, 1.0 } }, 0.5 * (low + full));
}

// Above the darkest value, below which nearly all of the noise in air lies; 0 if what is darker
// than a threshold is no such noise. In MR it has a Rayleigh distribution (Gudbjartsson and Patz,
// Magnetic Resonance in Medicine 34(6), 1995): its tenths 1, 5 and 9 are told from those of tissue
// and of air that was set to 0.
double noiseOfAir(const Histogram& all, double threshold)
{
  constexpr double Deviation = 1.0 / 1.1774; // of the middle
  constexpr double MostDeviations = 4.0;     // one voxel in 3000 is brighter
  const double below = shareBelow(all, threshold);
  const auto tenth = [&](int number) { return percentile(all, 0.1 * number * below) - all.low; };
  const double middle = tenth(5);
  const bool isNoise = tenth(1) < 0.5 * middle && tenth(9) > 1.6 * middle; // 0.39 and 1.82 times
  return isNoise ? MostDeviations * Deviation * middle : 0.0;
}

// The darkest tissue that is seen: a part of the way from air to Otsu's threshold, but above noise.
double firstSeen(const Intensities& values, double part)
{
  const double threshold = otsuThreshold(values.all);
  const double above = threshold - values.all.low;
  return values.all.low +
    std::max(part * above, std::min(noiseOfAir(values.all, threshold), above));
}

// The surface lies where the values leave the background: well below Otsu's threshold, which lies
// between air and the mean of all tissue.
Look skin(const Intensities& values)
{
  const double above = otsuThreshold(values.all) - values.all.low;
  const double low = firstSeen(values, 0.45);
  return solid(values, SkinColors, low, low + 0.3 * above);
}

Look glass(const Intensities& values)
{
  const double low = firstSeen(values, 0.5);
  const double top = std::max(percentile(values.all, 0.995), low + values.all.width());
  const double reach = top - low;
  return made(values, between(GlassColors, low, top),
    { { low, 0.0 }, { low + 0.1 * reach, 0.03 }, { low + 0.5 * reach, 0.06 },
      { low + reach, 0.35 } },
    low + 0.1 * reach);
}

Look inHounsfield(const Intensities& values, const Colors& colors, const Opacities& opacities)
{
  return made(values, colors, opacities, 0.5 * (opacities[0][0] + opacities[1][0]));
}

// Fluid between the gyri is darker than nearly all tissue: it stays open.
Look brain(const Intensities& values)
{
  if (values.segment.counts.empty()) // of a CT
  {
    return inHounsfield(values, between(BrainColors, 5.0, 60.0), CTBrainOpacities);
  }
  const double low = percentile(values.segment, 0.07);
  const double full = std::max(percentile(values.segment, 0.25), low + values.segment.width());
  const double top = std::max(percentile(values.segment, 0.99), full + (full - low));
  Look look = made(values, between(BrainColors, low, top), { { low, 0.0 }, { full, 1.0 } }, low);
  look.drawsSegment = true;
  return look;
}

Look ultrasound(const Intensities& values)
{
  const double outside = values.all.counts.front() / values.all.total();
  const auto echo = [&](double share) {
    return percentile(values.all, outside + share * (1.0 - outside));
  };
  const double low = echo(0.5);
  const double full = std::max(echo(0.95), low + values.all.width());
  const double top = std::max(echo(0.998), full + values.all.width());
  return made(values, between(UltrasoundColors, low, top),
    { { low, 0.0 }, { 0.5 * (low + full), 0.08 }, { full, 0.6 }, { top, 0.9 } }, low);
}

std::vector<const LookRow*> rowsFor(const Intensities& values)
{
  std::vector<const LookRow*> rows;
  if (values.empty() || values.areLabels)
  {
    return rows;
  }
  const VolumeKind kind = kindOf(values);
  for (const LookRow& row : lookTable())
  {
    if (row.fits(kind, values))
    {
      rows.push_back(&row);
    }
  }
  return rows;
}
}

VolumeKind kindOf(const Intensities& values)
{
  if (values.areLabels)
  {
    return VolumeKind::Labels;
  }
  return isCT(values)      ? VolumeKind::CT
    : isUltrasound(values) ? VolumeKind::Ultrasound
                           : VolumeKind::MR;
}

std::string nameOf(VolumeKind kind)
{
  switch (kind)
  {
    case VolumeKind::CT:
      return "CT";
    case VolumeKind::Ultrasound:
      return "Ultrasound";
    case VolumeKind::Labels:
      return "Labels";
    default:
      return "MR";
  }
}

const std::vector<LookRow>& lookTable()
{
  using Values = const Intensities&;
  constexpr const char* aboutSkin = "Show the outer surface without the background.";
  static const std::vector<LookRow> table{
    { "Skin", aboutSkin, false, [](VolumeKind kind, Values) { return kind == VolumeKind::MR; },
      skin },
    { "Bone", "Show bone: 150 HU and above.", false,
      [](VolumeKind kind, Values) { return kind == VolumeKind::CT; },
      [](Values values) { return inHounsfield(values, BoneColors, BoneOpacities); } },
    { "Ultrasound", "Show bright echoes. Dark ones are transparent.", false,
      [](VolumeKind kind, Values) { return kind == VolumeKind::Ultrasound; }, ultrasound },
    { "Brain", "Show the brain. Outside CT, this needs a segmentation.", true,
      [](VolumeKind kind, Values values) {
        return kind == VolumeKind::CT || !values.segment.counts.empty();
      },
      brain },
    { "Skin", aboutSkin, false, [](VolumeKind kind, Values) { return kind == VolumeKind::CT; },
      [](Values values) { return inHounsfield(values, CTSkinColors, CTSkinOpacities); } },
    { "Skin", aboutSkin, false,
      [](VolumeKind kind, Values) { return kind == VolumeKind::Ultrasound; }, skin },
    { "Vessels", "Show vessels with contrast agent: 120 HU and above.", false,
      [](VolumeKind kind, Values) { return kind == VolumeKind::CT; },
      [](Values values) { return inHounsfield(values, VesselColors, VesselOpacities); } },
    { "See-through", "Show the inside through a faint surface.", false,
      [](VolumeKind kind, Values) { return kind == VolumeKind::MR; }, glass },
  };
  return table;
}

std::vector<std::string> looksOf(const Intensities& values)
{
  std::vector<std::string> names;
  for (const LookRow* row : rowsFor(values))
  {
    names.emplace_back(row->name);
  }
  return names;
}

Look makeLook(const std::string& name, const Intensities& values)
{
  for (const LookRow* row : rowsFor(values))
  {
    if (name == row->name)
    {
      return row->make(values);
    }
  }
  return {};
}
}
