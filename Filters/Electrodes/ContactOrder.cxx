// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Electrodes/ContactOrder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <tuple>

namespace brainshift
{
namespace
{
constexpr int MostColumns = 32;
constexpr double StrangerFactor = 1.25; // times the pitch: closer than a diagonal
constexpr double NeighbourFactor = 1.3; // the same, for contacts of which nothing is known
constexpr double FarthestStep = 0.45;   // times the pitch, from where a neighbour is expected
constexpr double StepMemory = 0.5;      // of a step along the sheet, against the new one
constexpr double EmptyRow = 1e-3;       // of misfit, for a row without contacts at an end
constexpr double OtherFirst = 1e-4;     // the same, for a first number that is not 1
constexpr double ShortRows = 0.15; // the same, for rows of two: a strip that bends looks like it

using Cell = std::pair<int, int>;

// The contact at each place.
std::map<Cell, std::size_t> cellsOf(const ContactOrder& order)
{
  std::map<Cell, std::size_t> cells;
  for (std::size_t i = 0; i < order.places.size(); ++i)
  {
    if (const std::optional<glm::ivec2>& place = order.places[i])
    {
      cells.emplace(Cell{ place->x, place->y }, i);
    }
  }
  return cells;
}

// Distances between contacts that are a step apart on the sheet.
std::vector<double> distancesAlong(const std::vector<glm::dvec3>& positions,
  const std::map<Cell, std::size_t>& cells, const glm::ivec2& step)
{
  std::vector<double> distances;
  for (const auto& [cell, i] : cells)
  {
    const auto other = cells.find({ cell.first + step.x, cell.second + step.y });
    if (other != cells.end())
    {
      distances.push_back(glm::distance(positions[i], positions[other->second]));
    }
  }
  return distances;
}

// The fraction of contacts beside which there is one that is further away on the sheet.
double strangers(const std::vector<glm::dvec3>& positions, const ContactOrder& order, double pitch)
{
  int found = 0;
  int count = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const std::optional<glm::ivec2>& place = order.places[i];
    if (!place)
    {
      continue;
    }
    ++count;
    for (std::size_t j = 0; j < positions.size(); ++j)
    {
      const std::optional<glm::ivec2>& other = order.places[j];
      if (other && glm::distance(positions[i], positions[j]) < StrangerFactor * pitch)
      {
        const glm::ivec2 apart = glm::abs(*place - *other);
        if (std::max(apart.x, apart.y) > 1)
        {
          ++found;
          break;
        }
      }
    }
  }
  return count ? static_cast<double>(found) / count : 0.0;
}

// A sheet that is followed from contact to contact.
struct SheetWalk
{
  struct Placed
  {
    Cell cell;
    std::array<glm::dvec3, 2> steps; // mm, along rows and along columns
  };
  struct Next
  {
    double away; // mm, from where it is expected
    std::size_t contact;
    Cell cell;
    std::array<glm::dvec3, 2> steps;
    bool operator<(const Next& other) const { return this->away > other.away; }
  };

  const std::vector<glm::dvec3>& positions;
  double pitch;
  std::map<std::size_t, Placed> placed;
  std::set<Cell> taken;
  std::priority_queue<Next> waiting;

  // Expects the four neighbours of a contact.
  void expectBeside(std::size_t contact)
  {
    const Placed& from = this->placed.at(contact);
    for (int axis = 0; axis < 2; ++axis)
    {
      for (const int sign : { -1, 1 })
      {
        const glm::dvec3 expected =
          this->positions[contact] + static_cast<double>(sign) * from.steps[axis];
        Cell cell = from.cell;
        (axis == 0 ? cell.first : cell.second) += sign;
        for (std::size_t i = 0; i < this->positions.size(); ++i)
        {
          const double away = glm::distance(this->positions[i], expected);
          if (!this->placed.count(i) && away < FarthestStep * this->pitch)
          {
            std::array<glm::dvec3, 2> steps = from.steps;
            steps[axis] = StepMemory * steps[axis] +
              (1.0 - StepMemory) * static_cast<double>(sign) *
                (this->positions[i] - this->positions[contact]);
            steps[axis] *= this->pitch / glm::length(steps[axis]);
            this->waiting.push({ away, i, cell, steps });
          }
        }
      }
    }
  }

  void place(std::size_t contact, const Cell& cell, const std::array<glm::dvec3, 2>& steps)
  {
    this->placed[contact] = { cell, steps };
    this->taken.insert(cell);
    this->expectBeside(contact);
  }

