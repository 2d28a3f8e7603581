// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Pulls and pins as numbers of the properties Pulls and Pins of a Fit Deformation.
#ifndef BrainShift_PullList_h
#define BrainShift_PullList_h

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
/// Tissue that a hand put somewhere.
struct Pull
{
  glm::dvec3 rest{ 0.0 };   ///< Where it was, mm, rest frame.
  glm::dvec3 target{ 0.0 }; ///< Where it was put, mm.
  double weight = 1.0;      ///< How far it is trusted; 0: switched off.
};

/// Tissue that stays.
struct Pin
{
  glm::dvec3 rest{ 0.0 }; ///< mm, rest frame.
  bool enabled = true;
};

/// Numbers of an incomplete pull or pin at the end do not count.
std::vector<Pull> pullsFrom(const std::vector<double>& numbers);
std::vector<Pin> pinsFrom(const std::vector<double>& numbers);

std::vector<double> numbersFrom(const std::vector<Pull>& pulls);
std::vector<double> numbersFrom(const std::vector<Pin>& pins);

/// Place in the list of the pull or pin whose tissue is nearest to `rest`, at most `radius` mm
/// away. The size of the list if there is none.
std::size_t nearest(const std::vector<Pull>& pulls, const glm::dvec3& rest, double radius);
std::size_t nearest(const std::vector<Pin>& pins, const glm::dvec3& rest, double radius);
}

#endif
