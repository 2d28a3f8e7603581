// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Electrodes/SheetFit.h"

#include "Common/Numbers.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr int PerPlace = 5;            // two numbers at rest, three bent
constexpr int AtRest = 2;              // of these
constexpr int Rounds = 4;              // of weights
constexpr double OutlierFactor = 3.4;  // 99 % of a normal distribution in space
constexpr double DoubtedWeight = 0.5;  // of a contact that is farther off than OutlierFactor
constexpr std::size_t MostDoubted = 4; // one contact of a sheet in so many
constexpr std::size_t FewestLeft = 3;  // contacts of a sheet
constexpr double OffMm = 1.5;          // less is no contact off the cortex
constexpr double OffFactor = 3.0;      // times what is expected
constexpr double LeastDamping = 1e-9;
constexpr double MostDamping = 1e6;
constexpr double FillSlope = 0.01; // weight of first differences against second ones

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

Eigen::Vector3d eigen(const glm::dvec3& v)
{
  return { v.x, v.y, v.z };
}

glm::dvec3 glmOf(const Eigen::Vector3d& v)
{
  return { v.x(), v.y(), v.z() };
}

// Two unit vectors across a normal.
std::array<glm::dvec3, 2> tangents(const glm::dvec3& normal)
{
  const glm::dvec3 aside =
    std::abs(normal.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 first = glm::normalize(glm::cross(normal, aside));
  return { first, glm::cross(normal, first) };
}

// Two places that should be some length apart.
struct Spring
{
  std::size_t from;
  std::size_t to;
  std::size_t sheet;    // its number
  glm::dvec2 along;     // mm: from one to the other on the flat sheet
  glm::dvec2 middle;    // mm: between both there
  double stretch;       // deviation of this one alone, a fraction of its length
  double restDeviation; // mm

  double length() const { return glm::length(this->along); }
};

// The inverse covariance of what bent springs are too long (mm). Near springs stretch alike, by the
// square of the cosine between them: those along rows say nothing of those along columns.
Matrix stiffnessOf(const std::vector<Spring>& springs, const SheetSettings& settings)
{
  const auto count = static_cast<Eigen::Index>(springs.size());
  Matrix covariance = Matrix::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const Spring& a = springs[i];
    for (Eigen::Index j = 0; j <= i; ++j)
    {
      const Spring& b = springs[j];
      if (a.sheet == b.sheet)
      {
        const double projected = glm::dot(a.along, b.along);
        covariance(i, j) = covariance(j, i) = projected * projected / (a.length() * b.length()) *
          settings.strain.at(glm::distance(a.middle, b.middle));
      }
    }
    const double alone = a.length() * a.stretch;
    covariance(i, i) += alone * alone;
  }
  return covariance.llt().solve(Matrix::Identity(count, count)) * settings.stiffness *
    settings.stiffness;
}

// The covariance of the shift, given that the cortex stays beyond the opening.
class ShiftPrior
{
public:
  ShiftPrior(const std::vector<SurfacePoint>& anchors, const SheetSettings& settings)
    : Anchors(anchors)
    , Settings(settings)
  {
    const auto count = static_cast<Eigen::Index>(anchors.size());
    Matrix a(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      for (Eigen::Index j = 0; j <= i; ++j)
      {
        a(i, j) = settings.kernel.at(glm::distance(anchors[i].position, anchors[j].position)) *
          (this->along() * glm::dot(anchors[i].normal, anchors[j].normal) + this->across());
        a(j, i) = a(i, j);
      }
      a(i, i) += settings.anchorDeviation * settings.anchorDeviation;
    }
    this->Factor.compute(a);
  }

