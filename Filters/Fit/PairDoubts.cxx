// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/PairDoubts.h"

#include "Filters/Fit/OpenRotation.h"
#include "Filters/Fit/PlaceDoubts.h"
#include "Filters/Fit/RigidPose.h"

#include <numeric>

namespace brainshift
{
namespace
{
constexpr double SamePlaceMm = 1e-3;
constexpr double ApartMm = 1.0;          // of places that are not the same
constexpr double MostScale = 2.0;        // between two lists of the same tissue
constexpr double LikelyScale = 1.25;     // ... if a scale explains most of the rest
constexpr double FarRotation = 0.8;      // rad: more is rather another frame
constexpr double NearRotation = 0.3;     // rad: of the frame that would fit
constexpr double ClearlyWorseMm = 2.0;   // RMS of a rotation above that of other axes
constexpr double OutlierMedians = 6.0;   // of the others' residuals ...
constexpr double OutlierMm = 8.0;        // ... and more: what one pair is off by
constexpr std::size_t FewestOfMatch = 4; // pairs that can tell a scale, or that two are exchanged
constexpr std::size_t MostSuspects = 6;  // pairs that may be exchanged: those that fit least

using Points = std::vector<glm::dvec3>;
using Sentences = std::vector<std::string>;

// A rotation that takes points to others, how far it turns (rad) and what it leaves (RMS, mm).
struct Match
{
  double angle = 0.0;
  double rms = 0.0;
  double scale = 1.0;     // that fits best besides the rotation ...
  double scaledRms = 0.0; // ... and what that leaves
  std::vector<double> residuals;
};

Match matchOf(const Points& from, const Points& to, const std::vector<double>& weights)
{
  const glm::dmat3 rotation = nearestRotation(from, to, weights);
  const glm::dvec3 middle = weightedMean(from, weights);
  const glm::dvec3 other = weightedMean(to, weights);
  Match match;
  double squares = 0.0;
  double all = 0.0;
  double lengths = 0.0;
  double others = 0.0;
  double products = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    const glm::dvec3 rotated = rotation * (from[i] - middle);
    const glm::dvec3 wanted = to[i] - other;
    match.residuals.push_back(glm::distance(rotated, wanted));
    squares += weights[i] * match.residuals[i] * match.residuals[i];
    all += weights[i];
    lengths += weights[i] * glm::dot(rotated, rotated);
    others += weights[i] * glm::dot(wanted, wanted);
    products += weights[i] * glm::dot(rotated, wanted);
  }
  match.angle = glm::length(vectorFrom(rotation));
  match.rms = std::sqrt(squares / all);
  match.scale = lengths > 0.0 ? products / lengths : 1.0;
  match.scaledRms = std::sqrt(std::max(0.0, others - match.scale * products) / all);
  return match;
}

// The axes of a signed permutation: its row i has the sign at column order[i].
struct Axes
{
  int order[3];
  int signs;

  glm::dvec3 of(const glm::dvec3& point) const
  {
    glm::dvec3 result;
    for (int i = 0; i < 3; ++i)
    {
      result[i] = (this->signs >> i & 1 ? -1.0 : 1.0) * point[this->order[i]];
    }
    return result;
  }

  std::string text() const
  {
    std::string words;
    for (int i = 0; i < 3; ++i)
    {
      words +=
        std::string(i > 0 ? " " : "") + (this->signs >> i & 1 ? "-" : "") + "xyz"[this->order[i]];
    }
    return words;
  }

