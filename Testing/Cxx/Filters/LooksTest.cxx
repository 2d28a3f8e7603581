// SPDX-License-Identifier: BSD-3-Clause
// Proves that volumes of each kind are told apart, and that their looks leave the background out
// and show the tissue. The volumes are made here, with noise, and share no number with the looks.
#include "Filters/Attached/Segmentation.h"
#include "Filters/Looks/Look.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkVolumeLookReport.h"

#include <vtkCellData.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkTrivialProducer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int Side = 60;
const ArrayChoice Values{ vtkDataObject::POINT, "Intensity" };

Grid headGrid()
{
  Grid grid = plainGrid(glm::ivec3(Side), glm::dvec3(3.0));
  grid.origin = { -40.0, 10.0, -90.0 };
  return grid;
}

glm::ivec3 indexOf(vtkIdType voxel)
{
  const int number = static_cast<int>(voxel);
  return { number % Side, number / Side % Side, number / Side / Side };
}

// Smallest and largest x, y, z of points that stand one after another.
std::pair<glm::dvec3, glm::dvec3> boxOf(vtkDoubleArray* points)
{
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  for (vtkIdType i = 0; i + 2 < points->GetNumberOfValues(); i += 3)
  {
    const glm::dvec3 point(points->GetValue(i), points->GetValue(i + 1), points->GetValue(i + 2));
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  return { low, high };
}

// How far from the middle of a square view its farthest tissue is seen: 1 is the view's edge.
double farthestSeen(const double* camera, double angle, const std::vector<glm::dvec3>& tissue)
{
  const glm::dvec3 position(camera[0], camera[1], camera[2]);
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(camera[3], camera[4], camera[5]) - position);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 up = glm::cross(right, ahead);
  const double edge = std::tan(0.5 * angle * std::acos(-1.0) / 180.0);
  double farthest = 0.0;
  for (const glm::dvec3& point : tissue)
  {
    const glm::dvec3 seen = point - position;
    const double across = std::max(std::abs(glm::dot(seen, right)), std::abs(glm::dot(seen, up)));
    farthest = std::max(farthest, across / glm::dot(seen, ahead) / edge);
  }
  return farthest;
}

// A ball of skin (outside), bone and brain in the middle. `outside`: voxels from the edge.
enum class Tissue
{
  Air,
  Skin,
  Bone,
  Brain
};

Tissue tissueAt(vtkIdType voxel)
{
  const double radius = glm::length(glm::dvec3(indexOf(voxel)) - 0.5 * (Side - 1));
  return radius > 26.0 ? Tissue::Air
    : radius > 22.0    ? Tissue::Skin
    : radius > 19.0    ? Tissue::Bone
                       : Tissue::Brain;
}

using TissueValues = std::array<double, 4>; // air, skin, bone, brain

vtkSmartPointer<vtkImageData> headOf(const TissueValues& means, double noise, double lowest)
{
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, noise);
  return volumeOn(headGrid(), VTK_FLOAT, [&](vtkIdType voxel) {
    return std::max(means[static_cast<int>(tissueAt(voxel))] + normal(random), lowest);
  });
}

vtkSmartPointer<vtkImageData> ctHead()
{
  return headOf({ -1000.0, 20.0, 900.0, 35.0 }, 15.0, -1024.0);
}

// Echoes in a cone; nothing outside it.
vtkSmartPointer<vtkImageData> fan()
{
  std::mt19937 random(5);
  std::exponential_distribution<double> echo(1.0 / 30.0);
  return volumeOn(headGrid(), VTK_UNSIGNED_CHAR, [&](vtkIdType voxel) {
    const glm::dvec3 at = glm::dvec3(indexOf(voxel)) + glm::dvec3(-30.0, -30.0, 5.0);
    const bool inside = std::hypot(at.x, at.y) < 0.6 * at.z;
    return inside ? std::min(1.0 + echo(random), 255.0) : 0.0;
  });
}

double opacityAt(const Look& look, double value)
{
  double opacity = look.opacities.front()[1];
  for (std::size_t i = 1; i < look.opacities.size(); ++i)
  {
    const auto& low = look.opacities[i - 1];
    const auto& high = look.opacities[i];
    if (value >= low[0])
    {
      const double within = std::min((value - low[0]) / (high[0] - low[0]), 1.0);
      opacity = low[1] + within * (high[1] - low[1]);
    }
  }
  return opacity;
}

