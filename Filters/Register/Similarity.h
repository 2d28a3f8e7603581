// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A similarity: how a refinement compares two volumes, on which levels, and its texts for the
/// user.
///
/// Each similarity is one file in Similarities/. Panel, Python and pages read the list below.
#ifndef BrainShift_Similarity_h
#define BrainShift_Similarity_h

#include "Common/UnsetVector.h"
#include "Filters/Register/LatticeRows.h"
#include "Filters/Register/Volume.h"

#include <optional>

namespace brainshift
{
// The comparison of a level of the pyramid, sample by sample.
//
// The volume stays at rest: a sample of it at x is compared with the reference at x + u(x). So
// nothing is inverted, and descriptors of the volume are computed once for each level.

/** The two volumes of one level, on the grid of the level. */
struct LevelVolumes
{
  Volume rest;
  Volume reference;
  Volume restWeights;      ///< 1 where the volume counts, else 0
  Volume referenceWeights; ///< 1 where the reference counts, else 0

  /** Where the probe of an ultrasound reference looks: world, of length 1; 0: it is not known. */
  glm::dvec3 beam{ 0.0 };

  /** The second term of a fit in windows, at the points of `rest`; empty: the metric makes it. */
  std::vector<float> secondTerm;

  // An echo begins where its edge is, and rings on behind it: its middle is too deep. So what is
  // compared is how both rise along the beam, for each mm.
  std::vector<float> echoRise() const { return riseAlong(this->reference, this->beam); }
  std::vector<float> edgeRise() const
  {
    return riseAlong({ this->rest.grid, gradientLength(this->rest) }, this->beam);
  }

  /**
   * The same of edges times the volume's value, as a fraction of its range: of their bright sides.
   * Together with edgeRise(), a fit finds on which side the echo is, and which tissues are loud.
   */
  std::vector<float> brightEdgeRise() const;
};

/** Values as fractions of their range, which those define whose weight is above 0. */
void toFractions(std::vector<float>& values, const std::vector<float>& weights);

/** The cost of a displacement, and its derivatives. */
struct CostAndForces
{
  double cost = 0.0; ///< mean over all samples that count; 0: the volumes match; without samples: 1
  double samples = 0.0;  ///< number of those with a partner in the reference
  double possible = 0.0; ///< number of those that could have one
  /** Minus half the derivative of `cost` by each control point, and half its lumped Hessian. */
  ControlForces forces;
};

/** The positions on one side of a plane (mm, world). */
struct HalfSpace
{
  glm::dvec3 normal{ 0.0 }; ///< of length 1; 0: everywhere
  double offsetMm = 0.0;    ///< dot(normal, position) is at least this

  bool holds(const glm::dvec3& position) const
  {
    return glm::dot(this->normal, position) >= this->offsetMm;
  }
};

/** The samples of a level: their positions, their weights, and how freely they move. */
struct LevelSamples
{
  LevelSamples(const LevelVolumes& level, const Lattice& lattice);

  /** The samples of a row from the first to before the last that count. */
  struct Stretch
  {
    int first = 0;
    int last = 0;
  };

  LatticeRows rows;
  Volume referenceWeights;
  std::vector<float> weights;     ///< of the volume; 0: the sample does not count
  std::vector<float> freedom;     ///< 0 to 1, from the lattice's mask; empty: 1 everywhere
  std::vector<Stretch> stretches; ///< for each row
  glm::vec3 stepsPerMm{ 1.0f };

  double possible = 0.0; ///< number of samples that count

  const Stretch& stretchOf(int j, int k) const
  {
    return this->stretches[static_cast<std::size_t>(k) * this->rows.samples().dimensions.y + j];
  }

  /** LatticeRows::visitRows for the rows with samples that count. */
  template <typename Visit>
  ControlForces visitRows(const std::vector<glm::vec3>& displacements, const Visit& visit) const
  {
    const auto hasSamples = [this](int j, int k) {
      return this->stretchOf(j, k).first < this->stretchOf(j, k).last;
    };
    return this->rows.visitRows(displacements, hasSamples, visit);
  }

  /** Finds `stretches` and `possible` from the weights. */
  void findStretches();

  /** Counts only samples whose position at rest is in the half. A later call replaces it. */
  void restrictTo(const HalfSpace& half);

  /** A sample that counts and has a partner in the reference. */
  struct Compared
  {
    std::size_t number = 0; ///< of the sample
    Taps taps;              ///< control points along x
    float weight = 0.0f;    ///< above 0
    float freedom = 1.0f;
    Neighbours at; ///< in the reference
  };

  /** Calls visit(sample) for each sample of a row that counts and is inside the reference. */
  template <typename Visit>
  void visitStretch(const SampleRow& row, const Stretch& stretch, const Visit& visit) const
  {
    const Grid& grid = this->rows.samples();
    Compared sample;
    for (int i = stretch.first; i < stretch.last; ++i)
    {
      sample.number = grid.offset(i, row.j, row.k);
      sample.weight = this->weights[sample.number];
      if (sample.weight <= 0.0f)
      {
        continue;
      }
      const glm::vec3 position = this->rows.position(i, row.j, row.k);
      sample.taps = this->rows.tapsAt(0, position.x);
      sample.freedom = this->freedom.empty() ? 1.0f : this->freedom[sample.number];
      sample.at = neighboursOf(grid.dimensions,
        position +
          this->stepsPerMm * (sample.freedom * LatticeRows::displacement(row, sample.taps)));
      if (sample.at.isInside)
      {
        visit(static_cast<const Compared&>(sample));
      }
    }
  }

