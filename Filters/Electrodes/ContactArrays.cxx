// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Electrodes/ContactArrays.h"

#include "Common/Numbers.h"
#include "Filters/Electrodes/ContactOrder.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace brainshift
{
namespace
{
constexpr std::size_t FewestOfLine = 3;
constexpr std::size_t FewestOfGrid = 6;
constexpr double MostMisfit = 0.35; // of an order that labels say
constexpr double ClearMisfit = 0.6; // the same, where no other shape comes near
constexpr double FarWorse = 2.0;    // times the misfit: that of a shape that does not come near
constexpr double EvenStrip = 1.45;  // times the middle distance: the largest one of a strip
constexpr std::size_t LongestStrip = 16;
constexpr double CloseMisfit = 0.03;    // two shapes that are as good as each other
constexpr double LeastPlaced = 0.8;     // fraction of contacts that an order must hold
constexpr double SnapFraction = 0.03;   // a pitch this near to a half mm is that
constexpr double UnevenFraction = 0.25; // of the pitch: a distance that looks wrong
constexpr double UnevenMm = 2.0;        // less may be noise
constexpr double AstrayMm = 3.0;        // the same
constexpr double AstrayFraction = 0.5;  // of the pitch: a contact that looks misplaced
constexpr double UnlikeFraction = 0.08; // of the pitch: rows and columns that are not as wide
constexpr double UnlikeMm = 0.6;        // less may be noise
constexpr double SamePlaceMm = 0.3;
constexpr double StraightFraction = 0.02; // distance from a line, of its length: a shaft
constexpr double WidestShaftPitchMm = 6.5;
constexpr double SteepFraction = 0.45; // of a shaft's length goes down
constexpr std::size_t MostNamed = 4;   // contacts in a sentence

struct Label
{
  std::string group;
  std::optional<int> number;
};

// What is before the number at a label's end, and the number.
Label split(const std::string& label)
{
  std::size_t end = label.size();
  while (end > 0 && std::isspace(static_cast<unsigned char>(label[end - 1])))
  {
    --end;
  }
  std::size_t digits = end;
  constexpr std::size_t MostDigits = 4;
  while (digits > 0 && end - digits < MostDigits &&
    std::isdigit(static_cast<unsigned char>(label[digits - 1])))
  {
    --digits;
  }
  Label result{ label.substr(0, digits), {} };
  if (digits < end)
  {
    result.number = numberIn<int>(label.substr(digits, end - digits));
  }
  while (
    !result.group.empty() && std::string(" _-.").find(result.group.back()) != std::string::npos)
  {
    result.group.pop_back();
  }
  return result;
}

// What a sentence calls a contact.
std::string nameOfContact(const std::vector<Contact>& contacts, std::size_t i)
{
  return contacts[i].label.empty() ? "contact " + std::to_string(i + 1) : contacts[i].label;
}

std::string joined(const std::vector<std::string>& names)
{
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), MostNamed); ++i)
  {
    text += (i ? ", " : "") + names[i];
  }
  return names.size() > MostNamed ? text + " and others" : text;
}

// Of the places of a sheet, the contacts; that of the list's positions.
ContactOrder orderOf(const ContactArray& array, std::size_t count)
{
  ContactOrder order{ array.rows, array.columns, {} };
  order.places.resize(count);
  for (std::size_t k = 0; k < array.contacts.size(); ++k)
  {
    if (const std::optional<std::size_t>& contact = array.contacts[k])
    {
      const int index = static_cast<int>(k);
      order.places[*contact] = glm::ivec2(index / array.columns, index % array.columns);
    }
  }
  return order;
}

std::vector<glm::dvec3> positionsOf(const std::vector<Contact>& contacts)
{
  std::vector<glm::dvec3> positions;
  positions.reserve(contacts.size());
  for (const Contact& contact : contacts)
  {
    positions.push_back(contact.position);
  }
  return positions;
}

// Builds the electrode of one group.
class Recognition
{
public:
  Recognition(const std::vector<Contact>& contacts, std::vector<std::size_t> members,
    const std::optional<ArrayHint>& hint, const DepthBelowCortex& depth)
    : Contacts(contacts)
    , Hint(hint)
    , Depth(depth)
  {
    this->Array.members = std::move(members);
  }