  void walk()
  {
    while (!this->waiting.empty())
    {
      const Next next = this->waiting.top();
      this->waiting.pop();
      if (!this->placed.count(next.contact) && !this->taken.count(next.cell))
      {
        this->place(next.contact, next.cell, next.steps);
      }
    }
  }
};

// The median distance (mm) of contacts from their second nearest ones: noise makes the nearest too
// near, and even a corner has two neighbours.
double neighbourDistance(const std::vector<glm::dvec3>& positions)
{
  std::vector<double> second;
  for (const glm::dvec3& position : positions)
  {
    std::vector<double> distances;
    distances.reserve(positions.size());
    for (const glm::dvec3& other : positions)
    {
      distances.push_back(glm::distance(position, other));
    }
    constexpr std::ptrdiff_t Second = 2; // after itself and the nearest one
    const auto at = distances.begin() + std::min<std::ptrdiff_t>(Second, distances.size() - 1);
    std::nth_element(distances.begin(), at, distances.end());
    second.push_back(*at);
  }
  return median(second);
}

// Two steps along the sheet at a contact: to its nearest one, and across that.
std::array<glm::dvec3, 2> stepsAt(
  const std::vector<glm::dvec3>& positions, std::size_t contact, double pitch)
{
  std::vector<std::pair<double, glm::dvec3>> beside;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    if (i != contact)
    {
      const glm::dvec3 step = positions[i] - positions[contact];
      beside.emplace_back(glm::length(step), step);
    }
  }
  std::sort(beside.begin(), beside.end(),
    [](const auto& left, const auto& right) { return left.first < right.first; });
  const glm::dvec3 along = pitch / beside.front().first * beside.front().second;
  glm::dvec3 across(0.0);
  double best = 0.0;
  for (const auto& [distance, step] : beside)
  {
    const glm::dvec3 side = step - along * glm::dot(step, along) / (pitch * pitch);
    const double quality = glm::length(side) / distance; // sine of the angle between them
    if (distance < NeighbourFactor * pitch && quality > best)
    {
      best = quality;
      across = side;
    }
  }
  constexpr double Straight = 0.8;
  return { along, best > Straight ? pitch * glm::normalize(across) : glm::dvec3(0.0) };
}

// The contact with the most neighbours, of these the one nearest to the middle.
std::size_t seedOf(const std::vector<glm::dvec3>& positions, double pitch)
{
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& position : positions)
  {
    middle += position / static_cast<double>(positions.size());
  }
  std::size_t best = 0;
  std::pair<int, double> quality{ -1, 0.0 };
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const auto count =
      std::count_if(positions.begin(), positions.end(), [&](const glm::dvec3& other) {
        return glm::distance(other, positions[i]) < NeighbourFactor * pitch;
      });
    const std::pair<int, double> now{ static_cast<int>(std::min<std::ptrdiff_t>(count, 5)),
      -glm::distance(positions[i], middle) };
    if (now > quality)
    {
      quality = now;
      best = i;
    }
  }
  return best;
}

// Numbers that the first contact of a sheet may have: 1, that of the row of the least number, as if
// the rows went on from 1, and the least one.
std::vector<int> firstNumbers(int least, int columns, bool mayStartAt1)
{
  std::vector<int> firsts;
  if (mayStartAt1)
  {
    firsts.push_back(1);
  }
  for (const int first : { least - (std::max(least, 1) - 1) % columns, least })
  {
    if (std::find(firsts.begin(), firsts.end(), first) == firsts.end())
    {
      firsts.push_back(first);
    }
  }
  return firsts;
}

// A numbering with its misfit. Of numberings that are the same but for rows without contacts, the
// one with the fewest such rows is best, then the one from 1 on.
RankedNumbering ranking(const std::vector<glm::dvec3>& positions, const std::vector<int>& numbers,
  const Numbering& numbering)
{
  const ContactOrder order = orderBy(numbers, numbering);
  const auto without = std::count(order.places.begin(), order.places.end(), std::nullopt);
  const glm::ivec2 empty = emptyRows(order);
  const bool isFromOther = numbering.first != 1;
  const bool hasShortRows = numbering.columns == 2 && numbering.rows > 2;
  return { numbering,
    misfit(positions, order) + static_cast<double>(without) / static_cast<double>(numbers.size()) +
      EmptyRow * (empty.x + empty.y) + (isFromOther ? OtherFirst : 0.0) +
      (hasShortRows ? ShortRows : 0.0) };
}
}

std::optional<glm::ivec2> placeOf(int number, const Numbering& numbering)
{
  const int index = number - numbering.first;
  if (index < 0 || index >= numbering.rows * numbering.columns)
  {
    return {};
  }
  const int row = index / numbering.columns;
  const int along = index % numbering.columns;
  const bool isBackwards = numbering.alternates && row % 2 == 1;
  return glm::ivec2(row, isBackwards ? numbering.columns - 1 - along : along);
}

int numberAt(const glm::ivec2& place, const Numbering& numbering)
{
  const bool isBackwards = numbering.alternates && place.x % 2 == 1;
  return numbering.first + place.x * numbering.columns +
    (isBackwards ? numbering.columns - 1 - place.y : place.y);
}

ContactOrder orderBy(const std::vector<int>& numbers, const Numbering& numbering)
{
  ContactOrder order{ numbering.rows, numbering.columns, {} };
  for (const int number : numbers)
  {
    order.places.push_back(placeOf(number, numbering));
  }
  return order;
}