  int changes() const
  {
    int count = 0;
    for (int i = 0; i < 3; ++i)
    {
      count += (this->signs >> i & 1) + (this->order[i] != i ? 1 : 0);
    }
    return count;
  }
};

std::vector<Axes> allAxes()
{
  std::vector<Axes> all;
  for (const auto& order : { Axes{ { 0, 1, 2 }, 0 }, Axes{ { 0, 2, 1 }, 0 }, Axes{ { 1, 0, 2 }, 0 },
         Axes{ { 1, 2, 0 }, 0 }, Axes{ { 2, 0, 1 }, 0 }, Axes{ { 2, 1, 0 }, 0 } })
  {
    for (int signs = 0; signs < 8; ++signs)
    {
      all.push_back(order);
      all.back().signs = signs;
    }
  }
  return all;
}

// Pairs that are switched on.
struct Pairs
{
  Points rest;
  Points measured;
  std::vector<double> weights;
  std::vector<std::string> names;
};

void addOpen(const OpenRotation& open, const Pairs& pairs, Sentences& sentences)
{
  if (open.isAboutAll())
  {
    sentences.emplace_back(
      "The landmarks are at one place, or too near to each other, so no rotation is determined; "
      "away from them the position is unknown");
  }
  else if (open.isAboutLine())
  {
    const glm::dvec3& axis = open.axes[0];
    sentences.push_back("The landmarks lie within " +
      threeDigits(spreadAroundLine(pairs.rest, pairs.weights)) + " mm (RMS) of a line along " +
      threeDigits(axis.x) + " " + threeDigits(axis.y) + " " + threeDigits(axis.z) +
      ", so the rotation about it is not determined; add one that is beside it");
  }
}

// Two landmarks at one place of one list; one such pair shows what to look for.
void addRepeated(const Pairs& pairs, Sentences& sentences)
{
  const auto near = [&](const Points& points, std::size_t i, std::size_t j) {
    return glm::distance(points[i], points[j]) <= SamePlaceMm;
  };
  for (std::size_t i = 0; i < pairs.rest.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const std::string both = "Landmarks " + pairs.names[j] + " and " + pairs.names[i];
      if (near(pairs.rest, i, j))
      {
        sentences.push_back(both + " are at the same place at rest, measured " +
          threeDigits(glm::distance(pairs.measured[i], pairs.measured[j])) + " mm apart");
        return;
      }
      if (near(pairs.measured, i, j) && glm::distance(pairs.rest[i], pairs.rest[j]) > ApartMm)
      {
        sentences.push_back(both + " are measured at the same place, at rest " +
          threeDigits(glm::distance(pairs.rest[i], pairs.rest[j])) + " mm apart");
        return;
      }
    }
  }
}

// Whether the measured landmarks are a scaled copy of those at rest.
void addScale(const Pairs& pairs, Sentences& sentences)
{
  const Match match = matchOf(pairs.rest, pairs.measured, pairs.weights);
  double ratio = extentOf(pairs.measured) / std::max(extentOf(pairs.rest), SamePlaceMm);
  const bool isFar = pairs.rest.size() > 2 && (ratio > MostScale || ratio * MostScale < 1.0);
  const bool isScaled = pairs.rest.size() >= FewestOfMatch &&
    (match.scale > LikelyScale || match.scale * LikelyScale < 1.0) &&
    match.scaledRms < 0.5 * match.rms;
  if (isFar || isScaled)
  {
    ratio = isScaled ? match.scale : ratio;
    sentences.push_back("The measured landmarks are " + threeDigits(ratio) +
      " times as far apart as those at rest; check that both are in mm");
  }
}

// The pairs that fit least.
std::vector<std::size_t> suspectsOf(const Match& match)
{
  std::vector<std::size_t> order(match.residuals.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) {
    return match.residuals[one] > match.residuals[other];
  });
  order.resize(std::min(order.size(), MostSuspects));
  return order;
}

// Whether two landmarks fit each other's measurement. True if so.
bool addExchanged(const Pairs& pairs, const Match& match, Sentences& sentences)
{
  const std::vector<std::size_t> suspects = suspectsOf(match);
  double least = std::min(0.5 * match.rms, match.rms - ClearlyWorseMm);
  std::string sentence;
  Points measured = pairs.measured;
  for (const std::size_t i : suspects)
  {
    for (const std::size_t j : suspects)
    {
      if (i < j)
      {
        std::swap(measured[i], measured[j]);
        const double rms = matchOf(pairs.rest, measured, pairs.weights).rms;
        std::swap(measured[i], measured[j]);
        sentence = rms < least ? "Landmarks " + pairs.names[i] + " and " + pairs.names[j] +
            " look exchanged: with the measured positions of each other the landmarks fit to " +
            threeDigits(rms) + " mm (RMS), as they are to " + threeDigits(match.rms) + " mm"
                               : sentence;
        least = std::min(least, rms);
      }
    }
  }
  sentences.insert(sentences.end(), sentence.empty() ? 0 : 1, sentence);
  return !sentence.empty();
}

