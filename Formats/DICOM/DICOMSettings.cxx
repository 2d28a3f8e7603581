// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMSettings.h"

#include "Common/Numbers.h"
#include "Formats/DICOM/DICOMStack.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace brainshift
{
namespace
{
constexpr std::size_t SettingCount = 6;
using Setting = std::array<double, SettingCount>;
using Parts = std::map<Setting, std::vector<DICOMFrame>>;

struct SettingName
{
  const char* keyword;
  const char* unit;
};
constexpr std::array<SettingName, SettingCount> Names{ { { "EchoNumbers", "" },
  { "DiffusionBValue", " s/mm^2" }, { "EchoTime", " ms" }, { "InversionTime", " ms" },
  { "FlipAngle", " degrees" }, { "KVP", " kV" } } };

Setting settingOf(const DICOMFrame& frame)
{
  const DICOMMoment& moment = frame.moment;
  return { moment.echo, moment.bValue, moment.settings[0], moment.settings[1], moment.settings[2],
    moment.settings[3] };
}

// Images without those that lie in a folder twice.
std::size_t differentOf(const std::vector<DICOMFrame>& frames)
{
  std::set<std::tuple<decltype(DICOMMoment().sorted()), int, double, double, double>> found;
  for (const DICOMFrame& frame : frames)
  {
    const glm::dvec3& at = frame.position;
    found.insert({ frame.moment.sorted(), frame.frame, at.x, at.y, at.z });
  }
  return found.size();
}

// Whether each setting has as many images at every position: two or more.
bool areSeriesOfTimes(const Parts& parts, const std::vector<DICOMFrame>& all)
{
  const std::size_t places = placesOf(all).size();
  const std::size_t count = differentOf(parts.begin()->second);
  return parts.size() > 1 && count > places && count % places == 0 &&
    std::all_of(parts.begin(), parts.end(), [&](const auto& part) {
      return differentOf(part.second) == count && placesOf(part.second).size() == places;
    });
}

// The names and numbers in which a setting differs from another one.
std::string wordsOf(const Setting& setting, const std::array<bool, SettingCount>& differs)
{
  std::string words;
  for (std::size_t i = 0; i < SettingCount; ++i)
  {
    words += !differs[i] ? ""
                         : (words.empty() ? "" : ", ") + std::string(Names[i].keyword) + " " +
        roundedText(setting[i]) + Names[i].unit;
  }
  return words;
}
}

std::vector<DICOMSettingPart> partedBySetting(std::vector<DICOMFrame> images)
{
  Parts parts;
  for (const DICOMFrame& frame : images)
  {
    parts[settingOf(frame)].push_back(frame);
  }
  std::vector<DICOMSettingPart> parted;
  if (!images.front().isPlaced || !areSeriesOfTimes(parts, images))
  {
    parted.push_back({ std::move(images), {} });
    return parted;
  }
  std::array<bool, SettingCount> differs{};
  for (const auto& part : parts)
  {
    for (std::size_t i = 0; i < SettingCount; ++i)
    {
      differs[i] = differs[i] || part.first[i] != parts.begin()->first[i];
    }
  }
  for (auto& [setting, frames] : parts)
  {
    parted.push_back({ std::move(frames), wordsOf(setting, differs) });
  }
  return parted;
}
}
