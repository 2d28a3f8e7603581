// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A Gaussian process for displacements: the smoothest field through measurements, and its
/// uncertainty.
///
/// Each component of the displacement u is a Gaussian process with the same covariance. A row
/// measures one component along an axis at one point: axis . u(point) = value, with noise. Three
/// rows at one point measure all of it. With the covariance matrix A of all rows, their noise
/// added, the field is u(x) = sum over rows of k(x, point) axis w, and A w = values.
///
/// Everything is double precision. A is factored once (Cholesky); other values for the same rows
/// need no new factor.
///
/// Source: Rasmussen and Williams, Gaussian Processes for Machine Learning (2006): prediction and
/// its variance, equations 2.25 and 2.26 and algorithm 2.1; the rigid mean, section 2.7; leaving
/// rows out in closed form, section 5.4.2, equations 5.10 to 5.12, here for three rows together.
#ifndef BrainShift_Process_h
#define BrainShift_Process_h

#include "Common/Export.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace brainshift
{
/**
 * The Matern covariance (mm^2) with smoothness 5/2, of one component of the displacement at two
 * points. Fields with it have continuous derivatives, so tissue that follows them has no creases.
 * Source: Rasmussen and Williams, equation 4.17.
 */
struct Matern
{
  double lengthMm = 60.0;   ///< mm over which neighbours follow; above 0
  double deviationMm = 8.0; ///< standard deviation (mm) of a displacement before any measurement

  /** Factor that makes a distance (mm) a number without unit. */
  double scale() const { return std::sqrt(5.0) / this->lengthMm; }

  /** Variance (mm^2) before any measurement. */
  double variance() const { return this->deviationMm * this->deviationMm; }

  /** Covariance (mm^2) at a distance (mm). */
  double at(double distanceMm) const
  {
    const double a = this->scale() * distanceMm;
    return this->variance() * (1.0 + a + a * a / 3.0) * std::exp(-a);
  }
};

/** Most rows of a process: the matrix takes 288 MB and the factor about 20 s. */
constexpr std::size_t MostRows = 6000;

/** One number that was measured: axis . u(point) = value, with this variance. */
struct Row
{
  glm::dvec3 point{ 0.0 }; ///< mm, rest frame
  glm::dvec3 axis{ 0.0 };  ///< unit vector
  double value = 0.0;      ///< mm
  double variance = 1.0;   ///< mm^2, above 0
};

/**
 * A small motion that the process assumes: tissue moves as a whole and rotates about `centre`
 * before it bends. The translation is free.
 */
struct RigidMean
{
  glm::dvec3 centre{ 0.0 };       ///< mm, rest frame
  double rotationPrecision = 0.0; ///< 1 / rad^2: one over the variance of a rotation; 0: free
};

/** Translation (mm), then rotation (rad) around the mean's centre. */
struct SmallMotion
{
  glm::dvec3 translation{ 0.0 };
  glm::dvec3 rotation{ 0.0 };
};

/** An error that is left at rows which were not used for it, and its expected square. */
struct LeftOut
{
  glm::dvec3 error{ 0.0 };      ///< mm, along the axes of the three rows
  glm::dmat3 covariance{ 0.0 }; ///< mm^2, of that error
};

/** A field at one position. */
struct FieldValue
{
  glm::dvec3 displacement{ 0.0 }; ///< mm
  glm::dmat3 gradient{ 0.0 };     ///< column a is the derivative along axis a
};

class BRAINSHIFT_DEFORMATION_EXPORT Process
{
public:
  explicit Process(const Matern& kernel);
  ~Process();
  Process(Process&& other) noexcept;
  Process& operator=(Process&& other) noexcept;

  /**
   * Takes other rows and factors their covariance. Throws a Problem if there are too many rows or
   * they contradict each other beyond what numbers can hold.
   */
  void setRows(std::vector<Row> rows, const std::optional<RigidMean>& mean = {});

  /** Takes other values for the same rows. There is no new factor. */
  void setValues(const std::vector<double>& values);

  const std::vector<Row>& rows() const;

  /** How often a matrix was factored. */
  int factors() const;

  /**
   * The rigid motion that the values still hold, to first order. Take it out of the values, and the
   * field is what is left.
   *
   * @param taken   rotation (rad) that was taken out of the values before; the precision draws the
   *                sum of both to 0
   */
  SmallMotion remainingMotion(const glm::dvec3& taken) const;

  /** Displacement (mm) at a position (mm, rest frame). The rigid mean has no part in it. */
  glm::dvec3 displacement(const glm::dvec3& rest) const;

  /** Displacements (mm) at many positions, on all cores. */
  std::vector<glm::dvec3> displacements(const std::vector<glm::dvec3>& rest) const;

  /** Derivatives of the displacement: column a is du / d(rest_a). */
  glm::dmat3 gradient(const glm::dvec3& rest) const { return this->valueAt(rest).gradient; }

  /** Displacement and derivatives at once, in the time of one of them. */
  FieldValue valueAt(const glm::dvec3& rest) const;

  /**
   * Covariance (mm^2) of the displacement that is left, that of the rigid mean included. Without
   * rows it is infinite along each axis if there is a mean, else that of the kernel.
   */
  glm::dmat3 covariance(const glm::dvec3& rest) const;

  /**
   * A third of the trace (mm^2) of covariance() at many positions, on all cores. It pays for more
   * positions than there are rows: it solves once for all of them.
   */
  std::vector<double> variances(const std::vector<glm::dvec3>& rest) const;

  /** All numbers that covariance() depends on. Values of the rows are not among them. */
  std::vector<double> covarianceKey() const;

  /**
   * The error of a process without three rows at them, in closed form. The values must hold no
   * rigid motion any more.
   *
   * @param first   number of the first of the three rows
   */
  LeftOut leftOut(std::size_t first) const;

private:
  struct State;
  std::unique_ptr<State> Internal;
};
}

#endif