  // The prefix is for places of missing contacts that no label names.
  ContactArray array(const std::string& name, const std::string& prefix)
  {
    this->Array.name = name;
    this->Prefix = prefix;
    this->dropRepeated();
    if (this->Kept.size() < FewestOfLine)
    {
      this->doubt("has " + std::to_string(this->Kept.size()) + " contacts, too few for an order");
      return this->Array;
    }
    if (!this->findByLabels())
    {
      this->findByPositions();
    }
    this->findPitch();
    this->findKind();
    this->doubtPlaces();
    this->doubtPitch();
    return this->Array;
  }

private:
  void doubt(const std::string& what)
  {
    this->Array.doubts.push_back(
      (this->Array.name.empty() ? "The group without labels" : this->Array.name) + " " + what);
  }

  std::string nameOf(std::size_t i) const { return nameOfContact(this->Contacts, i); }

  // Keeps the first contact of a label, and names contacts at one place.
  void dropRepeated()
  {
    std::map<std::string, std::size_t> seen;
    for (const std::size_t i : this->Array.members)
    {
      const std::string& label = this->Contacts[i].label;
      if (!label.empty() && !seen.emplace(label, i).second)
      {
        this->doubt("has the label " + label + " twice; the second contact is left out");
        continue;
      }
      for (const std::size_t j : this->Kept)
      {
        if (glm::distance(this->Contacts[i].position, this->Contacts[j].position) < SamePlaceMm)
        {
          this->doubt("has " + this->nameOf(j) + " and " + this->nameOf(i) + " at one place");
        }
      }
      this->Kept.push_back(i);
      this->Positions.push_back(this->Contacts[i].position);
    }
  }

  void take(const ContactOrder& order)
  {
    this->Array.rows = order.rows;
    this->Array.columns = order.columns;
    const std::size_t count = static_cast<std::size_t>(order.rows) * order.columns;
    this->Array.contacts.assign(count, std::nullopt);
    this->Array.labels.assign(count, "");
    for (std::size_t k = 0; k < order.places.size(); ++k)
    {
      if (const std::optional<glm::ivec2>& place = order.places[k])
      {
        const std::size_t at = static_cast<std::size_t>(place->x) * order.columns + place->y;
        this->Array.contacts[at] = this->Kept[k];
        this->Array.labels[at] = this->Contacts[this->Kept[k]].label;
      }
    }
  }

  // Names of missing contacts, spelled as those that are there.
  void nameMissing(const Numbering& numbering)
  {
    const std::string& example = this->Contacts[this->Kept.front()].label;
    std::size_t digits = example.find_last_not_of("0123456789 ") + 1;
    const bool hasZeros = std::any_of(this->Kept.begin(), this->Kept.end(), [&](std::size_t i) {
      const std::string& label = this->Contacts[i].label;
      return label.size() > digits && label[digits] == '0';
    });
    for (std::size_t k = 0; k < this->Array.labels.size(); ++k)
    {
      if (!this->Array.contacts[k])
      {
        const int index = static_cast<int>(k);
        const int number =
          numberAt({ index / this->Array.columns, index % this->Array.columns }, numbering);
        std::string text = std::to_string(number);
        if (hasZeros && text.size() < 2)
        {
          text.insert(0, "0");
        }
        this->Array.labels[k] = example.substr(0, digits) + text;
      }
    }
  }

