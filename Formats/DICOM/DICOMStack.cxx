// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMStack.h"

#include "Common/Numbers.h"
#include "Formats/DICOM/DICOMTimes.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace brainshift
{
namespace
{
// Images nearer than this fraction of a pixel are at one position.
constexpr double SamePlacePixels = 0.01;
// What images of one volume have in common: the first so many numbers of a moment.
constexpr std::size_t SharedNumbers = 8;
// SliceLocation may differ so far at one position; scanners round it.
constexpr double LargestUnreportedContradictionMm = 0.1;

using Images = std::vector<DICOMFrame>;
using SharedKey = std::array<double, SharedNumbers>;

// Images of one orientation.
struct DICOMPlaces
{
  std::vector<std::vector<DICOMFrame>> volumes; // of each time; images from below to above
  std::vector<double> times;                    // s; at least one
  std::string noteOfDays;                       // the end of a sentence; may be empty
  std::string noteOfTriggers;                   // likewise
  std::string noteOfTimes;                      // likewise
  std::vector<std::string> contradictions;      // ends of sentences
  std::size_t copies = 0;                       // images left out: the same image in another file
  std::size_t leftOver = 0;                     // images left out: their place has more than others
};

SharedKey sharedKey(const DICOMFrame& image)
{
  const auto sorted = image.moment.sorted();
  SharedKey key{};
  std::copy_n(sorted.begin(), SharedNumbers, key.begin());
  return key;
}

double toleranceMm(const DICOMFrame& image)
{
  return SamePlacePixels * std::min(image.spacingMm.x, image.spacingMm.y);
}

// The same image may lie in a folder twice, under two names. Images at other positions are others,
// whatever their UID says.
Images withoutCopies(
  const std::vector<DICOMFile>& files, const Images& images, std::vector<std::string>& notes)
{
  std::map<std::pair<std::string, int>, glm::dvec3> seen;
  Images kept;
  bool isUsedTwice = false;
  for (const DICOMFrame& image : images)
  {
    const std::string& instance = files[image.file].instance;
    const auto [first, isNew] = seen.insert({ { instance, image.frame }, image.position });
    const bool isElsewhere = glm::distance(first->second, image.position) > toleranceMm(image);
    isUsedTwice = isUsedTwice || (isElsewhere && !instance.empty());
    if (instance.empty() || isNew || isElsewhere)
    {
      kept.push_back(image);
    }
  }
  if (isUsedTwice)
  {
    notes.emplace_back("has the same SOPInstanceUID in images at different positions, which count "
                       "as different images");
  }
  return kept;
}

// How far SliceLocation differs at most between images at one position, mm.
double contradictionOf(const std::vector<Images>& places)
{
  double largest = 0.0;
  for (const Images& place : places)
  {
    for (const DICOMFrame& image : place)
    {
      const auto& first = place.front().locationMm;
      largest = first && image.locationMm ? std::max(largest, std::abs(*image.locationMm - *first))
                                          : largest;
    }
  }
  return largest;
}

// Images of each place, from below to above.
std::vector<Images> byPlace(const Images& images)
{
  const std::vector<double> distancesMm = placesOf(images);
  const glm::dvec3 normal = glm::cross(images.front().alongRow, images.front().alongColumn);
  std::vector<Images> places(distancesMm.size());
  for (const DICOMFrame& image : images)
  {
    const auto above =
      std::upper_bound(distancesMm.begin(), distancesMm.end(), glm::dot(image.position, normal));
    places[static_cast<std::size_t>(above - distancesMm.begin()) - 1].push_back(image);
  }
  return places;
}

void sortByMoment(std::vector<Images>& places)
{
  for (Images& place : places)
  {
    std::stable_sort(place.begin(), place.end(), [](const DICOMFrame& a, const DICOMFrame& b) {
      return std::make_pair(a.moment.sorted(), a.frame) <
        std::make_pair(b.moment.sorted(), b.frame);
    });
  }
}

// Images of a place that equal the one before in all that tells images apart.
std::size_t dropTwins(std::vector<Images>& places)
{
  std::size_t dropped = 0;
  for (Images& place : places)
  {
    const auto last =
      std::unique(place.begin(), place.end(), [](const DICOMFrame& a, const DICOMFrame& b) {
        return a.moment.sorted() == b.moment.sorted() && a.frame == b.frame;
      });
    dropped += static_cast<std::size_t>(place.end() - last);
    place.erase(last, place.end());
  }
  return dropped;
}

// The moments that every place has once. Empty if there are none.
std::vector<SharedKey> completeMoments(const std::vector<Images>& places)
{
  std::map<SharedKey, std::size_t> placesWith;
  for (const Images& place : places)
  {
    std::set<SharedKey> ofPlace;
    for (const DICOMFrame& image : place)
    {
      if (!ofPlace.insert(sharedKey(image)).second)
      {
        return {};
      }
      ++placesWith[sharedKey(image)];
    }
  }
  std::vector<SharedKey> complete;
  for (const auto& [key, count] : placesWith)
  {
    if (count == places.size())
    {
      complete.push_back(key);
    }
  }
  return complete;
}

// Each place gives one image to each volume: by shared moments, or else one after the other.
std::vector<Images> volumesOf(const std::vector<Images>& places)
{
  std::size_t fewest = places.front().size();
  bool isEven = true;
  for (const Images& place : places)
  {
    isEven = isEven && place.size() == places.front().size();
    fewest = std::min(fewest, place.size());
  }
  const std::vector<SharedKey> moments =
    isEven ? std::vector<SharedKey>() : completeMoments(places);
  std::vector<Images> volumes(moments.empty() ? fewest : moments.size());
  for (std::size_t i = 0; i < volumes.size(); ++i)
  {
    for (const Images& place : places)
    {
      const auto found = moments.empty()
        ? place.begin() + static_cast<std::ptrdiff_t>(i)
        : std::find_if(place.begin(), place.end(),
            [&](const DICOMFrame& image) { return sharedKey(image) == moments[i]; });
      volumes[i].push_back(*found);
    }
  }
  return volumes;
}

// Whether images of a volume differ in echo, diffusion weighting or another setting.
bool areSettingsMixed(const std::vector<Images>& volumes)
{
  return std::any_of(volumes.begin(), volumes.end(), [](const Images& volume) {
    return std::any_of(volume.begin(), volume.end(),
      [&](const DICOMFrame& image) { return !image.moment.hasSettingsOf(volume.front().moment); });
  });
}

// Divides the sorted images of each place among volumes. Without triggers, if those would mix
// diffusion weightings or other settings.
void divide(std::vector<Images>& places, DICOMPlaces& sorted)
{
  sorted.volumes = volumesOf(places);
  if (sorted.volumes.size() > 1 && areSettingsMixed(sorted.volumes))
  {
    const std::string note = leaveTriggers(places);
    sortByMoment(places);
    std::vector<Images> volumes = volumesOf(places);
    if (!areSettingsMixed(volumes))
    {
      sorted.noteOfTriggers = note;
      sorted.volumes = std::move(volumes);
      return;
    }
    sorted.contradictions.emplace_back(
      "has volumes whose slices differ in echo, diffusion weighting or another setting");
  }
}

// Sorts images by place and time. Times come from offsets, the heart's trigger or the acquisition;
// if they do not grow, from the time between volumes that the header names.
DICOMPlaces sortedByPlace(
  const std::vector<DICOMFile>& files, const std::vector<DICOMFrame>& images)
{
  DICOMPlaces sorted;
  const Images unique = withoutCopies(files, images, sorted.contradictions);
  std::vector<Images> places = byPlace(unique);
  sorted.noteOfDays = passMidnight(places);
  sorted.noteOfTriggers = compareTriggers(places);
  sortByMoment(places);
  const double contradictionMm = contradictionOf(places);
  if (contradictionMm > LargestUnreportedContradictionMm)
  {
    sorted.contradictions.push_back(
      joined("has images at one position (ImagePositionPatient) whose "
             "SliceLocation differs by ",
        contradictionMm, " mm; the position counts"));
  }
  sorted.copies = images.size() - unique.size() + dropTwins(places);
  divide(places, sorted);
  sorted.leftOver =
    images.size() - sorted.copies - sorted.volumes.size() * sorted.volumes.front().size();
  sorted.times = timesOf(sorted.volumes, sorted.noteOfTimes);
  return sorted;
}

constexpr double MostResampled = 65535.0;  // that resampling may make
constexpr double FarthestDriftMm = 5000.0; // of slices that resampling may make room for
constexpr double MissingSteps = 1.5;       // a gap of so many steps lacks a slice
constexpr double SmallestError = 0.5;      // voxels; from here on slices are interpolated
constexpr double FineSteps = 0.5;          // of the usual step: a part of the volume is finer
constexpr double MostGrowth = 4.0;         // slices of an upright grid for each image

std::string counted(std::size_t count, const std::string& one, const std::string& many)
{
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

// Positions of the images of the first volume. All volumes have the same.
std::vector<glm::dvec3> positionsOf(const std::vector<DICOMFrame>& volume)
{
  std::vector<glm::dvec3> positions;
  positions.reserve(volume.size());
  for (const DICOMFrame& frame : volume)
  {
    positions.push_back(frame.position);
  }
  return positions;
}

// Steps from slice to slice along the normal, mm.
std::vector<double> stepsOf(const std::vector<glm::dvec3>& positions, const glm::dvec3& normal)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < positions.size(); ++i)
  {
    steps.push_back(glm::dot(positions[i] - positions[i - 1], normal));
  }
  return steps;
}

double medianOf(std::vector<double> numbers)
{
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

// How far slices lie at most from places that are evenly spaced from the first to the last.
double largestShift(const std::vector<glm::dvec3>& positions)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const double fraction = static_cast<double>(i) / static_cast<double>(positions.size() - 1);
    largest = std::max(largest,
      glm::distance(positions[i], glm::mix(positions.front(), positions.back(), fraction)));
  }
  return largest;
}