double median(std::vector<double> numbers)
{
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return numbers.empty() ? 0.0 : *middle;
}

std::vector<double> neighbourDistances(
  const std::vector<glm::dvec3>& positions, const ContactOrder& order)
{
  const std::map<Cell, std::size_t> cells = cellsOf(order);
  std::vector<double> all = distancesAlong(positions, cells, { 0, 1 });
  const std::vector<double> down = distancesAlong(positions, cells, { 1, 0 });
  all.insert(all.end(), down.begin(), down.end());
  return all;
}

double misfit(const std::vector<glm::dvec3>& positions, const ContactOrder& order)
{
  const std::map<Cell, std::size_t> cells = cellsOf(order);
  const std::vector<double> straight = neighbourDistances(positions, order);
  const double pitch = median(straight);
  if (!(pitch > 0.0))
  {
    return std::numeric_limits<double>::infinity();
  }
  std::vector<double> differences;
  differences.reserve(straight.size());
  for (const double distance : straight)
  {
    differences.push_back(std::min(std::abs(distance / pitch - 1.0), 1.0));
  }
  for (const int down : { -1, 1 })
  {
    for (const double distance : distancesAlong(positions, cells, { down, 1 }))
    {
      differences.push_back(std::min(std::abs(distance / (std::sqrt(2.0) * pitch) - 1.0), 1.0));
    }
  }
  double sum = 0.0;
  for (const double difference : differences)
  {
    sum += difference;
  }
  return sum / static_cast<double>(differences.size()) + strangers(positions, order, pitch);
}

glm::ivec2 emptyRows(const ContactOrder& order)
{
  int low = order.rows;
  int high = order.rows - 1;
  for (const std::optional<glm::ivec2>& place : order.places)
  {
    if (place)
    {
      high = low == order.rows ? place->x : std::max(high, place->x);
      low = std::min(low, place->x);
    }
  }
  return { low, order.rows - 1 - high };
}

std::vector<RankedNumbering> rankedNumberings(
  const std::vector<glm::dvec3>& positions, const std::vector<int>& numbers, int rows, int columns)
{
  const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
  const bool isShaped = rows * columns > 0;
  // Without a shape, an electrode that goes on after another one is numbered higher.
  const bool mayStartAt1 = *least >= 1 && (isShaped || *least <= *most / 2);
  std::vector<RankedNumbering> ranked;
  std::vector<glm::ivec2> shapes; // 0 rows: as many as the numbers need
  if (isShaped)
  {
    shapes = { { rows, columns }, { columns, rows } };
  }
  else
  {
    const int first = mayStartAt1 ? 1 : *least;
    const int count = *most - first + 1;
    ranked.push_back(ranking(positions, numbers, { 1, count, first, false }));
    for (int across = 2; across <= std::min(MostColumns, (count + 1) / 2); ++across)
    {
      shapes.emplace_back(0, across);
    }
  }
  for (const glm::ivec2& shape : shapes)
  {
    for (const int first : firstNumbers(*least, shape.y, mayStartAt1))
    {
      const int down = shape.x > 0 ? shape.x : (*most - first + shape.y) / shape.y;
      ranked.push_back(ranking(positions, numbers, { down, shape.y, first, false }));
      ranked.push_back(ranking(positions, numbers, { down, shape.y, first, true }));
    }
  }
  std::stable_sort(
    ranked.begin(), ranked.end(), [](const RankedNumbering& left, const RankedNumbering& right) {
      return left.misfit < right.misfit;
    });
  return ranked;
}

ContactOrder orderOfPositions(const std::vector<glm::dvec3>& positions)
{
  ContactOrder order;
  order.places.resize(positions.size());
  if (positions.size() < 2)
  {
    return order;
  }
  SheetWalk sheet{ positions, neighbourDistance(positions), {}, {}, {} };
  if (!(sheet.pitch > 0.0))
  {
    return order;
  }
  const std::size_t seed = seedOf(positions, sheet.pitch);
  sheet.place(seed, { 0, 0 }, stepsAt(positions, seed, sheet.pitch));
  sheet.walk();
  glm::ivec2 low(std::numeric_limits<int>::max());
  glm::ivec2 high(std::numeric_limits<int>::min());
  for (const auto& [contact, placed] : sheet.placed)
  {
    low = glm::min(low, glm::ivec2(placed.cell.first, placed.cell.second));
    high = glm::max(high, glm::ivec2(placed.cell.first, placed.cell.second));
  }
  const glm::ivec2 size = high - low + 1;
  const bool turns = size.x > size.y; // rows are the shorter way
  order.rows = turns ? size.y : size.x;
  order.columns = turns ? size.x : size.y;
  for (const auto& [contact, placed] : sheet.placed)
  {
    const glm::ivec2 at = glm::ivec2(placed.cell.first, placed.cell.second) - low;
    order.places[contact] = turns ? glm::ivec2(at.y, at.x) : at;
  }
  return order;
}
}