// Each look rises, lies within 0 and 1, and reaches over all values.
void expectDrawable(const Look& look, const Intensities& values, const std::string& name)
{
  ASSERT_GE(look.colors.size(), 2u) << name;
  ASSERT_GE(look.opacities.size(), 2u) << name;
  EXPECT_EQ(look.colors.front()[0], values.lowest) << name;
  EXPECT_GE(look.colors.back()[0], values.highest) << name;
  EXPECT_EQ(look.opacities.front()[0], values.lowest) << name;
  EXPECT_GE(look.opacities.back()[0], values.highest) << name;
  for (std::size_t i = 1; i < look.colors.size(); ++i)
  {
    EXPECT_GT(look.colors[i][0], look.colors[i - 1][0]) << name;
  }
  for (std::size_t i = 0; i < look.opacities.size(); ++i)
  {
    EXPECT_TRUE(i == 0 || look.opacities[i][0] > look.opacities[i - 1][0]) << name;
    EXPECT_TRUE(look.opacities[i][1] >= 0.0 && look.opacities[i][1] <= 1.0) << name;
  }
}

void expectAllDrawable(vtkImageData* volume)
{
  const Intensities values = readIntensities(volume, Values);
  for (const std::string& name : looksOf(values))
  {
    expectDrawable(makeLook(name, values), values, name);
  }
}

void attachBrain(vtkImageData* volume)
{
  Segmentation segmentation;
  segmentation.grid = headGrid();
  segmentation.labels = arrayOf(VTK_UNSIGNED_CHAR, SegmentationName, Side * Side * Side,
    [](vtkIdType voxel) { return tissueAt(voxel) == Tissue::Brain ? 1.0 : 0.0; });
  attachSegmentation(volume, segmentation);
}
}

TEST(Looks, FindMRAndItsSkinWhateverItsUnits)
{
  for (const double unit : { 0.001, 1.0, 40.0 })
  {
    const TissueValues means{ 4.0 * unit, 70.0 * unit, 25.0 * unit, 110.0 * unit };
    auto head = headOf(means, 4.0 * unit, 0.0);
    const Intensities values = readIntensities(head, Values);
    EXPECT_EQ(kindOf(values), VolumeKind::MR) << unit;
    EXPECT_EQ(looksOf(values), (std::vector<std::string>{ "Skin", "See-through" })) << unit;
    const Look skin = makeLook("Skin", values);
    EXPECT_EQ(opacityAt(skin, 12.0 * unit), 0.0) << "air with three times its noise, " << unit;
    EXPECT_EQ(opacityAt(skin, 62.0 * unit), 1.0) << "skin, less its noise, " << unit;
    expectAllDrawable(head);
  }
}

// Magnitudes with noise in both of their parts: a Rayleigh distribution in air.
TEST(Looks, AreAboveTheNoiseOfAir)
{
  const auto head = [](double noise) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0.0, noise);
    constexpr std::array<double, 4> Means{ 0.0, 200.0, 60.0, 150.0 };
    return volumeOn(headGrid(), VTK_FLOAT, [&](vtkIdType voxel) {
      const double real = Means[static_cast<int>(tissueAt(voxel))] + normal(random);
      return std::hypot(real, normal(random));
    });
  };
  const auto opacity = [&](const char* look, double noise, double value) {
    return opacityAt(makeLook(look, readIntensities(head(noise), Values)), value);
  };
  for (const double noise : { 12.0, 23.0 })
  {
    EXPECT_EQ(opacity("Skin", noise, 3.4 * noise), 0.0) << noise;
    EXPECT_EQ(opacity("See-through", noise, 3.4 * noise), 0.0) << noise;
    EXPECT_EQ(opacity("Skin", noise, 170.0), 1.0) << noise;
  }
  EXPECT_GT(opacity("Skin", 2.0, 70.0), 0.0) << "little noise changes nothing";
}