  bool findByLabels()
  {
    std::vector<int> numbers;
    for (const std::size_t i : this->Kept)
    {
      const std::optional<int> number = split(this->Contacts[i].label).number;
      if (!number || std::count(numbers.begin(), numbers.end(), *number))
      {
        return false;
      }
      numbers.push_back(*number);
    }
    const bool isShaped = this->Hint && this->Hint->rows * this->Hint->columns > 0;
    const std::vector<RankedNumbering> ranked = rankedNumberings(this->Positions, numbers,
      isShaped ? this->Hint->rows : 0, isShaped ? this->Hint->columns : 0);
    const RankedNumbering& best = ranked.front();
    if (!(best.misfit <= MostMisfit) && !this->isClear(ranked, numbers)) // also rejects NaN
    {
      return false;
    }
    this->doubtOtherShapes(ranked);
    const ContactOrder order = orderBy(numbers, best.numbering);
    this->take(order);
    this->nameMissing(best.numbering);
    this->doubtOutside(order, "has contacts outside of its shape: ");
    this->doubtRows(order, best.numbering);
    return true;
  }

  static bool isOther(const Numbering& one, const Numbering& other)
  {
    return other.columns != one.columns && other.rows != one.columns;
  }

  // Whether an order is that of the labels though contacts are far from where it has them, as those
  // that were projected to a cortex: no other shape comes near, or it is a strip with even steps.
  // Of the electrodes of 51 patients (OpenNeuro ds003688) it orders 7 more by their labels.
  bool isClear(const std::vector<RankedNumbering>& ranked, const std::vector<int>& numbers) const
  {
    const RankedNumbering& best = ranked.front();
    if (!(best.misfit <= ClearMisfit))
    {
      return false;
    }
    if (best.numbering.rows == 1)
    {
      const std::vector<double> steps =
        neighbourDistances(this->Positions, orderBy(numbers, best.numbering));
      return !steps.empty() && numbers.size() <= LongestStrip &&
        *std::max_element(steps.begin(), steps.end()) <= EvenStrip * median(steps);
    }
    return std::all_of(ranked.begin(), ranked.end(), [&](const RankedNumbering& other) {
      return !isOther(best.numbering, other.numbering) || other.misfit >= FarWorse * best.misfit;
    });
  }

  void doubtOtherShapes(const std::vector<RankedNumbering>& ranked)
  {
    const RankedNumbering& best = ranked.front();
    for (const RankedNumbering& other : ranked)
    {
      if (isOther(best.numbering, other.numbering) && other.misfit < best.misfit + CloseMisfit)
      {
        this->doubt("could have " + std::to_string(other.numbering.rows) + " x " +
          std::to_string(other.numbering.columns) + " contacts as well as " +
          std::to_string(best.numbering.rows) + " x " + std::to_string(best.numbering.columns) +
          "; give its shape");
        return;
      }
    }
  }

  // Names contacts that have no place.
  void doubtOutside(const ContactOrder& order, const std::string& words)
  {
    std::vector<std::string> outside;
    for (std::size_t k = 0; k < order.places.size(); ++k)
    {
      if (!order.places[k])
      {
        outside.push_back(this->nameOf(this->Kept[k]));
      }
    }
    if (!outside.empty())
    {
      this->doubt(words + joined(outside));
    }
  }

  // Rows of a grid that the numbers alone put before or after the contacts. Those after a grid from
  // 1 on are in a shape that was given.
  void doubtRows(const ContactOrder& order, const Numbering& numbering)
  {
    const glm::ivec2 empty = emptyRows(order);
    if (order.rows > 1 && (empty.x > 0 || (empty.y > 0 && numbering.first != 1)))
    {
      this->doubt(std::string("has no contact in its ") + (empty.x > 0 ? "first" : "last") +
        " row; check its shape and labels");
    }
    const int before = numbering.first - 1;
    const bool isGiven = this->Hint && this->Hint->rows * this->Hint->columns > 0;
    if (!isGiven && order.rows > 1 && before > 0 && before % order.columns == 0 &&
      before < order.rows * order.columns)
    {
      this->doubt("starts at " + this->Array.labels.front() +
        "; if rows before that are missing, give its shape");
    }
  }