  // Its inverse at some positions: three rows for each. A part of the shift goes any way, the other
  // part along the normals of the cortex.
  Matrix precision(
    const std::vector<glm::dvec3>& rest, const std::vector<glm::dvec3>& normals) const
  {
    const auto count = static_cast<Eigen::Index>(rest.size());
    const auto held = static_cast<Eigen::Index>(this->Anchors.size());
    Matrix k = Matrix::Zero(3 * count, 3 * count);
    Matrix across(held, 3 * count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      for (Eigen::Index j = 0; j < count; ++j)
      {
        const double value = this->Settings.kernel.at(glm::distance(rest[i], rest[j]));
        k.block<3, 3>(3 * i, 3 * j) = value *
          (this->along() * Eigen::Matrix3d::Identity() +
            this->across() * eigen(normals[i]) * eigen(normals[j]).transpose());
      }
      for (Eigen::Index j = 0; j < held; ++j)
      {
        const SurfacePoint& anchor = this->Anchors[j];
        const double value = this->Settings.kernel.at(glm::distance(rest[i], anchor.position));
        across.block<1, 3>(j, 3 * i) =
          value * eigen(this->along() * anchor.normal + this->across() * normals[i]).transpose();
      }
    }
    if (held > 0)
    {
      this->Factor.matrixL().solveInPlace(across);
      k.noalias() -= across.transpose() * across;
    }
    k.diagonal().array() += this->Settings.tissueDeviation * this->Settings.tissueDeviation;
    return k.llt().solve(Matrix::Identity(3 * count, 3 * count));
  }

private:
  // Fractions of the variance.
  double along() const { return this->Settings.slide * this->Settings.slide; }
  double across() const { return 1.0 - this->along(); }

  const std::vector<SurfacePoint>& Anchors;
  const SheetSettings& Settings;
  Eigen::LLT<Matrix> Factor;
};

// All unknowns.
struct Places
{
  std::vector<glm::dvec3> rest;
  std::vector<glm::dvec3> normals; // at rest
  std::vector<glm::dvec3> bent;
};

class SheetSolver
{
public:
  SheetSolver(const std::vector<Sheet>& sheets, const RestSurface& surface,
    const std::vector<SurfacePoint>& anchors, const SheetSettings& settings)
    : Sheets(sheets)
    , Surface(surface)
    , Settings(settings)
    , Prior(anchors, settings)
  {
    for (const Sheet& sheet : sheets)
    {
      this->addSprings(sheet, static_cast<std::size_t>(&sheet - sheets.data()));
      this->Measured.insert(this->Measured.end(), sheet.contacts.begin(), sheet.contacts.end());
    }
    this->Stiffness = stiffnessOf(this->Springs, settings);
    this->Weights.assign(this->Measured.size(), 1.0);
    this->begin();
  }

  std::vector<SheetPlace> solve()
  {
    for (int round = 0; round < Rounds; ++round)
    {
      this->minimise();
      this->judge();
    }
    if (this->leaveOutDoubted())
    {
      this->begin();
      this->minimise();
      this->judge();
    }
    return this->Found;
  }

private:
  std::size_t count() const { return this->Measured.size(); }

  // Gives doubted contacts no weight at all: a contact that floats leads the sheet aside along the
  // cortex, where little leads it back. A sheet most of whose contacts are doubted keeps them.
  // Returns whether any lost its weight.
  bool leaveOutDoubted()
  {
    bool isAny = false;
    std::size_t first = 0;
    for (const Sheet& sheet : this->Sheets)
    {
      std::vector<std::size_t> doubted;
      std::size_t measured = 0;
      for (std::size_t i = first; i < first + sheet.contacts.size(); ++i)
      {
        const bool isDoubted = this->Weights[i] < DoubtedWeight || this->Found[i].isOff();
        measured += this->Measured[i] ? 1 : 0;
        if (this->Measured[i] && isDoubted)
        {
          doubted.push_back(i);
        }
      }
      first += sheet.contacts.size();
      if (MostDoubted * doubted.size() > measured || measured < FewestLeft + doubted.size())
      {
        continue;
      }
      for (const std::size_t i : doubted)
      {
        this->Weights[i] = 0.0;
        isAny = true;
      }
    }
    return isAny;
  }