TEST(Looks, FindCTByItsAir)
{
  const Intensities values = readIntensities(ctHead(), Values);
  EXPECT_EQ(kindOf(values), VolumeKind::CT);
  EXPECT_EQ(looksOf(values), (std::vector<std::string>{ "Bone", "Brain", "Skin", "Vessels" }));
  const Look bone = makeLook("Bone", values);
  EXPECT_EQ(opacityAt(bone, 60.0), 0.0);
  EXPECT_EQ(opacityAt(bone, 900.0), 1.0);
  const Look skin = makeLook("Skin", values);
  EXPECT_EQ(opacityAt(skin, -950.0), 0.0);
  EXPECT_EQ(opacityAt(skin, 20.0), 1.0);
  const Look brain = makeLook("Brain", values);
  EXPECT_EQ(opacityAt(brain, 35.0), 1.0);
  EXPECT_EQ(opacityAt(brain, 900.0), 0.0);
  expectAllDrawable(ctHead());
}

TEST(Looks, FindUltrasoundByItsFan)
{
  const Intensities values = readIntensities(fan(), Values);
  EXPECT_EQ(kindOf(values), VolumeKind::Ultrasound);
  const Look look = makeLook(looksOf(values).front(), values);
  EXPECT_EQ(opacityAt(look, 0.0), 0.0) << "outside the fan";
  EXPECT_GT(opacityAt(look, 120.0), 0.5);
  expectAllDrawable(fan());
}

TEST(Looks, OfABrainNeedASegmentationOutsideCT)
{
  auto head = headOf({ 4.0, 70.0, 25.0, 110.0 }, 4.0, 0.0);
  EXPECT_TRUE(makeLook("Brain", readIntensities(head, Values)).colors.empty());
  attachBrain(head);
  const Intensities values = readIntensities(head, Values);
  const Look brain = makeLook("Brain", values);
  EXPECT_TRUE(brain.drawsSegment);
  EXPECT_LT(opacityAt(brain, 100.0), 0.2) << "the darkest within the segmentation";
  EXPECT_EQ(opacityAt(brain, 112.0), 1.0);
  expectDrawable(brain, values, "Brain");
}

TEST(Looks, AreNoneForLabelsAndForNothing)
{
  auto labels = volumeOn(headGrid(), VTK_DOUBLE,
    [](vtkIdType voxel) { return 3.0 * static_cast<int>(tissueAt(voxel)); });
  EXPECT_EQ(kindOf(readIntensities(labels, Values)), VolumeKind::Labels);
  EXPECT_TRUE(looksOf(readIntensities(labels, Values)).empty());
  EXPECT_TRUE(looksOf(readIntensities(labels, { vtkDataObject::POINT, "Other" })).empty());
  EXPECT_TRUE(looksOf(readIntensities(nullptr, Values)).empty());
  auto nowhere = volumeOn(
    headGrid(), VTK_FLOAT, [](vtkIdType) { return std::numeric_limits<double>::quiet_NaN(); });
  EXPECT_TRUE(looksOf(readIntensities(nowhere, Values)).empty());
}

TEST(Looks, AConstantVolumeIsNoLabelMap)
{
  for (const double constant : { -1000.0, 0.0, 7.0, 2.5e30 })
  {
    vtkNew<vtkTrivialProducer> source;
    source->SetOutput(volumeOn(headGrid(), VTK_DOUBLE, [constant](vtkIdType) { return constant; }));
    vtkNew<vtkVolumeLookReport> report;
    report->SetSource(source);
    report->SetArrayName("Intensity");
    report->Measure();
    EXPECT_STREQ(report->GetKind(), "") << constant;
    EXPECT_STREQ(report->GetNames(), "") << constant;
    EXPECT_EQ(report->GetColors()->GetNumberOfValues(), 0) << constant;
  }
}

TEST(Looks, OutliersDoNotMoveThem)
{
  auto head = headOf({ 4.0, 70.0, 25.0, 110.0 }, 4.0, 0.0);
  const Look before = makeLook("Skin", readIntensities(head, Values));
  vtkDataArray* scalars = head->GetPointData()->GetScalars();
  scalars->SetTuple1(5, std::numeric_limits<double>::infinity());
  scalars->SetTuple1(6, std::numeric_limits<double>::quiet_NaN());
  scalars->SetTuple1(7, 3e4);
  const Look after = makeLook("Skin", readIntensities(head, Values));
  EXPECT_NEAR(after.tissue, before.tissue, 0.1 * before.tissue);
}

