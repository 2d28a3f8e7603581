// SPDX-License-Identifier: BSD-3-Clause
// Proves that what is told by one pair of clipping planes is found by another.
#include "Representations/Scene/Frustum.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

using namespace brainshift;

namespace
{
glm::dmat4 camera(bool parallel, double near, double far)
{
  const glm::dmat4 view = glm::lookAt(
    glm::dvec3(30.0, -20.0, 90.0), glm::dvec3(5.0, 3.0, 1.0), glm::dvec3(0.1, 1.0, 0.0));
  return (parallel ? glm::ortho(-40.0, 40.0, -30.0, 30.0, near, far)
                   : glm::perspective(0.6, 4.0 / 3.0, near, far)) *
    view;
}

glm::dvec3 at(const Frustum& frustum, const glm::dvec2& ndc, double share)
{
  const glm::dvec3 near = frustum.near.at(ndc);
  return near + share * (frustum.far.at(ndc) - near);
}
}

TEST(Frustum, SharesAreThoseOfOtherPlanes)
{
  for (const bool parallel : { false, true })
  {
    const Frustum from = frustumOf(camera(parallel, 20.0, 150.0));
    const Frustum to = frustumOf(camera(parallel, 5.0, 400.0));
    const glm::dvec2 scale = fractionFromFraction(to, from);
    for (const glm::dvec2& ndc : { glm::dvec2(0.0), glm::dvec2(0.9, -0.7), glm::dvec2(-0.3, 0.8) })
    {
      for (const double share : { 0.0, 0.3, 1.0 })
      {
        const glm::dvec3 position = at(from, ndc, share);
        EXPECT_LT(glm::distance(position, at(to, ndc, share * scale.x + scale.y)), 1e-9) << share;
      }
    }
    const glm::dvec2 same = fractionFromFraction(from, from);
    EXPECT_NEAR(same.x, 1.0, 1e-12);
    EXPECT_NEAR(same.y, 0.0, 1e-12);
  }
}
