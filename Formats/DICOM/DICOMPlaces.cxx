// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMPlaces.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace brainshift
{
namespace
{
// Images nearer than this share of a pixel lie at one place.
constexpr double SamePlacePixels = 0.01;
// What images of one volume have in common: the first so many numbers of a moment.
constexpr std::size_t SharedNumbers = 4;

using Images = std::vector<DICOMFrame>;
using SharedKey = std::array<double, SharedNumbers>;

SharedKey sharedKey(const DICOMFrame& image)
{
  const auto sorted = image.moment.sorted();
  SharedKey key{};
  std::copy_n(sorted.begin(), SharedNumbers, key.begin());
  return key;
}

// The same image may lie in a folder twice, under two names.
Images withoutCopies(const std::vector<DICOMFile>& files, const Images& images)
{
  std::set<std::pair<std::string, int>> seen;
  Images kept;
  for (const DICOMFrame& image : images)
  {
    const std::string& instance = files[image.file].instance;
    if (instance.empty() || seen.insert({ instance, image.frame }).second)
    {
      kept.push_back(image);
    }
  }
  return kept;
}

double toleranceMm(const DICOMFrame& image)
{
  return SamePlacePixels * std::min(image.spacingMm.x, image.spacingMm.y);
}

// Images of each place, from below to above; those of one place by their moments.
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
  for (Images& place : places)
  {
    std::stable_sort(place.begin(), place.end(), [](const DICOMFrame& a, const DICOMFrame& b) {
      return std::make_pair(a.moment.sorted(), a.frame) <
        std::make_pair(b.moment.sorted(), b.frame);
    });
  }
  return places;
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

bool grows(const std::vector<double>& times)
{
  return std::adjacent_find(
           times.begin(), times.end(), [](double a, double b) { return !(a < b); }) == times.end();
}

std::vector<double> timesOf(const std::vector<Images>& volumes)
{
  std::vector<double> triggers;
  std::vector<double> acquired;
  std::vector<double> numbers;
  for (const Images& volume : volumes)
  {
    double first = volume.front().moment.acquiredS;
    for (const DICOMFrame& image : volume)
    {
      first = std::min(first, image.moment.acquiredS);
    }
    triggers.push_back(1e-3 * volume.front().moment.triggerMs);
    acquired.push_back(acquired.empty() ? first : first - acquired.front());
    numbers.push_back(static_cast<double>(numbers.size()));
  }
  acquired.front() = 0.0;
  if (volumes.size() == 1)
  {
    return { 0.0 };
  }
  return grows(triggers) ? triggers : grows(acquired) ? acquired : numbers;
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

DICOMPlaces sortedByPlace(
  const std::vector<DICOMFile>& files, const std::vector<DICOMFrame>& images)
{
  DICOMPlaces sorted;
  const Images unique = withoutCopies(files, images);
  std::vector<Images> places = byPlace(unique);
  sorted.copies = images.size() - unique.size() + dropTwins(places);
  sorted.volumes = volumesOf(places);
  sorted.leftOver =
    images.size() - sorted.copies - sorted.volumes.size() * sorted.volumes.front().size();
  sorted.times = timesOf(sorted.volumes);
  return sorted;
}
}
