// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMTimes.h"

#include "Common/Numbers.h"
#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr double HalfDayS = 0.5 * DayS;
constexpr double SameTriggerMs = 1.0; // files round them

using Images = std::vector<DICOMFrame>;

// An attribute that may say in which order images were made.
struct Witness
{
  const char* keyword;
  double (*rank)(const DICOMMoment&);
};

// What the times of day do at each position, in the order of a witness.
struct DayChanges
{
  int falls = 0;                                               // by more than half a day
  int rises = 0;                                               // likewise
  double lowestBefore = std::numeric_limits<double>::max();    // of images before a fall, s
  double highestAfter = std::numeric_limits<double>::lowest(); // of images after a fall, s
};

bool grows(const std::vector<double>& times)
{
  return std::adjacent_find(
           times.begin(), times.end(), [](double a, double b) { return !(a < b); }) == times.end();
}

// Whether volumes differ in what is no time, such as echoes and diffusion weightings.
bool isSeriesOfTime(const std::vector<Images>& volumes)
{
  const DICOMMoment& first = volumes.front().front().moment;
  return std::all_of(volumes.begin(), volumes.end(),
    [&](const Images& volume) { return volume.front().moment.hasSettingsOf(first); });
}

// Whether a setting, such as an echo, is there at several times of the heart or of a series.
bool hasSettingAtTimes(const std::vector<Images>& volumes)
{
  return std::any_of(volumes.begin(), volumes.end(), [&](const Images& one) {
    const DICOMMoment& a = one.front().moment;
    return std::any_of(volumes.begin(), volumes.end(), [&](const Images& other) {
      const DICOMMoment& b = other.front().moment;
      return a.hasSettingsOf(b) &&
        (a.temporalPosition != b.temporalPosition ||
          (a.isTriggerShared && a.triggerMs != b.triggerMs));
    });
  });
}

// Where neither triggers nor acquisitions say when volumes were made.
std::vector<double> countedTimes(const std::vector<Images>& volumes, std::string& note)
{
  if (!isSeriesOfTime(volumes))
  {
    note = hasSettingAtTimes(volumes)
      ? "has volumes of several echoes, diffusion weightings or other settings, of which not all "
        "have the same times; they are numbered 0, 1, 2 and so on"
      : "";
    return evenTimes(volumes.size(), 1.0);
  }
  const double intervalS = volumes.front().front().moment.intervalS;
  std::ostringstream text;
  text << "has " << volumes.size() << " volumes without times of their own; they ";
  if (intervalS > 0.0)
  {
    text << "count as " << intervalS << " s apart (TemporalResolution, or else RepetitionTime)";
  }
  else
  {
    text << "are numbered 0, 1, 2 and so on";
  }
  note = text.str();
  return evenTimes(volumes.size(), intervalS);
}

// Times of all images, the earliest first, s. Nothing if an image has none.
std::vector<double> sortedTimes(const std::vector<Images>& places)
{
  std::vector<double> times;
  for (const Images& place : places)
  {
    for (const DICOMFrame& image : place)
    {
      if (!image.moment.isTimed)
      {
        return {};
      }
      times.push_back(image.moment.acquiredS);
    }
  }
  std::sort(times.begin(), times.end());
  return times;
}

// Where an image has no time, those of others do not say the order.
void dropTimes(std::vector<Images>& places)
{
  for (Images& place : places)
  {
    for (DICOMFrame& image : place)
    {
      image.moment.acquiredS = 0.0;
    }
  }
}

// Adds what the images of one position do. False if the witness does not tell them apart.
bool addChanges(Images place, const Witness& witness, DayChanges& changes)
{
  std::stable_sort(place.begin(), place.end(), [&](const DICOMFrame& a, const DICOMFrame& b) {
    return witness.rank(a.moment) < witness.rank(b.moment);
  });
  for (std::size_t i = 1; i < place.size(); ++i)
  {
    const DICOMMoment& before = place[i - 1].moment;
    const DICOMMoment& after = place[i].moment;
    if (!(witness.rank(before) < witness.rank(after)))
    {
      return false;
    }
    const double stepS = after.acquiredS - before.acquiredS;
    changes.rises += stepS > HalfDayS ? 1 : 0;
    if (stepS < -HalfDayS)
    {
      ++changes.falls;
      for (std::size_t j = 0; j < place.size(); ++j)
      {
        const double timeS = place[j].moment.acquiredS;
        double& end = j < i ? changes.lowestBefore : changes.highestAfter;
        end = j < i ? std::min(end, timeS) : std::max(end, timeS);
      }
    }
  }
  return true;
}