  // Begins at the contacts that count, and at the nearest points of the cortex.
  void begin()
  {
    this->At.bent.clear();
    std::size_t first = 0;
    for (Sheet sheet : this->Sheets)
    {
      for (std::size_t k = 0; k < sheet.contacts.size(); ++k)
      {
        if (!(this->Weights[first + k] > 0.0))
        {
          sheet.contacts[k].reset();
        }
      }
      first += sheet.contacts.size();
      const std::vector<glm::dvec3> filled = filledSheet(sheet);
      this->At.bent.insert(this->At.bent.end(), filled.begin(), filled.end());
    }
    this->At.rest = this->At.bent;
    this->At.normals.resize(this->At.bent.size());
    this->project(this->At);
  }

  void addSprings(const Sheet& sheet, std::size_t number)
  {
    if (!(this->Settings.stiffness > 0.0))
    {
      return;
    }
    const std::size_t first = this->Measured.size();
    const auto add = [&](int row, int column, const glm::ivec2& step, double stretch) {
      const glm::ivec2 to(row + step.x, column + step.y);
      if (to.x < 0 || to.x >= sheet.rows || to.y < 0 || to.y >= sheet.columns)
      {
        return;
      }
      const double tissue = std::max(stretch, this->Settings.tissueStretch);
      const glm::dvec2 along = sheet.pitchMm * glm::dvec2(step);
      this->Springs.push_back(
        { first + row * sheet.columns + column, first + to.x * sheet.columns + to.y, number, along,
          sheet.pitchMm * glm::dvec2(row, column) + 0.5 * along, stretch,
          glm::length(along) * tissue / this->Settings.stiffness });
    };
    for (int row = 0; row < sheet.rows; ++row)
    {
      for (int column = 0; column < sheet.columns; ++column)
      {
        add(row, column, { 0, 1 }, this->Settings.stretch);
        add(row, column, { 1, 0 }, this->Settings.stretch);
        add(row, column, { 1, 1 }, this->Settings.shear);
        add(row, column, { -1, 1 }, this->Settings.shear);
      }
    }
  }

  // Puts all positions at rest onto the cortex.
  void project(Places& places) const
  {
    for (std::size_t i = 0; i < places.rest.size(); ++i)
    {
      const std::optional<SurfacePoint> foot = this->Surface(places.rest[i], i);
      if (!foot)
      {
        throw Problem("The cortex at rest has no points");
      }
      places.rest[i] = foot->position;
      places.normals[i] = foot->normal;
    }
  }

  Vector shift(const Places& places) const
  {
    Vector result(3 * this->count());
    for (std::size_t i = 0; i < this->count(); ++i)
    {
      result.segment<3>(3 * static_cast<Eigen::Index>(i)) = eigen(places.bent[i] - places.rest[i]);
    }
    return result;
  }

  // By how much bent springs are longer than they want to be (mm).
  Vector longer(const Places& places) const
  {
    Vector result(this->Springs.size());
    for (std::size_t i = 0; i < this->Springs.size(); ++i)
    {
      const Spring& spring = this->Springs[i];
      result[static_cast<Eigen::Index>(i)] =
        glm::distance(places.bent[spring.from], places.bent[spring.to]) - spring.length();
    }
    return result;
  }

  double energy(const Places& places, const Matrix& precision) const
  {
    const Vector shift = this->shift(places);
    double sum = shift.dot(precision * shift);
    const double variance = this->Settings.contactDeviation * this->Settings.contactDeviation;
    for (std::size_t i = 0; i < this->count(); ++i)
    {
      if (const std::optional<glm::dvec3>& measured = this->Measured[i])
      {
        const glm::dvec3 away = places.bent[i] - *measured;
        sum += this->Weights[i] * glm::dot(away, away) / variance;
      }
    }
    const Vector longer = this->longer(places);
    sum += longer.dot(this->Stiffness * longer);
    for (const Spring& spring : this->Springs)
    {
      const double tissue =
        (glm::distance(places.rest[spring.from], places.rest[spring.to]) - spring.length()) /
        spring.restDeviation;
      sum += tissue * tissue;
    }
    return sum;
  }

