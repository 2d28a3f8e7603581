// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/Replay.h"

#include "Common/Numbers.h"

#include <algorithm>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr int MostNamed = 3;
constexpr double Rounding = 1e-6;     // of spacings that went through text
constexpr double FullyAchieved = 0.8; // of a stroke's length; less of it is worth a word

// How finely a stroke bends, mm; 0 if it takes whatever the lattice has.
double finestRadius(const Stroke& stroke)
{
  // A point: the spacing it was made at.
  return shapeOf(stroke.tool) == StrokeShape::Ellipsoid ? std::min(stroke.major, stroke.minor)
                                                        : stroke.major;
}

// Whether a mask leaves the tissue at a position (mm, world) less than its whole displacement. The
// nearest node answers.
bool isFeathered(const Lattice& lattice, const glm::dvec3& world)
{
  const NodeWeights& mask = *lattice.mask;
  const glm::ivec3 count = (lattice.grid.dimensions - 1) * mask.perCell + 1;
  const glm::ivec3 node(
    glm::clamp(glm::round(lattice.grid.gridFromWorld(world) * double(mask.perCell)),
      glm::dvec3(0.0), glm::dvec3(count - 1)));
  return mask.values[(static_cast<std::size_t>(node.z) * count.y + node.y) * count.x + node.x] <
    1.0f;
}

// The first of some strokes by their numbers, such as "2 (8.5 mm), 4 (3 mm) and 3 more".
class NamedStrokes
{
public:
  void add(const std::string& name)
  {
    this->Names += this->Count < MostNamed ? (this->Count ? ", " : "") + name : "";
    ++this->Count;
  }
  bool empty() const { return this->Count == 0; }
  std::string text() const
  {
    return this->Count > MostNamed
      ? this->Names + " and " + std::to_string(this->Count - MostNamed) + " more"
      : this->Names;
  }

private:
  std::string Names;
  int Count = 0;
};
}

bool Replay::isFor(const Lattice& base, const Guarding& guarding) const
{
  return this->Guarded == guarding && this->Base.grid == base.grid &&
    this->Base.kernel == base.kernel && this->Base.displacements == base.displacements &&
    sameMask(this->Base.mask, base.mask);
}

void Replay::start(const Lattice& base, const Guarding& guarding)
{
  this->Base = base;
  this->Guarded = guarding;
  if (guarding.on)
  {
    this->Guard.setBase(base, guarding.samples);
  }
  this->Strokes.clear();
  this->Checkpoints.clear();
  this->PerCheckpoint = StrokesPerCheckpoint;
  this->BeforeLast = base;
  this->Result = base;
}

// Makes the result that of some of the first `same` strokes, which did not change, of `count` that
// are to be applied. Returns of how many. If it is not of all of the last run, one stroke at least
// is left, so that the lattice before the last one will be known.
std::size_t Replay::goBack(std::size_t same, std::size_t count)
{
  const std::size_t before = this->Strokes.size();
  while (!this->Checkpoints.empty() && this->Checkpoints.back().count > same)
  {
    this->Checkpoints.pop_back();
  }
  if (same == before)
  {
    return same;
  }
  if (same + 1 == before && count >= before)
  {
    this->Result = this->BeforeLast;
    return same;
  }
  const std::size_t most = std::min(same, std::max<std::size_t>(count, 1) - 1);
  const auto after = std::find_if(this->Checkpoints.rbegin(), this->Checkpoints.rend(),
    [&](const Checkpoint& checkpoint) { return checkpoint.count <= most; });
  this->Result = this->Base;
  if (after == this->Checkpoints.rend())
  {
    return 0;
  }
  this->Result.displacements = after->displacements;
  return after->count;
}

// Applies a fraction of a stroke. What was before it is kept.
void Replay::apply(const Stroke& stroke, double fraction)
{
  this->BeforeLast = this->Result;
  applyStroke(this->Result, stroke);
  if (fraction < 1.0)
  {
    this->Result = between(this->BeforeLast, this->Result, fraction);
  }
}