// Nothing if the witness cannot say the order.
std::optional<DayChanges> changesBy(const Witness& witness, const std::vector<Images>& places)
{
  DayChanges changes;
  for (const Images& place : places)
  {
    if (!addChanges(place, witness, changes))
    {
      return {};
    }
  }
  const bool isCut = changes.rises == 0 && changes.highestAfter < changes.lowestBefore;
  const bool isDecided = changes.falls > 0 ? isCut : changes.rises > 0;
  return isDecided ? std::optional<DayChanges>(changes) : std::nullopt;
}

// The first time after the largest gap between times that grow; the first one if going over
// midnight would take longer.
double afterLargestGap(const std::vector<double>& times)
{
  double largest = DayS - (times.back() - times.front());
  double after = times.front();
  for (std::size_t i = 1; i < times.size(); ++i)
  {
    after = times[i] - times[i - 1] > largest ? times[i] : after;
    largest = std::max(largest, times[i] - times[i - 1]);
  }
  return after;
}

void moveToNextDay(std::vector<Images>& places, double beforeS)
{
  for (Images& place : places)
  {
    for (DICOMFrame& image : place)
    {
      image.moment.acquiredS += image.moment.acquiredS < beforeS ? DayS : 0.0;
    }
  }
}

// Whether images say another time of when they were made, with dates that fit in half a day.
bool hasContentOrder(const std::vector<Images>& places)
{
  double least = std::numeric_limits<double>::max();
  double most = std::numeric_limits<double>::lowest();
  for (const Images& place : places)
  {
    for (const DICOMFrame& image : place)
    {
      least = std::min(least, image.moment.contentS);
      most = std::max(most, image.moment.contentS);
    }
  }
  return least >= 0.0 && most - least < HalfDayS;
}