  // Adds the square of a distance minus a length: `jacobian` of each end is what moves it.
  static void addSpring(Matrix& h, Vector& g, const std::array<Eigen::Index, 2>& at,
    const std::array<Vector, 2>& jacobians, double residual)
  {
    for (int a = 0; a < 2; ++a)
    {
      const Eigen::Index size = jacobians[a].size();
      g.segment(at[a], size) += residual * jacobians[a];
      for (int b = 0; b < 2; ++b)
      {
        h.block(at[a], at[b], size, size) += jacobians[a] * jacobians[b].transpose();
      }
    }
  }

  void addSprings(Matrix& h, Vector& g) const
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < this->Springs.size(); ++i)
    {
      const Spring& spring = this->Springs[i];
      const std::array<std::size_t, 2> ends{ spring.from, spring.to };
      const glm::dvec3 bent = this->At.bent[spring.to] - this->At.bent[spring.from];
      const glm::dvec3 rest = this->At.rest[spring.to] - this->At.rest[spring.from];
      if (!(glm::length(bent) > 0.0 && glm::length(rest) > 0.0))
      {
        continue; // no direction leads apart
      }
      std::array<Eigen::Index, 2> restAt{};
      std::array<Vector, 2> restBy;
      for (int end = 0; end < 2; ++end)
      {
        const double sign = end ? 1.0 : -1.0;
        restAt[end] = PerPlace * static_cast<Eigen::Index>(ends[end]);
        for (int axis = 0; axis < 3; ++axis)
        {
          entries.emplace_back(static_cast<int>(i), static_cast<int>(restAt[end]) + AtRest + axis,
            sign * bent[axis] / glm::length(bent));
        }
        restBy[end] = Vector(AtRest);
        const std::array<glm::dvec3, 2> along = tangents(this->At.normals[ends[end]]);
        for (int k = 0; k < AtRest; ++k)
        {
          restBy[end][k] = glm::dot(along[k], glm::normalize(rest)) * sign / spring.restDeviation;
        }
      }
      addSpring(h, g, restAt, restBy, (glm::length(rest) - spring.length()) / spring.restDeviation);
    }
    Sparse by(static_cast<Eigen::Index>(this->Springs.size()), h.rows());
    by.setFromTriplets(entries.begin(), entries.end());
    const Matrix weighted = this->Stiffness * by;
    h += by.transpose() * weighted;
    g += weighted.transpose() * this->longer(this->At);
  }

  // How the shift follows from the unknowns, to first order.
  Matrix shiftByUnknowns() const
  {
    const auto size = static_cast<Eigen::Index>(this->count());
    Matrix result = Matrix::Zero(3 * size, PerPlace * size);
    for (Eigen::Index i = 0; i < size; ++i)
    {
      const std::array<glm::dvec3, 2> along = tangents(this->At.normals[i]);
      for (int k = 0; k < AtRest; ++k)
      {
        result.block<3, 1>(3 * i, PerPlace * i + k) = -eigen(along[k]);
      }
      result.block<3, 3>(3 * i, PerPlace * i + AtRest).setIdentity();
    }
    return result;
  }

  // Half the second derivatives of the energy, and half its gradient.
  void linearise(const Matrix& precision, Matrix& h, Vector& g) const
  {
    const Matrix by = this->shiftByUnknowns();
    const Matrix weighted = precision * by;
    h = by.transpose() * weighted;
    g = weighted.transpose() * this->shift(this->At);
    const double variance = this->Settings.contactDeviation * this->Settings.contactDeviation;
    for (std::size_t i = 0; i < this->count(); ++i)
    {
      if (const std::optional<glm::dvec3>& measured = this->Measured[i])
      {
        const Eigen::Index at = PerPlace * static_cast<Eigen::Index>(i) + AtRest;
        const double weight = this->Weights[i] / variance;
        h.diagonal().segment<3>(at).array() += weight;
        g.segment<3>(at) += weight * eigen(this->At.bent[i] - *measured);
      }
    }
    this->addSprings(h, g);
  }

  Places moved(const Vector& step) const
  {
    Places places = this->At;
    for (std::size_t i = 0; i < this->count(); ++i)
    {
      const Eigen::Index at = PerPlace * static_cast<Eigen::Index>(i);
      const std::array<glm::dvec3, 2> along = tangents(this->At.normals[i]);
      places.rest[i] += step[at] * along[0] + step[at + 1] * along[1];
      places.bent[i] += glmOf(step.segment<3>(at + AtRest));
    }
    this->project(places);
    return places;
  }

  void minimise()
  {
    double damping = 1e-3;
    for (int i = 0; i < this->Settings.steps; ++i)
    {
      const Matrix precision = this->Prior.precision(this->At.rest, this->At.normals);
      Matrix h;
      Vector g;
      this->linearise(precision, h, g);
      const double before = this->energy(this->At, precision);
      double largest = 0.0;
      for (; damping < MostDamping; damping *= 10.0)
      {
        Matrix damped = h;
        damped.diagonal() *= 1.0 + damping;
        const Vector step = -damped.llt().solve(g);
        Places places = this->moved(step);
        if (this->energy(places, precision) <= before)
        {
          largest = step.cwiseAbs().maxCoeff();
          this->At = std::move(places);
          damping = std::max(LeastDamping, 0.1 * damping);
          break;
        }
      }
      if (largest < this->Settings.stepToleranceMm)
      {
        return;
      }
    }
  }

  // Compares each contact with where all others predict it, and weights it by that.
  void judge()
  {
    Matrix h;
    Vector g;
    this->linearise(this->Prior.precision(this->At.rest, this->At.normals), h, g);
    const Matrix covariance = h.llt().solve(Matrix::Identity(h.rows(), h.cols()));
    const double variance = this->Settings.contactDeviation * this->Settings.contactDeviation;
    this->Found.assign(this->count(), {});
    for (std::size_t i = 0; i < this->count(); ++i)
    {
      const Eigen::Index at = PerPlace * static_cast<Eigen::Index>(i);
      SheetPlace& place = this->Found[i];
      place.rest = this->At.rest[i];
      place.bent = this->At.bent[i];
      place.deviation = std::sqrt(0.5 * covariance.diagonal().segment<AtRest>(at).sum());
      place.outside = place.outsideDeviation = place.leftOut = NaN;
      const std::optional<glm::dvec3>& measured = this->Measured[i];
      if (!measured)
      {
        continue;
      }
      const Eigen::Matrix3d bent = covariance.block<3, 3>(at + AtRest, at + AtRest);
      const Eigen::Matrix3d kept =
        Eigen::Matrix3d::Identity() - bent * (this->Weights[i] / variance);
      const Eigen::Vector3d error = kept.inverse() * eigen(*measured - this->At.bent[i]);
      const Eigen::Matrix3d expected =
        kept.inverse() * bent + Eigen::Matrix3d::Identity() * variance;
      const Eigen::Vector3d normal = eigen(this->At.normals[i]);
      place.leftOut = error.norm();
      place.outside = normal.dot(error);
      place.outsideDeviation = std::sqrt(normal.dot(expected * normal));
      const double wrong = std::sqrt(error.dot(expected.inverse() * error)) / OutlierFactor;
      this->Weights[i] = wrong > 1.0 ? 1.0 / (wrong * wrong) : 1.0;
    }
  }

  const std::vector<Sheet>& Sheets;
  const RestSurface& Surface;
  const SheetSettings& Settings;
  ShiftPrior Prior;
  std::vector<Spring> Springs;
  Matrix Stiffness; // 1 / mm^2, of bent springs
  std::vector<std::optional<glm::dvec3>> Measured;
  std::vector<double> Weights;
  Places At;
  std::vector<SheetPlace> Found;
};

