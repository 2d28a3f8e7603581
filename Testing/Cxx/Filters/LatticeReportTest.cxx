// SPDX-License-Identifier: BSD-3-Clause
// Proves that a client learns of a filter's lattice and its control points through the report.
#include "vtkFreeFormDeformation.h"
#include "vtkLatticeReport.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

TEST(LatticeReport, NamesTheControlPointsThatTheFilterAttached)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(10, 10, 10);
  image->SetSpacing(2.0, 2.0, 2.0);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  vtkNew<vtkFreeFormDeformation> filter;
  filter->SetInputData(image);
  filter->SetGuardFolding(false); // the stroke as it is
  filter->SetLatticeDimensions(4, 4, 4);
  filter->SetStrokeNumbers({ 0, 6, 6, 6, 1, 2, 3, 0, 0, 0, 0, 0, 0.5, 1 });
  vtkNew<vtkLatticeReport> report;
  EXPECT_EQ(report->GetGeometry()->GetNumberOfValues(), 0); // nothing to ask yet
  report->SetFilter(filter);
  report->SetBall(6.0, 6.0, 6.0, 0.0);
  report->SetMovedWithin(5.0);
  EXPECT_EQ(report->GetControlPoints()->GetNumberOfValues(), 0); // not executed yet
  filter->Update();
  vtkDoubleArray* points = report->GetControlPoints();
  ASSERT_EQ(points->GetNumberOfTuples(), 1);
  const std::vector<double> expected{ 1, 1, 1, 6, 6, 6, 7, 8, 9 };
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(points->GetComponent(0, i), expected[i], 1e-5) << i;
  }
  const double beside[7] = { 0.0, 0.0, 12.5, 0.0, 0.0, 1.0, 3.0 };
  report->SetSlab(beside);
  EXPECT_EQ(report->GetControlPoints()->GetNumberOfTuples(), 0);
  vtkDoubleArray* geometry = report->GetGeometry();
  ASSERT_EQ(geometry->GetNumberOfValues(), 18);
  const std::vector<double> lattice{ 4, 4, 4, 0, 0, 0, 6, 6, 6, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
  for (int i = 0; i < 18; ++i)
  {
    EXPECT_DOUBLE_EQ(geometry->GetValue(i), lattice[i]) << i;
  }
}

TEST(LatticeReport, FindsTheSameTissueInBothFrames)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(10, 10, 10);
  image->SetSpacing(2.0, 2.0, 2.0);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  vtkNew<vtkFreeFormDeformation> filter;
  filter->SetInputData(image);
  filter->SetLatticeDimensions(4, 4, 4);
  filter->SetStrokeNumbers({ 0, 6, 6, 6, 1, 2, 0.5, 0, 0, 0, 0, 0, 0.5, 1 });
  vtkNew<vtkLatticeReport> report;
  report->SetFilter(filter);
  report->AddPlace(6.0, 6.0, 6.0);
  report->AddPlace(7.0, 5.0, 8.0);
  report->SetToRest(false);
  EXPECT_EQ(report->GetSameTissue()->GetNumberOfValues(), 0); // not executed yet
  filter->Update();
  const std::vector<double> expected{ 7.0, 8.0, 6.5 };
  vtkDoubleArray* drawn = report->GetSameTissue();
  ASSERT_EQ(drawn->GetNumberOfValues(), 6);
  std::vector<double> places;
  for (int i = 0; i < 6; ++i)
  {
    places.push_back(drawn->GetValue(i));
    EXPECT_TRUE(i >= 3 || std::abs(places[i] - expected[i]) < 1e-5) << i << ": " << places[i];
  }
  report->ClearPlaces();
  report->AddPlace(places[3], places[4], places[5]);
  report->SetToRest(true);
  vtkDoubleArray* rest = report->GetSameTissue();
  ASSERT_EQ(rest->GetNumberOfValues(), 3);
  EXPECT_NEAR(rest->GetValue(0), 7.0, 1e-3);
  EXPECT_NEAR(rest->GetValue(1), 5.0, 1e-3);
  EXPECT_NEAR(rest->GetValue(2), 8.0, 1e-3);
  filter->SetStrength(0.0); // a new result is asked anew
  filter->Update();
  EXPECT_NEAR(report->GetSameTissue()->GetValue(0), places[3], 1e-6);
}