TEST(Looks, KnowHowFarTheirTissueReaches)
{
  auto head = headOf({ 4.0, 70.0, 25.0, 110.0 }, 4.0, 0.0);
  attachBrain(head);
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(head);
  vtkNew<vtkVolumeLookReport> report;
  report->SetSource(source);
  report->SetArrayName("Intensity");
  for (const auto& [look, radius] : { std::pair("Skin", 26.0), std::pair("Brain", 19.0) })
  {
    report->SetLook(look);
    report->Measure();
    const glm::dvec3 middle = headGrid().worldFromGrid(glm::dvec3(0.5 * (Side - 1)));
    const auto [low, high] = boxOf(report->GetTissuePoints());
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(low[axis], middle[axis] - 3.0 * radius, 4.0) << look;
      EXPECT_NEAR(high[axis], middle[axis] + 3.0 * radius, 4.0) << look;
    }
  }
  EXPECT_STREQ(report->GetKind(), "MR");
  EXPECT_STREQ(report->GetNames(), "Skin\nBrain\nSee-through");
  report->SetLook("Bone");
  report->Measure();
  EXPECT_EQ(report->GetColors()->GetNumberOfValues(), 0);
  report->SetSource(nullptr);
  report->Measure();
  EXPECT_STREQ(report->GetKind(), "");
}

TEST(Looks, ACameraLetsTheirTissueFillTheView)
{
  auto head = headOf({ 4.0, 70.0, 25.0, 110.0 }, 4.0, 0.0);
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(head);
  vtkNew<vtkVolumeLookReport> report;
  EXPECT_EQ(report->GetCamera()->GetNumberOfValues(), 0) << "nothing was measured";
  report->SetSource(source);
  report->SetArrayName("Intensity");
  report->Measure();
  const auto [low, high] = boxOf(report->GetTissuePoints());
  const glm::dvec3 middle = 0.5 * (low + high);
  const double radius = 0.5 * (high.x - low.x);
  for (const auto& [aspect, angle] : { std::pair(2.0, 30.0), std::pair(0.5, 50.0) })
  {
    report->SetViewAspect(aspect);
    report->SetViewAngle(angle);
    vtkDoubleArray* camera = report->GetCamera();
    ASSERT_EQ(camera->GetNumberOfValues(), 10);
    const double* numbers = camera->GetPointer(0);
    const glm::dvec3 position(numbers[0], numbers[1], numbers[2]);
    const glm::dvec3 away = position - middle;
    EXPECT_LT(glm::distance(glm::dvec3(numbers[3], numbers[4], numbers[5]), middle), 3.0);
    EXPECT_EQ(glm::dvec3(numbers[6], numbers[7], numbers[8]), glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_TRUE(away.x > 0.0 && away.y > 0.0 && away.z > 0.0) << "right, front and above";
    // The ball's outline reaches 92 % of the way to the nearer edges.
    const double edge = std::tan(0.5 * angle * std::acos(-1.0) / 180.0) * std::min(aspect, 1.0);
    const double outline = std::tan(std::asin(radius / glm::length(away)));
    EXPECT_NEAR(outline / edge, 0.92, 0.03) << aspect;
    EXPECT_GT(numbers[9] * std::min(aspect, 1.0), radius);
    EXPECT_LT(numbers[9] * std::min(aspect, 1.0), radius / 0.7);
  }
}

TEST(Looks, ACameraSeesANeckAndIgnoresNoise)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, 4.0);
  std::vector<glm::dvec3> tissue;
  auto head = volumeOn(headGrid(), VTK_FLOAT, [&](vtkIdType voxel) {
    const glm::ivec3 index = indexOf(voxel);
    const bool neck =
      index.z < 20 && glm::distance(glm::dvec2(index), glm::dvec2(40.0, 40.0)) < 9.0;
    if (neck || glm::distance(glm::dvec3(index), glm::dvec3(30.0, 30.0, 36.0)) < 20.0)
    {
      tissue.push_back(headGrid().worldFromGrid(glm::dvec3(index)));
      return 100.0 + chance(random);
    }
    const bool isBright = chance(random) < 2e-4; // a few voxels of the air
    return isBright ? 150.0 : std::max(4.0 + normal(random), 0.0);
  });
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(head);
  vtkNew<vtkVolumeLookReport> report;
  report->SetSource(source);
  report->SetArrayName("Intensity");
  report->SetViewAngle(30.0);
  report->Measure();
  ASSERT_EQ(report->GetCamera()->GetNumberOfValues(), 10);
  EXPECT_NEAR(farthestSeen(report->GetCamera()->GetPointer(0), 30.0, tissue), 0.92, 0.03);
}