void requireGood(const SheetSettings& settings)
{
  constexpr double MostStiffness = 100.0;
  if (!(settings.stiffness >= 0.0 && settings.stiffness <= MostStiffness))
  {
    throw Problem("The stiffness of the sheets is " + numberText(settings.stiffness) +
      "; it must be 0 to " + numberText(MostStiffness));
  }
  if (!(settings.contactDeviation > 0.0 && std::isfinite(settings.contactDeviation)))
  {
    throw Problem("The deviation of contacts is " + numberText(settings.contactDeviation) +
      " mm; it must be above 0 mm and finite");
  }
}

void requireGood(const std::vector<Sheet>& sheets)
{
  std::size_t places = 0;
  for (const Sheet& sheet : sheets)
  {
    places += sheet.contacts.size();
    const auto known = std::count_if(sheet.contacts.begin(), sheet.contacts.end(),
      [](const std::optional<glm::dvec3>& contact) { return contact.has_value(); });
    if (known < 3 || !(sheet.pitchMm > 0.0))
    {
      throw Problem("A sheet has " + std::to_string(known) + " contacts " +
        numberText(sheet.pitchMm) + " mm apart; it needs 3 contacts or more, and a pitch");
    }
  }
  if (places > MostSheetPlaces)
  {
    throw Problem("The sheets have " + std::to_string(places) + " contacts; the limit is " +
      std::to_string(MostSheetPlaces));
  }
}
}