void Replay::keepCheckpoint(std::size_t count)
{
  const std::size_t bytes = this->Result.displacements.size() * sizeof(glm::vec3);
  if (count % this->PerCheckpoint != 0 || 2 * bytes > MostCheckpointBytes ||
    (!this->Checkpoints.empty() && this->Checkpoints.back().count >= count))
  {
    return;
  }
  this->Checkpoints.push_back({ count, this->Result.displacements });
  if (this->Checkpoints.size() * bytes > MostCheckpointBytes)
  {
    this->PerCheckpoint *= 2;
    this->Checkpoints.erase(
      std::remove_if(this->Checkpoints.begin(), this->Checkpoints.end(),
        [&](const Checkpoint& checkpoint) { return checkpoint.count % this->PerCheckpoint != 0; }),
      this->Checkpoints.end());
  }
}

void Replay::applyGuarded(const Stroke& stroke)
{
  this->apply(stroke, 1.0);
  const double fraction =
    this->Guarded.on ? this->Guard.fraction(this->BeforeLast, this->Result) : 1.0;
  if (fraction < 1.0)
  {
    this->Result = between(this->BeforeLast, this->Result, fraction);
  }
  this->Fractions.push_back(fraction);
  this->Achieved.push_back(achievedDisplacement(this->BeforeLast, this->Result, stroke));
}

const Lattice& Replay::run(const Lattice& base, const std::vector<Stroke>& strokes,
  const Guarding& guarding, const ReplayProgress& progress)
{
  if (!this->isFor(base, guarding))
  {
    this->start(base, guarding);
  }
  const std::size_t common = std::min(strokes.size(), this->Strokes.size());
  const std::size_t same = static_cast<std::size_t>(
    std::mismatch(strokes.begin(), strokes.begin() + common, this->Strokes.begin()).first -
    strokes.begin());
  const std::size_t first = this->goBack(same, strokes.size());
  this->Fractions.resize(same);
  this->Achieved.resize(same);
  std::size_t done = first;
  this->Whole = true;
  while (done < strokes.size() && this->Whole)
  {
    if (done < same)
    {
      this->apply(strokes[done], this->Fractions[done]);
    }
    else
    {
      this->applyGuarded(strokes[done]);
    }
    this->keepCheckpoint(++done);
    // Only after a stroke: the lattice before the last one must be known.
    this->Whole = done == strokes.size() || !progress ||
      progress(static_cast<double>(done - first) / static_cast<double>(strokes.size() - first));
  }
  this->Fractions.resize(done);
  this->Achieved.resize(done);
  this->Applied = static_cast<int>(done - first);
  this->Strokes.assign(strokes.begin(), strokes.begin() + static_cast<std::ptrdiff_t>(done));
  return this->Result;
}

std::string Replay::strokesInFeather() const
{
  NamedStrokes named;
  for (std::size_t number = 0; this->Base.mask && number < this->Strokes.size(); ++number)
  {
    const Stroke& stroke = this->Strokes[number];
    if (stroke.enabled && this->Achieved[number] < FullyAchieved * glm::length(stroke.vector) &&
      isFeathered(this->Base, stroke.anchor))
    {
      named.add(std::to_string(number + 1));
    }
  }
  return named.empty() ? std::string()
                       : "The mask holds back the tissue at the anchor of stroke " + named.text() +
      ": it is outside the mask or in its feather. Raise Mask Growth, lower Feather, or use the "
      "mask as Segmentation, which limits nothing";
}

std::string strokesTooFine(const std::vector<Stroke>& strokes, const Grid& lattice)
{
  const double spacing = std::max({ lattice.spacing.x, lattice.spacing.y, lattice.spacing.z });
  NamedStrokes named;
  for (std::size_t number = 0; number < strokes.size(); ++number)
  {
    const double radius = finestRadius(strokes[number]);
    if (strokes[number].enabled && radius > 0.0 && radius < spacing * (1.0 - Rounding))
    {
      std::ostringstream name;
      name << number + 1 << " (" << roundedText(radius) << " mm)";
      named.add(name.str());
    }
  }
  if (named.empty())
  {
    return {};
  }
  std::ostringstream sentence;
  sentence << "The lattice is too coarse for the radius of stroke " << named.text()
           << ": its spacing is " << roundedText(spacing) << " mm. Make Lattice Dimensions larger";
  return sentence.str();
}
}
