// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Explains the reference in small windows by the volume, and by a second number of it.
///
/// In each window the reference is fitted by a p + c, or by a p + b q + c. There p is the volume
/// and q its gradient magnitude or its square. The cost of a window is the fraction of the
/// reference's variance that the fit leaves. With p alone it is 1 minus the squared local
/// correlation; with the gradient magnitude it is 1 minus LC2 (Wein et al., MICCAI 2013; Fuerst et
/// al., Medical Image Analysis 18(8), 2014). With the square, the two scans of a tissue may have
/// any contrast of which a parabola is a good picture within a window.
#ifndef BrainShift_LocalFitSimilarity_h
#define BrainShift_LocalFitSimilarity_h

#include "Filters/Register/Similarity.h"

#include <algorithm>

namespace brainshift
{
// Sums over windows around every second point of a grid, and the results of windows for their
// points.
//
// Neighbouring windows have most of their points in common, so that windows around every point
// would add little and take eight times as long to fit.

constexpr int WindowStride = 2; ///< points from one window's middle to that of the next

/** Number of windows of a line of so many points. The first is around the first point. */
constexpr int windowsAlong(int points)
{
  return (points + WindowStride - 1) / WindowStride;
}

/** Numbers beside each other for each point or window, x fastest. */
struct Block
{
  glm::ivec3 dimensions{ 0 };
  int numbers = 0;
  UnsetVector<float> values;

  Block() = default;
  /** All values are 0. */
  Block(const glm::ivec3& sides, int each)
  {
    this->reshape(sides, each);
    std::fill(this->values.begin(), this->values.end(), 0.0f);
  }

  /** The values are undefined. */
  void reshape(const glm::ivec3& sides, int each)
  {
    this->dimensions = sides;
    this->numbers = each;
    this->values.resize(static_cast<std::size_t>(sides.x) * sides.y * sides.z * each);
  }

  float* row(int j, int k)
  {
    return this->values.data() +
      (static_cast<std::size_t>(k) * this->dimensions.y + j) * this->dimensions.x * this->numbers;
  }
  const float* row(int j, int k) const { return const_cast<Block*>(this)->row(j, k); }
};

/** Windows with so many points on each side of the middle. */
class BRAINSHIFT_DEFORMATION_EXPORT Windows
{
public:
  explicit Windows(int radius)
    : Radius(radius)
  {
  }

  /** Points along each side. */
  int side() const { return 2 * this->Radius + 1; }

  /** Adds up a row of points, `numbers` for each, for each of its windows. */
  void gatherRow(const float* points, int count, int numbers, float* windows) const;

  /** For each point of a row, the sum of the windows that hold it. */
  void spreadRow(const float* windows, int count, int numbers, float* points) const;

  /** The same along y and z of a block whose rows are gathered. Uses the memory of `windows`. */
  void gather(const Block& rows, Block& windows);

  /** The same along z and y of a block of windows; the rows of `points` are still to be spread. */
  void spread(const Block& windows, const glm::ivec3& points, Block& rows);

private:
  int Radius;
  Block Between; // after the first of two axes
};

/** What explains the reference beside the volume. */
enum class SecondTerm
{
  None,
  GradientLength,
  Square
};

struct LocalFit
{
  SecondTerm second = SecondTerm::None;
  int windowRadius = 3; ///< points
  float ridge = 1e-4f;  ///< variance of the volume (range 0 to 1) below which it is flat; above 0
  bool isThin = false;  ///< every second sample, those of a checkerboard
  /** Fraction of a volume's mean variance below which a window carries little information. */
  float leastVariance = 0.02f;
};

class LocalFitSimilarity : public Comparison
{
public:
  /** For each point of a level: the windows' sums along rows, the sample as read, and weights. */
  static constexpr double BytesPerPoint = 80.0;

  LocalFitSimilarity(LevelVolumes level, const Lattice& lattice, const LocalFit& fit);

  ~LocalFitSimilarity() override;

  CostAndForces compare(const std::vector<glm::vec3>& displacements) override;

  void restrictTo(const HalfSpace& half) override;

private:
  struct Work;
  void leaveOutIdleSamples();
  void thinOut();
  void takeSample(const LevelSamples::Compared& sample, float* sums, Work& work) const;
  void takeSamples(const std::vector<glm::vec3>& displacements, Work& work);
  void fitWindows(Work& work);
  /** Replaces the sums of a window by its results (Left); adds to the cost and the windows. */
  void fitWindow(float* numbers, bool counts, double& sum, double& windows) const;
  ControlForces takeForces(const std::vector<glm::vec3>& displacements, const Work& work) const;

  bool hasSecond() const { return !this->Second.empty(); }
  void readSecond(const LevelVolumes& level, SecondTerm second);

  Windows Around;
  LevelSamples Samples;
  std::vector<float> Rest;     // at the samples, 0 to 1
  std::vector<float> Second;   // the same of the second term; empty without
  Volume Reference;            // at the points, 0 to 1
  std::vector<char> Varies;    // of the windows; 1: the volume varies there
  float Ridge;                 // of LocalFit
  bool IsThin;                 // of LocalFit
  float LeastVariance;         // of the reference, below which a window carries little information
  std::unique_ptr<Work> Known; // of the last comparison; its memory serves the next one
};

/** The metrics of local fits. */
Metric localCorrelationMetric(); ///< by the volume alone, windows of 7 points
Metric linearFitWithGradients(); ///< LC2, windows of 5 points
Metric quadraticFitMetric();     ///< by the volume and its square, windows of 5 points
}

#endif