  void findByPositions()
  {
    this->Array.byLabels = false;
    const ContactOrder order = orderOfPositions(this->Positions);
    const auto placed = std::count_if(order.places.begin(), order.places.end(),
      [](const std::optional<glm::ivec2>& place) { return place.has_value(); });
    if (static_cast<double>(placed) < LeastPlaced * static_cast<double>(this->Kept.size()))
    {
      this->doubt("has no order of a grid, a strip or a shaft, neither in its labels nor in its "
                  "positions; give its shape or check the positions");
      return;
    }
    const bool hasLabels = std::any_of(this->Kept.begin(), this->Kept.end(),
      [&](std::size_t i) { return !this->Contacts[i].label.empty(); });
    if (hasLabels)
    {
      this->doubt("has labels that do not follow its shape; its order is that of the positions");
    }
    this->take(order);
    for (std::size_t k = 0; k < this->Array.labels.size(); ++k)
    {
      if (!this->Array.contacts[k])
      {
        const std::size_t columns = order.columns;
        this->Array.labels[k] = this->Prefix + "r" + std::to_string(k / columns + 1) + "c" +
          std::to_string(k % columns + 1);
      }
    }
    this->doubtOutside(order, "has contacts that belong to no row and column: ");
    if (this->Hint && this->Hint->rows * this->Hint->columns > 0 &&
      std::minmax(order.rows, order.columns) != std::minmax(this->Hint->rows, this->Hint->columns))
    {
      this->doubt("has the shape " + std::to_string(order.rows) + " x " +
        std::to_string(order.columns) + " by its positions, not " +
        std::to_string(this->Hint->rows) + " x " + std::to_string(this->Hint->columns));
    }
  }

  std::vector<glm::dvec3> everyPosition() const { return positionsOf(this->Contacts); }

  void findPitch()
  {
    if (this->Array.contacts.empty())
    {
      return;
    }
    const std::vector<glm::dvec3> positions = this->everyPosition();
    const std::vector<double> distances =
      neighbourDistances(positions, orderOf(this->Array, positions.size()));
    const double middle = median(distances);
    double sum = 0.0;
    int count = 0;
    for (const double distance : distances)
    {
      if (std::abs(distance - middle) <= UnevenFraction * middle)
      {
        sum += distance;
        ++count;
      }
    }
    const double mean = count ? sum / count : middle;
    const double half = std::round(2.0 * mean) / 2.0;
    this->Array.pitchMm = std::abs(mean - half) <= SnapFraction * mean ? half : mean;
    if (this->Hint && this->Hint->pitchMm > 0.0)
    {
      if (std::abs(mean / this->Hint->pitchMm - 1.0) > UnevenFraction)
      {
        this->doubt("has contacts " + roundedText(mean) + " mm apart, not " +
          roundedText(this->Hint->pitchMm) + " mm");
      }
      this->Array.pitchMm = this->Hint->pitchMm;
    }
  }

  // Whether contacts in one row are a shaft, and what speaks for it.
  ArrayKind kindOfLine()
  {
    std::vector<glm::dvec3> line;
    for (const std::optional<std::size_t>& contact : this->Array.contacts)
    {
      if (contact)
      {
        line.push_back(this->Contacts[*contact].position);
      }
    }
    const glm::dvec3 whole = line.back() - line.front();
    const double length = glm::length(whole);
    double aside = 0.0;
    for (const glm::dvec3& position : line)
    {
      aside = std::max(
        aside, glm::length(glm::cross(position - line.front(), whole)) / std::max(length, 1e-9));
    }
    const bool isStraight = aside < std::max(StraightFraction * length, 1.0);
    if (this->Depth)
    {
      const double down = std::abs(this->Depth(line.front()) - this->Depth(line.back()));
      return isStraight && down > SteepFraction * length ? ArrayKind::Depth : ArrayKind::Strip;
    }
    const bool isNarrow = this->Array.pitchMm < WidestShaftPitchMm;
    if (isStraight != isNarrow)
    {
      this->doubt(std::string(isStraight ? "is straight but its contacts are far apart"
                                         : "has contacts as near as those of a shaft but bends") +
        "; it is taken for a strip");
    }
    return isStraight && isNarrow ? ArrayKind::Depth : ArrayKind::Strip;
  }

