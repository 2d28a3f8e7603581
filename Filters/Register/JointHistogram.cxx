// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/JointHistogram.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace brainshift
{
namespace
{
double entropy(const std::vector<double>& counts, double all)
{
  double sum = 0.0;
  for (const double count : counts)
  {
    const double fraction = count / all;
    sum -= fraction > 0.0 ? fraction * std::log(fraction) : 0.0;
  }
  return sum;
}
}

JointHistogram::JointHistogram()
  : Cells(static_cast<std::size_t>(Bins) * Bins, 0.0)
{
}

void JointHistogram::add(float a, float b)
{
  const float atA = std::clamp(a, 0.0f, 1.0f) * (Bins - 1);
  const float atB = std::clamp(b, 0.0f, 1.0f) * (Bins - 1);
  const int lowA = std::min(static_cast<int>(atA), Bins - 2);
  const int lowB = std::min(static_cast<int>(atB), Bins - 2);
  const double fractionA = atA - static_cast<float>(lowA);
  const double fractionB = atB - static_cast<float>(lowB);
  double* cell = &this->Cells[static_cast<std::size_t>(lowA) * Bins + lowB];
  cell[0] += (1.0 - fractionA) * (1.0 - fractionB);
  cell[1] += (1.0 - fractionA) * fractionB;
  cell[Bins] += fractionA * (1.0 - fractionB);
  cell[Bins + 1] += fractionA * fractionB;
  this->Count += 1.0;
}

void JointHistogram::add(const JointHistogram& other)
{
  for (std::size_t i = 0; i < this->Cells.size(); ++i)
  {
    this->Cells[i] += other.Cells[i];
  }
  this->Count += other.Count;
}

double JointHistogram::information() const
{
  if (this->Count <= 0.0)
  {
    return 0.0;
  }
  std::vector<double> ofA(Bins, 0.0);
  std::vector<double> ofB(Bins, 0.0);
  for (int a = 0; a < Bins; ++a)
  {
    for (int b = 0; b < Bins; ++b)
    {
      const double cell = this->Cells[static_cast<std::size_t>(a) * Bins + b];
      ofA[a] += cell;
      ofB[b] += cell;
    }
  }
  return std::max(
    0.0, entropy(ofA, this->Count) + entropy(ofB, this->Count) - entropy(this->Cells, this->Count));
}
}