// The lowest of triggers that count as the same, in order, ms.
std::vector<double> differentTriggers(const std::vector<Images>& places)
{
  std::vector<double> all;
  for (const Images& place : places)
  {
    for (const DICOMFrame& image : place)
    {
      all.push_back(image.moment.triggerMs);
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<double> different;
  for (const double triggerMs : all)
  {
    if (different.empty() || triggerMs - different.back() > SameTriggerMs)
    {
      different.push_back(triggerMs);
    }
  }
  return different;
}

// Triggers of each place in order, ms; those that count as the same are equal.
std::vector<std::vector<double>> triggersOf(
  const std::vector<Images>& places, const std::vector<double>& different)
{
  std::vector<std::vector<double>> triggers;
  for (const Images& place : places)
  {
    std::vector<double>& ofPlace = triggers.emplace_back();
    for (const DICOMFrame& image : place)
    {
      ofPlace.push_back(
        *std::prev(std::upper_bound(different.begin(), different.end(), image.moment.triggerMs)));
    }
    std::sort(ofPlace.begin(), ofPlace.end());
  }
  return triggers;
}

// Whether each volume has triggers later than all of the one before, and the same settings.
bool areTriggersApart(const std::vector<Images>& volumes)
{
  const auto isEarlier = [](const DICOMFrame& a, const DICOMFrame& b) {
    return a.moment.triggerMs < b.moment.triggerMs;
  };
  for (std::size_t i = 1; i < volumes.size(); ++i)
  {
    const Images& before = volumes[i - 1];
    const Images& after = volumes[i];
    if (!isEarlier(*std::max_element(before.begin(), before.end(), isEarlier),
          *std::min_element(after.begin(), after.end(), isEarlier)))
    {
      return false;
    }
  }
  return isSeriesOfTime(volumes);
}
}

std::string passMidnight(std::vector<std::vector<DICOMFrame>>& places)
{
  const std::vector<double> times = sortedTimes(places);
  if (times.empty())
  {
    dropTimes(places);
  }
  const bool isSeries =
    std::any_of(places.begin(), places.end(), [](const Images& place) { return place.size() > 1; });
  if (!isSeries || times.empty() || times.back() - times.front() <= HalfDayS ||
    std::floor(times.front() / DayS) != std::floor(times.back() / DayS))
  {
    return {};
  }
  const std::string name =
    places.front().front().moment.isContentTime ? "ContentTime" : "AcquisitionTime";
  std::vector<Witness> witnesses{ { "TemporalPositionIdentifier",
    [](const DICOMMoment& moment) { return moment.temporalPosition; } } };
  if (hasContentOrder(places))
  {
    witnesses.push_back(
      { "ContentDate", [](const DICOMMoment& moment) { return moment.contentS; } });
  }
  witnesses.push_back(
    { "InstanceNumber", [](const DICOMMoment& moment) { return moment.instance; } });
  for (const Witness& witness : witnesses)
  {
    const std::optional<DayChanges> changes = changesBy(witness, places);
    if (changes && changes->falls > 0)
    {
      moveToNextDay(places, changes->lowestBefore);
      return joined("has times of day that fall by more than half a day (", name,
        ", in the order of ", witness.keyword, "): a day passed, which its dates do not say");
    }
    if (changes)
    {
      return joined("has images up to ", roundedText((times.back() - times.front()) / 3600.0),
        " hours apart on one date (", name, "), in the order of ", witness.keyword,
        "; if they were made over midnight, their order is another one");
    }
  }
  const double beginS = afterLargestGap(times);
  if (beginS == times.front())
  {
    return {};
  }
  moveToNextDay(places, beginS);
  return joined("has times of day more than half a day apart (", name,
    "), and no other attribute says their order: they count as made over midnight, which is the "
    "shortest span");
}

std::string compareTriggers(std::vector<Images>& places)
{
  const std::vector<double> different = differentTriggers(places);
  const std::vector<std::vector<double>> triggers = triggersOf(places, different);
  // A place may lack some images.
  const auto most = std::max_element(triggers.begin(), triggers.end(),
    [](const auto& a, const auto& b) { return a.size() < b.size(); });
  const bool areShared = std::all_of(triggers.begin(), triggers.end(), [&](const auto& ofPlace) {
    return std::includes(most->begin(), most->end(), ofPlace.begin(), ofPlace.end());
  });
  if (!areShared)
  {
    return leaveTriggers(places);
  }
  for (Images& place : places)
  {
    for (DICOMFrame& image : place)
    {
      double& triggerMs = image.moment.triggerMs;
      triggerMs = *std::prev(std::upper_bound(different.begin(), different.end(), triggerMs));
    }
  }
  return {};
}

std::string leaveTriggers(std::vector<Images>& places)
{
  bool isSeries = false;
  for (Images& place : places)
  {
    isSeries = isSeries || place.size() > 1;
    for (DICOMFrame& image : place)
    {
      image.moment.isTriggerShared = false;
    }
  }
  return isSeries
    ? "has triggers of the heart (TriggerTime) that differ from slice to slice; images "
      "of one position are sorted by other attributes"
    : "";
}

std::vector<double> timesOf(const std::vector<Images>& volumes, std::string& note)
{
  std::vector<double> offsets;
  std::vector<double> triggers;
  std::vector<double> acquired;
  std::vector<double> references;
  for (const Images& volume : volumes)
  {
    double first = volume.front().moment.acquiredS;
    for (const DICOMFrame& image : volume)
    {
      first = std::min(first, image.moment.acquiredS);
    }
    offsets.push_back(volume.front().moment.offsetS);
    triggers.push_back(1e-3 * volume.front().moment.triggerMs);
    acquired.push_back(acquired.empty() ? first : first - acquired.front());
    references.push_back(
      volume.front().moment.referenceS - volumes.front().front().moment.referenceS);
  }
  acquired.front() = 0.0;
  if (volumes.size() == 1)
  {
    return { 0.0 };
  }
  const bool areTriggersTimes =
    volumes.front().front().moment.isTriggerShared || areTriggersApart(volumes);
  if (grows(offsets) || (grows(triggers) && areTriggersTimes))
  {
    const bool areOfOneSlice = !grows(offsets) && !volumes.front().front().moment.isTriggerShared;
    note = areOfOneSlice ? "has times that are the triggers of its first slice" : "";
    return grows(offsets) ? offsets : triggers;
  }
  if (!grows(acquired))
  {
    return grows(references) ? references : countedTimes(volumes, note);
  }
  if (volumes.front().front().moment.isContentTime)
  {
    note = "has volumes without AcquisitionTime; their times are those of ContentTime, when images "
           "were made";
  }
  return acquired;
}
}