  void findKind()
  {
    if (this->Array.contacts.empty())
    {
      return;
    }
    const bool isLine = std::min(this->Array.rows, this->Array.columns) == 1;
    if (this->Hint && this->Hint->kind != ArrayKind::Unknown)
    {
      this->Array.kind = this->Hint->kind;
      if (isLine && this->Array.kind == ArrayKind::Grid)
      {
        this->doubt("is called a grid and is one row; it is taken for a strip");
        this->Array.kind = ArrayKind::Strip;
      }
      return;
    }
    if (!isLine)
    {
      this->Array.kind = this->Kept.size() < FewestOfGrid ? ArrayKind::Unknown : ArrayKind::Grid;
      return;
    }
    this->Array.kind = this->kindOfLine();
  }

  // The position at a place; null if there is none.
  const glm::dvec3* at(int row, int column) const
  {
    const ContactArray& array = this->Array;
    if (row < 0 || row >= array.rows || column < 0 || column >= array.columns)
    {
      return nullptr;
    }
    const std::optional<std::size_t>& contact =
      array.contacts[static_cast<std::size_t>(row) * array.columns + column];
    return contact ? &this->Contacts[*contact].position : nullptr;
  }

  // What a sentence calls the contact at a place.
  std::string nameAt(int row, int column) const
  {
    const std::size_t place = static_cast<std::size_t>(row) * this->Array.columns + column;
    const std::optional<std::size_t>& contact = this->Array.contacts[place];
    return contact ? this->nameOf(*contact) : this->Array.labels[place];
  }

  // Calls with each contact, the next one along rows or columns, and the one before it.
  template <typename Visit>
  void visitNeighbours(const Visit& visit) const
  {
    for (int row = 0; row < this->Array.rows; ++row)
    {
      for (int column = 0; column < this->Array.columns; ++column)
      {
        for (const glm::ivec2& step : { glm::ivec2(0, 1), glm::ivec2(1, 0) })
        {
          if (this->at(row, column) && this->at(row + step.x, column + step.y))
          {
            visit(glm::ivec2(row, column), step);
          }
        }
      }
    }
  }

  // Contacts of a grid that are far from the middle between their neighbours, the worst ones.
  std::vector<std::string> astray() const
  {
    constexpr double AsBad = 0.7; // of the worst: beside a wrong one, right ones look wrong by half
    std::map<std::string, double> away;
    double worst = std::max(AstrayFraction * this->Array.pitchMm, AstrayMm) / AsBad;
    this->visitNeighbours([&](const glm::ivec2& here, const glm::ivec2& step) {
      if (const glm::dvec3* before = this->at(here.x - step.x, here.y - step.y))
      {
        const glm::dvec3& next = *this->at(here.x + step.x, here.y + step.y);
        const double distance = glm::distance(*this->at(here.x, here.y), 0.5 * (next + *before));
        double& known = away[this->nameAt(here.x, here.y)];
        known = std::max(known, distance);
        worst = std::max(worst, known);
      }
    });
    std::vector<std::string> names;
    for (const auto& [name, distance] : away)
    {
      if (distance > AsBad * worst)
      {
        names.push_back(name);
      }
    }
    return names;
  }

  // The sheet is fitted with one distance along rows and columns.
  void doubtPitch()
  {
    std::vector<double> along;
    std::vector<double> across;
    this->visitNeighbours([&](const glm::ivec2& here, const glm::ivec2& step) {
      const glm::ivec2 to = here + step;
      const double distance = glm::distance(*this->at(here.x, here.y), *this->at(to.x, to.y));
      (step.y > 0 ? along : across).push_back(distance);
    });
    const double one = median(along);
    const double other = median(across);
    const double most = std::max(UnlikeFraction * this->Array.pitchMm, UnlikeMm);
    if (this->Array.kind == ArrayKind::Grid && !along.empty() && !across.empty() &&
      std::abs(one - other) > most)
    {
      this->doubt("has contacts " + roundedText(one) + " mm apart along its rows and " +
        roundedText(other) + " mm along its columns; it is fitted with " +
        roundedText(this->Array.pitchMm) + " mm for both");
    }
  }

