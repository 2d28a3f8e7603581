// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/Stroke.h"

#include "Common/Problem.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace brainshift
{
namespace
{
Stroke strokeFromNumbers(const double* numbers)
{
  Stroke stroke;
  stroke.tool = static_cast<Tool>(static_cast<int>(numbers[0]));
  stroke.anchor = { numbers[1], numbers[2], numbers[3] };
  stroke.vector = { numbers[4], numbers[5], numbers[6] };
  stroke.axis = { numbers[7], numbers[8], numbers[9] };
  stroke.major = numbers[10];
  stroke.minor = numbers[11];
  stroke.sigma = numbers[12];
  stroke.enabled = numbers[13] != 0.0;
  return stroke;
}

bool isToolOfStrokes(double number)
{
  return std::any_of(KnownTools.begin(), KnownTools.end(), [number](const ToolTraits& traits) {
    return traits.shape != StrokeShape::None && number == static_cast<int>(traits.tool);
  });
}

// "0 (Move), 1 (Soft) or 2 (Stamp)"
std::string toolsOfStrokes()
{
  std::string text;
  for (const ToolTraits& traits : KnownTools)
  {
    if (traits.shape != StrokeShape::None)
    {
      text += (text.empty() ? "" : ", ") + std::to_string(static_cast<int>(traits.tool)) + " (" +
        traits.name + ")";
    }
  }
  const std::size_t last = text.rfind(", ");
  return last == std::string::npos ? text : text.replace(last, 2, " or ");
}

// Writes what is wrong with a radius. Returns whether it is good.
bool isRadius(std::ostream& problem, const char* name, double value)
{
  if (value <= 0.0)
  {
    problem << "its " << name << " is " << value << " mm; it must be above 0 mm";
  }
  return value > 0.0;
}

// What is wrong with one stroke's numbers; empty if nothing is.
std::string problemOfStroke(const double* numbers)
{
  std::ostringstream problem;
  const auto bad = std::find_if_not(numbers, numbers + NumbersPerStroke,
    [](double value) { return std::abs(value) <= LargestStrokeNumber; });
  if (bad != numbers + NumbersPerStroke)
  {
    problem << "its number " << bad - numbers << " is " << *bad << "; it must be finite, from "
            << -LargestStrokeNumber << " to " << LargestStrokeNumber;
    return problem.str();
  }
  if (!isToolOfStrokes(numbers[0]))
  {
    problem << "its tool is " << numbers[0] << "; it must be " << toolsOfStrokes();
    return problem.str();
  }
  const Stroke stroke = strokeFromNumbers(numbers);
  if (stroke.major < 0.0 || stroke.minor < 0.0)
  {
    problem << "its radii are " << stroke.major << " and " << stroke.minor
            << " mm; they must not be below 0 mm";
  }
  else if (shapeOf(stroke.tool) != StrokeShape::Point && stroke.sigma < SmallestSigma)
  {
    problem << "its sigma is " << stroke.sigma << "; it must be at least " << SmallestSigma;
  }
  else if (shapeOf(stroke.tool) == StrokeShape::Sphere)
  {
    isRadius(problem, "radius", stroke.major);
  }
  else if (shapeOf(stroke.tool) == StrokeShape::Ellipsoid &&
    isRadius(problem, "major radius", stroke.major) &&
    isRadius(problem, "minor radius", stroke.minor) && stroke.axis == glm::dvec3(0.0))
  {
    problem << "its axis is 0 0 0; it must have a length above 0";
  }
  return problem.str();
}
}

bool Stroke::operator==(const Stroke& other) const
{
  return this->tool == other.tool && this->anchor == other.anchor && this->vector == other.vector &&
    this->axis == other.axis && this->major == other.major && this->minor == other.minor &&
    this->sigma == other.sigma && this->enabled == other.enabled;
}

std::vector<Stroke> strokesFromNumbers(const std::vector<double>& numbers)
{
  if (numbers.size() % NumbersPerStroke != 0)
  {
    throw Problem("Strokes holds " + std::to_string(numbers.size()) + " numbers; it must hold " +
      std::to_string(NumbersPerStroke) + " for each stroke");
  }
  std::vector<Stroke> strokes;
  strokes.reserve(numbers.size() / NumbersPerStroke);
  for (std::size_t first = 0; first < numbers.size(); first += NumbersPerStroke)
  {
    const std::string problem = problemOfStroke(&numbers[first]);
    if (!problem.empty())
    {
      throw Problem("Stroke " + std::to_string(first / NumbersPerStroke + 1) + ": " + problem);
    }
    strokes.push_back(strokeFromNumbers(&numbers[first]));
  }
  return strokes;
}

std::vector<double> numbersFromStrokes(const std::vector<Stroke>& strokes)
{
  std::vector<double> numbers;
  numbers.reserve(strokes.size() * NumbersPerStroke);
  for (const Stroke& stroke : strokes)
  {
    numbers.push_back(static_cast<double>(stroke.tool));
    for (const glm::dvec3& vector : { stroke.anchor, stroke.vector, stroke.axis })
    {
      numbers.insert(numbers.end(), { vector.x, vector.y, vector.z });
    }
    numbers.insert(
      numbers.end(), { stroke.major, stroke.minor, stroke.sigma, stroke.enabled ? 1.0 : 0.0 });
  }
  return numbers;
}

double falloff(double distance, double sigma)
{
  if (distance >= 1.0)
  {
    return 0.0;
  }
  // The Gaussian alone still has 13 % at the surface for sigma 0.5; the second factor brings value
  // and slope to 0 there and leaves the middle alone.
  const double rim = 1.0 - distance * distance;
  return std::exp(-0.5 * distance * distance / (sigma * sigma)) * rim * rim;
}

double normalisedDistance(const Stroke& stroke, const glm::dvec3& position)
{
  const glm::dvec3 fromAnchor = position - stroke.anchor;
  if (shapeOf(stroke.tool) == StrokeShape::Sphere)
  {
    return glm::length(fromAnchor) / stroke.major;
  }
  // Squares of very small lengths are 0, so lengths are divided before they are squared.
  const glm::dvec3 size = glm::abs(stroke.axis);
  const double along =
    glm::dot(fromAnchor, glm::normalize(stroke.axis / std::max({ size.x, size.y, size.z })));
  const double across = std::sqrt(std::max(0.0, glm::dot(fromAnchor, fromAnchor) - along * along));
  return std::hypot(along / stroke.major, across / stroke.minor);
}
}