bool SheetPlace::isOff() const
{
  return std::abs(this->outside) > std::max(OffMm, OffFactor * this->outsideDeviation);
}

std::vector<glm::dvec3> filledSheet(const Sheet& sheet)
{
  const auto count = static_cast<Eigen::Index>(sheet.contacts.size());
  Matrix h = Matrix::Zero(count, count);
  const auto add = [&](int row, int column, const glm::ivec2& step, bool isSecond) {
    const int last = isSecond ? 2 : 1;
    if (row + last * step.x >= sheet.rows || column + last * step.y >= sheet.columns)
    {
      return;
    }
    Vector difference = Vector::Zero(count);
    const Eigen::Index at = row * sheet.columns + column;
    const Eigen::Index by = step.x * sheet.columns + step.y;
    difference[at] = 1.0;
    difference[at + by] = isSecond ? -2.0 : -1.0;
    difference[at + last * by] += isSecond ? 1.0 : 0.0;
    h += (isSecond ? 1.0 : FillSlope * FillSlope) * difference * difference.transpose();
  };
  for (int row = 0; row < sheet.rows; ++row)
  {
    for (int column = 0; column < sheet.columns; ++column)
    {
      for (const glm::ivec2& step : { glm::ivec2(0, 1), glm::ivec2(1, 0) })
      {
        add(row, column, step, true);
        add(row, column, step, false);
      }
    }
  }
  constexpr double Fixed = 1e8; // against differences
  Matrix values = Matrix::Zero(count, 3);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    if (const std::optional<glm::dvec3>& contact = sheet.contacts[i])
    {
      h(i, i) += Fixed;
      values.row(i) = Fixed * eigen(*contact).transpose();
    }
  }
  const Matrix filled = h.ldlt().solve(values);
  std::vector<glm::dvec3> result;
  result.reserve(count);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    result.push_back(sheet.contacts[i].value_or(glmOf(filled.row(i).transpose())));
  }
  return result;
}

std::vector<std::vector<SheetPlace>> fitSheets(const std::vector<Sheet>& sheets,
  const RestSurface& surface, const std::vector<SurfacePoint>& anchors,
  const SheetSettings& settings)
{
  requireGood(settings);
  requireGood(sheets);
  if (sheets.empty())
  {
    return {};
  }
  const std::vector<SheetPlace> all = SheetSolver(sheets, surface, anchors, settings).solve();
  std::vector<std::vector<SheetPlace>> result;
  auto next = all.begin();
  for (const Sheet& sheet : sheets)
  {
    const auto end = next + static_cast<std::ptrdiff_t>(sheet.contacts.size());
    result.emplace_back(next, end);
    next = end;
  }
  return result;
}
}