  /**
   * The numbers of a volume at the samples that count; `numbers` of them for each point,
   * interleaved. The others are new elements of the vector.
   */
  template <typename Vector>
  Vector read(const Vector& values, int numbers) const
  {
    Vector result(values.size());
    this->readInto(values.data(), numbers, result.data());
    return result;
  }

private:
  void readInto(const float* values, int numbers, float* result) const;

  std::vector<float> Unrestricted; // weights; empty: restrictTo was not called
};

/** Divides forces by the number of samples, so that levels compare. */
BRAINSHIFT_DEFORMATION_EXPORT CostAndForces averaged(
  const std::vector<double>& rowSums, const std::vector<double>& rowWeights, ControlForces forces);

/** How much of a metric a comparison takes. Without quicker parts they are alike. */
enum class Part
{
  All,
  Quick,   ///< its quicker part
  Quickest ///< that by fewer samples
};

/** The comparison of the two volumes of one level. */
class Comparison
{
public:
  virtual ~Comparison() = default;

  /** Does a part of the work before the first comparison. True once it is complete. */
  virtual bool prepare() { return true; }

  /** Compares at displacements of the control points, mm along the grid's axes. */
  virtual CostAndForces compare(const std::vector<glm::vec3>& displacements) = 0;

  /** Compares only samples whose position at rest is in the half; once it is prepared. */
  virtual void restrictTo(const HalfSpace& half) = 0;

  /** Compares by a part of its metric. Afterwards prepare() may have more to do. */
  virtual void take(Part /*part*/) {}
};

/** A method of comparison. */
struct Metric
{
  Support support;            ///< neighbourhood that a comparison at a point depends on
  double bytesPerPoint = 0.0; ///< of a level's grid, while a comparison is made and used

  /**
   * @param lattice   over the volume's box; its mask gives how freely tissue moves; its
   *                  displacements are ignored
   */
  std::unique_ptr<Comparison> (*make)(LevelVolumes level, const Lattice& lattice) = nullptr;
};

/** Numbers that tell what is around a point, whatever the contrast. */
struct Descriptor
{
  Support support; ///< neighbourhood that the numbers depend on
  int numbers = 0; ///< of each point
  /** The numbers (0 to 1) of each point, interleaved. Null: there is no descriptor. */
  UnsetVector<float> (*make)(const Volume& volume) = nullptr;
};

/** One level of a refinement: its metric and its spacing. */
struct RefinementLevel
{
  const Metric* metric = nullptr;
  double spacingMm = 2.0; ///< of the samples; larger where the volume is coarser or too large
  double mostCost = 1.0;  ///< a level that starts with more is skipped: it might mislead
  bool isRigid = false;   ///< the volume moves as a whole, in up to three times as many steps
  bool isCapped = false;  ///< the spacing grows until there are at most 0.95 million samples
  int kept = 1; ///< of the positions found from several starts: the next level begins there
  double stiffness = 1.0; ///< factor on the stiffness of the plan
  Part part = Part::All;  ///< of its metric

  /** Whether two levels have the same comparison, perhaps another part of it. */
  bool isComparedLike(const RefinementLevel& other) const
  {
    return this->metric == other.metric && this->spacingMm == other.spacingMm &&
      this->mostCost == other.mostCost && this->isCapped == other.isCapped;
  }
};

/** Limits on the comparison with ultrasound inside a fan. */
struct FanLimits
{
  double marginMm = 10.0;      ///< tissue farther from the fan is not compared
  double mostSamples = 0.25e6; ///< inside the fan, so that a step stays short
};

/** How a result is checked (ResultCheck.h), and the largest figures of a good one. */
struct CheckPlan
{
  RefinementLevel halves; ///< rigid: it registers halves of what was compared
  RefinementLevel other;  ///< rigid: another metric, which registers all of it
  /**
   * Least fraction by which any other place that a search nearby finds costs more, by the metric of
   * the halves: a result below it is doubtful. 0: no search.
   */
  double rivalGain = 0.0;
  /** With a search: geometric mean of the distance of halves and the spread of the ends. */
  double scatterMm = 0.0;
  double halvesMm = 3.0; ///< mean distance of two halves, without a search
  double otherMm = 1.0;  ///< mean distance by which the other metric moves the result
  Descriptor
    blocks; ///< finds parts that belong elsewhere (BlockCheck.h); none: they are not looked for
};

/** The levels and factors of a refinement. */
struct RefinementPlan
{
  std::vector<RefinementLevel> levels; ///< coarse to fine
  double stiffness = 1.0;              ///< factor on the stiffness
  std::optional<FanLimits> fan;        ///< set: the reference is ultrasound inside a fan
  double converged = 1e-4;             ///< a level ends with a step that gains a smaller fraction
  CheckPlan check;
};

struct Similarity
{
  const char* name = "";                ///< in Python, lower case
  const char* label = "";               ///< in the panel
  const char* tooltip = "";             ///< use and method: sentences
  const char* overlapOf = "the volume"; ///< the whole of which the overlap is a fraction
  RefinementPlan plan;
};

/** All similarities. Their indices are the values of the property Similarity; 0 is the default. */
BRAINSHIFT_DEFORMATION_EXPORT const std::vector<Similarity>& similarities();
}

#endif