// How far the last slice lies from where the normal of the first leads.
double driftOf(const std::vector<glm::dvec3>& positions, const glm::dvec3& normal)
{
  const glm::dvec3 range = positions.back() - positions.front();
  return glm::length(range - glm::dot(range, normal) * normal);
}

std::string unevenSentence(
  const std::vector<double>& steps, double shiftMm, double usualMm, bool resamples)
{
  double missing = 0.0;
  for (const double step : steps)
  {
    missing += step > MissingSteps * usualMm ? std::round(step / usualMm) - 1.0 : 0.0;
  }
  std::ostringstream text;
  text << "has uneven slices";
  if (missing > 0.0)
  {
    text << ", as if " << missing << (missing == 1.0 ? " slice were" : " slices were")
         << " missing";
  }
  text << ": they are from " << roundedText(*std::min_element(steps.begin(), steps.end())) << " to "
       << roundedText(*std::max_element(steps.begin(), steps.end())) << " mm apart, and up to "
       << roundedText(shiftMm) << " mm from even places. They are ";
  text << (resamples ? "interpolated there; Resample Slices \"Never\" shows them as stored"
                     : "shown as if they were even; Resample Slices \"Always\" interpolates them");
  return text.str();
}

std::string tiltSentence(double driftMm, bool resamples)
{
  std::ostringstream text;
  text << "has tilted slices: the last is " << roundedText(driftMm)
       << " mm beside the normal of the first. "
       << (resamples
              ? "They are interpolated on an upright grid; Resample Slices \"Never\" shows them as "
                "stored"
              : "Resample Slices \"Always\" interpolates them on an upright grid");
  return text.str();
}

