// SPDX-License-Identifier: BSD-3-Clause
// Proves that what a tool shows of itself is where its stroke acts, and that lines join neighbours.
#include "Widgets/LatticeShapes.h"
#include "vtkLatticeRepresentation.h"

#include "vtkActor.h"
#include "vtkDataObject.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPropCollection.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace brainshift;

namespace
{
Stroke someStroke(Tool tool)
{
  Stroke stroke;
  stroke.tool = tool;
  stroke.anchor = { 3.0, -2.0, 7.0 };
  stroke.axis = { 1.0, 2.0, -0.5 };
  stroke.major = 9.0;
  stroke.minor = 4.0;
  stroke.sigma = 0.4;
  return stroke;
}

TEST(LatticeShapes, OutlinesLieWhereTheStrokeEnds)
{
  for (Tool tool : { Tool::Soft, Tool::Stamp })
  {
    const Stroke stroke = someStroke(tool);
    for (double share : { 1.0, 0.5 })
    {
      const std::vector<Polyline> outline = outlineOf(stroke, share);
      ASSERT_EQ(outline.size(), 3u);
      for (const Polyline& line : outline)
      {
        EXPECT_LT(glm::distance(line.front(), line.back()), 1e-9);
        for (const glm::dvec3& point : line)
        {
          EXPECT_NEAR(normalisedDistance(stroke, point), share, 1e-9);
        }
      }
    }
  }
}

TEST(LatticeShapes, SectionsLieInThePlaneWhereTheStrokeEnds)
{
  const glm::dvec3 axis = glm::normalize(someStroke(Tool::Stamp).axis);
  for (Tool tool : { Tool::Soft, Tool::Stamp })
  {
    for (const glm::dvec3& normal : { glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(1, -2, 3)),
           axis, glm::normalize(glm::cross(axis, glm::dvec3(0, 1, 0))) })
    {
      const Stroke stroke = someStroke(tool);
      const Polyline section = sectionOf(stroke, 0.5, normal);
      ASSERT_GT(section.size(), 30u);
      EXPECT_LT(glm::distance(section.front(), section.back()), 1e-9);
      for (const glm::dvec3& point : section)
      {
        EXPECT_NEAR(normalisedDistance(stroke, point), 0.5, 1e-9);
        EXPECT_NEAR(glm::dot(point - stroke.anchor, normal), 0.0, 1e-9);
      }
    }
  }
}

TEST(LatticeShapes, HalfWeightIsHalfOfTheMiddle)
{
  for (double sigma : { 0.05, 0.5, 2.0 })
  {
    EXPECT_NEAR(falloff(radiusOfHalfWeight(sigma), sigma), 0.5, 1e-6) << sigma;
  }
}

TEST(LatticeShapes, EdgesJoinNeighboursOnly)
{
  std::vector<ControlPoint> points(4);
  points[0].index = { 3, 3, 3 };
  points[1].index = { 4, 3, 3 };
  points[2].index = { 3, 3, 4 };
  points[3].index = { 4, 4, 4 }; // beside none of them
  const std::vector<std::pair<int, int>> expected{ { 0, 1 }, { 0, 2 } };
  EXPECT_EQ(edgesBetween(points), expected);
}

TEST(LatticeShapes, TheRepresentationHoldsWhatItWasGiven)
{
  vtkNew<vtkLatticeRepresentation> shown;
  EXPECT_EQ(shown->GetBounds(), nullptr);
  std::vector<ControlPoint> points(2);
  points[1].drawn = { 1.0, 2.0, 3.0 };
  shown->SetControlPoints(points);
  shown->SetFaint({ { 0.0, 8.0, 0.0 } });
  shown->SetHighlights({ { 5.0, 0.0, 0.0 } });
  shown->SetLines(vtkLatticeRepresentation::Mark, cross({ 0.0, 0.0, 0.0 }, 2.0));
  EXPECT_EQ(shown->GetNumberOfControlPoints(), 2);
  EXPECT_EQ(shown->GetNumberOfFaint(), 1);
  EXPECT_EQ(shown->GetNumberOfHighlights(), 1);
  EXPECT_EQ(shown->GetNumberOfLines(vtkLatticeRepresentation::Mark), 3);
  EXPECT_EQ(shown->GetNumberOfLines(vtkLatticeRepresentation::Strong), 0);
  ASSERT_NE(shown->GetBounds(), nullptr);
  EXPECT_DOUBLE_EQ(shown->GetBounds()[0], -2.0);
  EXPECT_DOUBLE_EQ(shown->GetBounds()[1], 5.0);
  EXPECT_DOUBLE_EQ(shown->GetBounds()[3], 8.0);
  shown->Clear();
  EXPECT_EQ(shown->GetBounds(), nullptr);
  EXPECT_EQ(shown->GetNumberOfControlPoints(), 0);
}