  // Distances that differ from the pitch, and contacts that are elsewhere.
  void doubtPlaces()
  {
    const std::vector<std::string> wrong =
      this->Array.kind == ArrayKind::Grid ? this->astray() : std::vector<std::string>();
    if (!wrong.empty())
    {
      this->doubt(
        "has contacts that are not between their neighbours; check the labels of " + joined(wrong));
      return; // so their distances are wrong, too
    }
    std::vector<std::string> uneven;
    const double most = std::max(UnevenFraction * this->Array.pitchMm, UnevenMm);
    this->visitNeighbours([&](const glm::ivec2& here, const glm::ivec2& step) {
      const glm::ivec2 to = here + step;
      const double distance = glm::distance(*this->at(here.x, here.y), *this->at(to.x, to.y));
      if (std::abs(distance - this->Array.pitchMm) > most)
      {
        uneven.push_back(this->nameAt(here.x, here.y) + " to " + this->nameAt(to.x, to.y) + " (" +
          roundedText(distance) + " mm)");
      }
    });
    if (!uneven.empty())
    {
      this->doubt("has neighbours that are not " + roundedText(this->Array.pitchMm) +
        " mm apart: " + joined(uneven));
    }
  }

  const std::vector<Contact>& Contacts;
  const std::optional<ArrayHint>& Hint;
  const DepthBelowCortex& Depth;
  ContactArray Array;
  std::string Prefix;
  std::vector<std::size_t> Kept;     // members of which each label is there once
  std::vector<glm::dvec3> Positions; // of these
};

// Contacts without a group that are near to each other.
std::vector<std::vector<std::size_t>> clusters(
  const std::vector<Contact>& contacts, std::vector<std::size_t> left)
{
  constexpr double Together = 1.5; // times the distance of nearest ones
  std::vector<double> nearest;
  for (const std::size_t i : left)
  {
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t j : left)
    {
      least =
        i == j ? least : std::min(least, glm::distance(contacts[i].position, contacts[j].position));
    }
    nearest.push_back(least);
  }
  const double reach = Together * median(nearest);
  std::vector<std::vector<std::size_t>> result;
  while (!left.empty())
  {
    std::vector<std::size_t> found{ left.front() };
    left.erase(left.begin());
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      for (std::size_t j = 0; j < left.size();)
      {
        if (glm::distance(contacts[found[k]].position, contacts[left[j]].position) <= reach)
        {
          found.push_back(left[j]);
          left.erase(left.begin() + static_cast<std::ptrdiff_t>(j));
        }
        else
        {
          ++j;
        }
      }
    }
    std::sort(found.begin(), found.end());
    result.push_back(std::move(found));
  }
  return result;
}
}

const char* nameOf(ArrayKind kind)
{
  switch (kind)
  {
    case ArrayKind::Grid:
      return "grid";
    case ArrayKind::Strip:
      return "strip";
    case ArrayKind::Depth:
      return "depth";
    default:
      return "unknown";
  }
}

std::vector<ContactArray> recogniseArrays(const std::vector<Contact>& contacts,
  const std::vector<ArrayHint>& hints, const DepthBelowCortex& depth)
{
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < contacts.size(); ++i)
  {
    const Contact& contact = contacts[i];
    const std::string name = contact.group.empty() ? split(contact.label).group : contact.group;
    if (members[name].empty())
    {
      names.push_back(name);
    }
    members[name].push_back(i);
  }
  std::vector<ContactArray> arrays;
  for (const std::string& name : names)
  {
    const auto found = std::find_if(
      hints.begin(), hints.end(), [&](const ArrayHint& hint) { return hint.group == name; });
    const std::optional<ArrayHint> hint =
      found == hints.end() ? std::optional<ArrayHint>() : *found;
    const std::vector<std::vector<std::size_t>> parts = name.empty()
      ? clusters(contacts, members[name])
      : std::vector<std::vector<std::size_t>>{ members[name] };
    for (const std::vector<std::size_t>& part : parts)
    {
      const std::string number = parts.size() > 1 ? std::to_string(arrays.size() + 1) + "-" : "";
      arrays.push_back(
        Recognition(contacts, part, hint, depth).array(name, name.empty() ? number : name + "-"));
    }
  }
  return arrays;
}
}