glm::dvec3 rasFromLps(const glm::dvec3& lps)
{
  return { -lps.x, -lps.y, lps.z };
}

void placeVoxels(const DICOMFrame& first, const glm::dvec3& step, glm::dmat4& worldFromVoxel)
{
  worldFromVoxel[0] = glm::dvec4(rasFromLps(first.spacingMm.x * first.alongRow), 0.0);
  worldFromVoxel[1] = glm::dvec4(rasFromLps(first.spacingMm.y * first.alongColumn), 0.0);
  worldFromVoxel[2] = glm::dvec4(rasFromLps(step), 0.0);
  worldFromVoxel[3] = glm::dvec4(rasFromLps(first.position), 1.0);
}

// The slice of an upright grid at a distance from the first image.
DICOMSlice sliceAt(double distanceMm, const std::vector<double>& steps)
{
  DICOMSlice slice;
  double belowMm = 0.0;
  while (slice.lower + 1 < steps.size() && belowMm + steps[slice.lower] <= distanceMm)
  {
    belowMm += steps[slice.lower++];
  }
  slice.lowerWeight = 1.0 - glm::clamp((distanceMm - belowMm) / steps[slice.lower], 0.0, 1.0);
  return slice;
}

// Where each image lies on a grid that holds them all; moves `origin` to its first voxel.
void shiftImages(const std::vector<DICOMFrame>& volume, const DICOMFile& file,
  DICOMResampling& resampling, glm::dvec3& origin)
{
  const DICOMFrame& first = volume.front();
  glm::dvec2 least(0.0);
  glm::dvec2 most(0.0);
  std::vector<glm::dvec2> shifts;
  for (const DICOMFrame& frame : volume)
  {
    const glm::dvec3 away = frame.position - first.position;
    shifts.push_back(glm::dvec2(glm::dot(away, first.alongRow), glm::dot(away, first.alongColumn)) /
      first.spacingMm);
    least = glm::min(least, shifts.back());
    most = glm::max(most, shifts.back());
  }
  for (const glm::dvec2& shift : shifts)
  {
    resampling.shifts.push_back({ shift.x - least.x, shift.y - least.y });
  }
  constexpr double Rounding = 1e-6; // pixels; a drift of less needs no room
  resampling.columns = file.columns + static_cast<int>(std::ceil(most.x - least.x - Rounding));
  resampling.rows = file.rows + static_cast<int>(std::ceil(most.y - least.y - Rounding));
  origin +=
    least.x * first.spacingMm.x * first.alongRow + least.y * first.spacingMm.y * first.alongColumn;
}