// How far a pair is from a match of all others, and their median.
std::pair<double, double> missOf(const Pairs& pairs, std::size_t one)
{
  std::vector<double> weights = pairs.weights;
  weights[one] = 0.0;
  std::vector<double> residuals = matchOf(pairs.rest, pairs.measured, weights).residuals;
  const double miss = residuals[one];
  residuals.erase(residuals.begin() + static_cast<std::ptrdiff_t>(one));
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return { miss, *middle };
}

// Whether one pair is off by far more than all others.
void addOutlier(const Pairs& pairs, const Match& match, Sentences& sentences)
{
  for (const std::size_t i : suspectsOf(match))
  {
    const auto [miss, median] = missOf(pairs, i);
    if (miss > OutlierMedians * median + OutlierMm)
    {
      sentences.push_back("Landmark " + pairs.names[i] + " is measured " + threeDigits(miss) +
        " mm from where a rigid motion of the others puts it, which are off by " +
        (median < 0.01 ? "less than 0.01" : threeDigits(median)) + " mm (median); check this pair");
      return; // the worst shows what to look for
    }
  }
}

// What is suspicious about single pairs, if a rigid motion is looked for.
void addWrongPairs(const Pairs& pairs, Sentences& sentences)
{
  if (pairs.rest.size() < FewestOfMatch)
  {
    return;
  }
  const Match match = matchOf(pairs.rest, pairs.measured, pairs.weights);
  if (!addExchanged(pairs, match, sentences) && pairs.rest.size() > FewestOfMatch)
  {
    addOutlier(pairs, match, sentences);
  }
}
}

std::string betterAxes(const Points& rest, const Points& measured,
  const std::vector<double>& weights, bool isAnyRotation)
{
  if (rest.size() < 3)
  {
    return {};
  }
  const Match now = matchOf(rest, measured, weights);
  const Axes* best = nullptr;
  const std::vector<Axes> all = allAxes();
  for (const Axes& axes : all)
  {
    Points other(measured.size());
    std::transform(measured.begin(), measured.end(), other.begin(),
      [&](const glm::dvec3& point) { return axes.of(point); });
    const Match then = matchOf(rest, other, weights);
    const bool isBetter = now.rms - then.rms > ClearlyWorseMm && then.rms < 0.5 * now.rms;
    const bool isNearer = !isAnyRotation && now.angle > FarRotation && then.angle < NearRotation &&
      then.rms < now.rms + 0.5 * ClearlyWorseMm;
    const bool fits = isNearer || (isBetter && (isAnyRotation || then.angle < NearRotation));
    best = fits && (!best || axes.changes() < best->changes()) ? &axes : best;
  }
  return best ? best->text() : std::string();
}

Sentences doubtsAbout(
  const Measurements& measured, const std::vector<std::string>& names, const Grid& volume)
{
  Pairs on;
  for (std::size_t i = 0; i < measured.landmarks.size(); ++i)
  {
    const PointPair& pair = measured.landmarks[i];
    if (isOn(pair))
    {
      on.rest.push_back(pair.rest);
      on.measured.push_back(pair.measured);
      on.weights.push_back(pair.weight);
      on.names.push_back(i < names.size() ? names[i] : std::to_string(i + 1));
    }
  }
  const Sentences places = placeDoubts(measured, volume);
  if (on.rest.empty())
  {
    return places;
  }
  Sentences sentences;
  const FitSettings settings;
  const OpenRotation open = openRotationOf(
    on.rest, on.weights, settings.landmarkDeviation, glm::radians(settings.rotationPriorDegrees));
  if (!bendsOnly(measured))
  {
    addOpen(open, on, sentences);
  }
  addRepeated(on, sentences);
  sentences.insert(sentences.end(), places.begin(), places.end());
  const std::size_t before = sentences.size();
  addScale(on, sentences);
  const std::string axes =
    open.isAboutLine() ? std::string() : betterAxes(on.rest, on.measured, on.weights, false);
  if (!axes.empty())
  {
    sentences.push_back("The axes of the two lists look exchanged or mirrored: the measured "
                        "landmarks would fit with " +
      axes + " in place of x y z; check whether both lists are RAS or LPS");
  }
  if (sentences.size() == before && !bendsOnly(measured))
  {
    addWrongPairs(on, sentences);
  }
  return sentences;
}
}