TEST(LatticeShapes, TheRepresentationMakesWhatStaysOnce)
{
  vtkNew<vtkLatticeRepresentation> shown;
  const auto size = [&] { return shown->GetBounds() ? shown->GetBounds()[1] : 0.0; };
  const auto mark = [&](const std::vector<Polyline>& lines) {
    shown->SetLines(vtkLatticeRepresentation::Mark, lines);
    return size();
  };
  const std::vector<Polyline> first = cross({ 0.0, 0.0, 0.0 }, 2.0);
  EXPECT_EQ(mark(first), 2.0);
  vtkNew<vtkPropCollection> actors;
  shown->GetActors(actors);
  const auto drawn = [&] {
    vtkMTimeType last = 0;
    for (int i = 0; i < actors->GetNumberOfItems(); ++i)
    {
      auto actor = vtkActor::SafeDownCast(actors->GetItemAsObject(i));
      last = std::max(last, actor->GetMapper()->GetInputDataObject(0, 0)->GetMTime());
    }
    return last;
  };
  const vtkMTimeType made = drawn();
  EXPECT_EQ(mark(first), 2.0);
  EXPECT_EQ(drawn(), made);
  EXPECT_EQ(mark(cross({ 0.0, 0.0, 0.0 }, 3.0)), 3.0);
  EXPECT_GT(drawn(), made);
  EXPECT_EQ(mark({}), 0.0);
  EXPECT_EQ(mark(first), 2.0);
  shown->Clear();
  EXPECT_EQ(size(), 0.0);
  EXPECT_EQ(mark(first), 2.0) << "cleared, then the same again";
}
}

TEST(LatticeShapes, AnArrowPointsToItsEndAndFacesTheView)
{
  const glm::dvec3 ahead(0.0, 0.0, -1.0);
  const std::vector<Polyline> lines = arrow({ 1.0, 2.0, 3.0 }, { 11.0, 2.0, 3.0 }, 4.0, ahead);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].front(), glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(lines[0].back(), glm::dvec3(11.0, 2.0, 3.0));
  ASSERT_EQ(lines[1].size(), 3U);
  EXPECT_EQ(lines[1][1], glm::dvec3(11.0, 2.0, 3.0));
  for (const glm::dvec3& barb : { lines[1].front(), lines[1].back() })
  {
    EXPECT_DOUBLE_EQ(barb.x, 7.0);
    EXPECT_DOUBLE_EQ(std::abs(barb.y - 2.0), 2.0);
    EXPECT_DOUBLE_EQ(barb.z, 3.0);
  }
  // A short one has a short head, and one along the view has a head, too.
  EXPECT_DOUBLE_EQ(arrow({}, { 2.0, 0.0, 0.0 }, 4.0, ahead)[1].front().x, 1.0);
  EXPECT_GT(glm::distance(arrow({}, ahead, 4.0, ahead)[1].front(), ahead), 0.5);
  EXPECT_TRUE(arrow(ahead, ahead, 4.0, ahead).empty());
}

TEST(LatticeShapes, ARingFacesTheView)
{
  const glm::dvec3 centre(1.0, 2.0, 3.0);
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(1.0, 2.0, -3.0));
  for (const glm::dvec3& point : ring(centre, 5.0, ahead))
  {
    EXPECT_NEAR(glm::distance(point, centre), 5.0, 1e-12);
    EXPECT_NEAR(glm::dot(point - centre, ahead), 0.0, 1e-12);
  }
}