// How far slices are shown at most from their position on an even, upright grid about their centre:
// the largest of the errors along the axes of the image, in voxels.
double errorOfEven(
  const std::vector<glm::dvec3>& positions, const DICOMFrame& first, double usualMm)
{
  const glm::dvec3 normal = glm::normalize(glm::cross(first.alongRow, first.alongColumn));
  const glm::dvec3 range = positions.back() - positions.front();
  const glm::dvec3 upright = glm::dot(range, normal) * normal;
  const glm::dvec3 begin = positions.front() + 0.5 * (range - upright);
  glm::dvec3 largest(0.0);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const double fraction = static_cast<double>(i) / static_cast<double>(positions.size() - 1);
    const glm::dvec3 error = positions[i] - (begin + fraction * upright);
    largest = glm::max(largest,
      glm::abs(glm::dvec3(glm::dot(error, first.alongRow) / first.spacingMm.x,
        glm::dot(error, first.alongColumn) / first.spacingMm.y,
        glm::dot(error, normal) / usualMm)));
  }
  return std::max({ largest.x, largest.y, largest.z });
}

// The distance of slices on an upright grid: the usual one, or less where a part of the volume has
// much finer slices.
double uprightStep(const std::vector<double>& steps, double heightMm, double usualMm)
{
  const double least = *std::min_element(steps.begin(), steps.end());
  return least >= FineSteps * usualMm
    ? usualMm
    : std::max(least, heightMm / (MostGrowth * static_cast<double>(steps.size())));
}

// Places the slices of the volumes, on an upright grid if that is wanted, needed and possible.
void placeSlices(DICOMStack& stack, const DICOMFile& file, SliceResampling resampling)
{
  const std::vector<DICOMFrame>& volume = stack.volumes.front();
  DICOMFrame first = volume.front();
  const glm::dvec3 normal = glm::normalize(glm::cross(first.alongRow, first.alongColumn));
  const std::vector<glm::dvec3> positions = positionsOf(volume);
  if (positions.size() == 1)
  {
    if (!first.knowsStep)
    {
      stack.warnings.emplace_back(
        "has one slice without a SliceThickness; it counts as 1 mm thick");
    }
    placeVoxels(first, first.sliceStepMm * normal, stack.worldFromVoxel);
    return;
  }
  const glm::dvec3 range = positions.back() - positions.front();
  const double heightMm = glm::dot(range, normal);
  const std::vector<double> steps = stepsOf(positions, normal);
  const double usualMm = medianOf(steps);
  const double shiftMm = largestShift(positions);
  const double driftMm = driftOf(positions, normal);
  const bool isUneven = shiftMm > LargestUnreportedShiftMm;
  const bool isTilted = driftMm > std::max(LargestUnreportedShiftMm, 1e-4 * heightMm);
  const double count = std::round(heightMm / uprightStep(steps, heightMm, usualMm)) + 1.0;
  const bool isPossible = count >= 2.0 && count <= MostResampled && driftMm < FarthestDriftMm;
  const bool isWanted = resampling == SliceResampling::Always ||
    (resampling == SliceResampling::WhereNeeded &&
      errorOfEven(positions, first, usualMm) >= SmallestError);
  const bool isResampled = isWanted && (isUneven || isTilted) && isPossible;
  if (isUneven)
  {
    stack.warnings.push_back(unevenSentence(steps, shiftMm, usualMm, isResampled));
  }
  if (isTilted)
  {
    stack.warnings.push_back(tiltSentence(driftMm, isResampled));
  }
  glm::dvec3 step = range / static_cast<double>(positions.size() - 1);
  if (isResampled)
  {
    step = heightMm / (count - 1.0) * normal;
    shiftImages(volume, file, stack.resampling, first.position);
    for (double slice = 0.0; slice < count; slice += 1.0)
    {
      stack.resampling.slices.push_back(sliceAt(slice * heightMm / (count - 1.0), steps));
    }
  }
  placeVoxels(first, step, stack.worldFromVoxel);
}