TEST(Looks, AReportFindsTheWindowOfTissue)
{
  auto head = headOf({ 4.0, 70.0, 25.0, 110.0 }, 4.0, 0.0);
  vtkNew<vtkTrivialProducer> source;
  source->SetOutput(head);
  vtkNew<vtkVolumeLookReport> report;
  report->SetSource(source);
  report->SetArrayName("Intensity");
  const int before = vtkVolumeLookReport::GetReadings();
  report->MeasureWindow();
  EXPECT_EQ(vtkVolumeLookReport::GetReadings(), before + 1);
  ASSERT_EQ(report->GetWindow()->GetNumberOfValues(), 2);
  const double low = report->GetWindow()->GetValue(0);
  const double high = report->GetWindow()->GetValue(1);
  EXPECT_GT(low, 8.0) << "above the air, which is 4";
  EXPECT_NEAR(high, 110.0, 15.0);
  report->SetPercentiles(40.0, 60.0);
  report->MeasureWindow();
  EXPECT_GT(report->GetWindow()->GetValue(0), low);
  EXPECT_LT(report->GetWindow()->GetValue(1), high);
  report->SetArrayName("Nothing");
  report->MeasureWindow();
  EXPECT_EQ(report->GetWindow()->GetNumberOfValues(), 0);
}

TEST(Looks, AreTheSameForCells)
{
  auto head = headOf({ 4.0, 70.0, 25.0, 110.0 }, 4.0, 0.0);
  auto cells = imageOn(plainGrid(glm::ivec3(Side + 1), glm::dvec3(3.0)));
  cells->GetCellData()->SetScalars(head->GetPointData()->GetScalars());
  const Look ofPoints = makeLook("Skin", readIntensities(head, Values));
  const Look ofCells =
    makeLook("Skin", readIntensities(cells, { vtkDataObject::CELL, "Intensity" }));
  EXPECT_EQ(ofPoints.opacities, ofCells.opacities);
}

TEST(Histogram, FindsPercentilesAndTheThresholdBetweenTwoPeaks)
{
  Histogram histogram = makeHistogram(0.0, 10.0, 100);
  for (int i = 0; i < 1000; ++i)
  {
    histogram.add(i * 0.01);
  }
  EXPECT_NEAR(percentile(histogram, 0.25), 2.5, 0.02);
  EXPECT_NEAR(percentile(histogram, 1.0), 10.0, 0.02);
  Histogram peaks = makeHistogram(0.0, 10.0, 100);
  for (int i = -50; i <= 50; ++i)
  {
    peaks.add(2.0 + 0.01 * i);
    peaks.add(7.0 + 0.01 * i);
  }
  EXPECT_GE(otsuThreshold(peaks), 2.5);
  EXPECT_LE(otsuThreshold(peaks), 6.6);
}

// Only what is dark and commonest is background; a bright peak that is commonest is tissue.
TEST(Histogram, LosesADarkBackgroundOnly)
{
  for (const bool isDarkCommonest : { true, false })
  {
    Histogram peaks = makeHistogram(0.0, 10.0, 100);
    for (int i = 0; i < 100; ++i)
    {
      peaks.add(isDarkCommonest || i % 4 == 0 ? 1.05 : 8.05);
      peaks.add(8.05);
      peaks.add(1.05 + 0.0001 * i);
    }
    const double before = peaks.total();
    const Histogram tissue = withoutBackground(peaks);
    EXPECT_EQ(tissue.total(), isDarkCommonest ? 100.0 : before) << isDarkCommonest;
  }
}