// Images without places: one after the other by their number, as far apart as the header says.
void placeByNumber(std::vector<DICOMFrame>& images)
{
  std::stable_sort(images.begin(), images.end(),
    [](const DICOMFrame& a, const DICOMFrame& b) { return a.moment.instance < b.moment.instance; });
  double z = 0.0;
  for (DICOMFrame& image : images)
  {
    image.position = glm::dvec3(0.0, 0.0, z);
    image.alongRow = glm::dvec3(-1.0, 0.0, 0.0); // to the right in RAS
    image.alongColumn = glm::dvec3(0.0, -1.0, 0.0);
    z += image.sliceStepMm;
  }
}
}

std::vector<double> placesOf(const std::vector<DICOMFrame>& images)
{
  const glm::dvec3 normal = glm::cross(images.front().alongRow, images.front().alongColumn);
  std::vector<double> distancesMm;
  distancesMm.reserve(images.size());
  for (const DICOMFrame& image : images)
  {
    distancesMm.push_back(glm::dot(image.position, normal));
  }
  std::sort(distancesMm.begin(), distancesMm.end());
  std::size_t places = 0; // the lowest image of each place stays
  for (const double distanceMm : distancesMm)
  {
    if (places == 0 || distanceMm - distancesMm[places - 1] > toleranceMm(images.front()))
    {
      distancesMm[places++] = distanceMm;
    }
  }
  distancesMm.resize(places);
  return distancesMm;
}

DICOMStack stackOf(const std::vector<DICOMFile>& files, const std::vector<DICOMFrame>& images,
  SliceResampling resampling)
{
  DICOMStack stack;
  std::vector<DICOMFrame> placed = images;
  stack.knowsSides = images.front().isPlaced;
  if (!stack.knowsSides)
  {
    placeByNumber(placed);
    stack.warnings.emplace_back("has no positions of its images; they are shown in the order of "
                                "their numbers, and left and right may be exchanged");
    if (!placed.front().knowsStep && placed.size() > 1)
    {
      stack.warnings.emplace_back(
        "has neither SpacingBetweenSlices nor SliceThickness; slices count as 1 mm apart");
    }
  }
  const DICOMPlaces places = sortedByPlace(files, placed);
  stack.volumes = places.volumes;
  stack.times = places.times;
  if (places.copies > 0)
  {
    stack.warnings.push_back("has " +
      counted(places.copies, "duplicate image, which is", "duplicate images, which are") +
      " left out");
  }
  if (places.leftOver > 0)
  {
    stack.warnings.push_back("has " + counted(places.leftOver, "image", "images") +
      " at positions of other images, too few for another time step: left out");
  }
  for (const std::string& note : { places.noteOfDays, places.noteOfTriggers, places.noteOfTimes })
  {
    if (!note.empty())
    {
      stack.warnings.push_back(note);
    }
  }
  stack.warnings.insert(
    stack.warnings.end(), places.contradictions.begin(), places.contradictions.end());
  placeSlices(stack, files[stack.volumes.front().front().file], resampling);
  return stack;
}
}
