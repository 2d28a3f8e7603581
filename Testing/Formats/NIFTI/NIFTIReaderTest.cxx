// SPDX-License-Identifier: BSD-3-Clause
// Proves that the reader of NIfTI puts every voxel where the file's affine says, with the value
// the file says.
#include "Common/WorldAxes.h"
#include "Testing/Formats/NIFTI/NIFTITestFile.h"
#include "Testing/Formats/NIFTI/NIFTITestReading.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <type_traits>

using namespace brainshift::testing;

namespace
{
constexpr double ToleranceMm = 1e-5;

// By the image's own matrix and by GetPoint: the two have to agree.
glm::dvec3 worldOf(vtkImageData* image, vtkIdType point)
{
  int dimensions[3];
  image->GetDimensions(dimensions);
  const int index[3] = { static_cast<int>(point % dimensions[0]),
    static_cast<int>(point / dimensions[0] % dimensions[1]),
    static_cast<int>(point / dimensions[0] / dimensions[1]) };
  glm::dvec3 byMatrix;
  image->TransformIndexToPhysicalPoint(index, &byMatrix.x);
  glm::dvec3 byPoint;
  image->GetPoint(point, &byPoint.x);
  EXPECT_LT(glm::distance(byMatrix, byPoint), ToleranceMm);
  return byMatrix;
}

bool hasIdentityDirection(vtkImageData* image)
{
  const double* direction = image->GetDirectionMatrix()->GetData();
  for (int i = 0; i < 9; ++i)
  {
    if (direction[i] != (i % 4 == 0 ? 1.0 : 0.0))
    {
      return false;
    }
  }
  return true;
}

// Each voxel's value is its number in the file, so each can be asked where it came to lie.
void expectPlaced(Reading& reading, const NIFTITestFile& file, const glm::dmat4& worldFromVoxel)
{
  ASSERT_EQ(reading.errors, "");
  ASSERT_TRUE(reading.scalars());
  EXPECT_STREQ(reading.scalars()->GetName(), "Intensity");
  ASSERT_EQ(reading.image()->GetNumberOfPoints(), file.count());
  std::set<int> seen;
  for (vtkIdType point = 0; point < reading.image()->GetNumberOfPoints(); ++point)
  {
    const int number = static_cast<int>(reading.scalars()->GetTuple1(point)) - 1;
    seen.insert(number);
    const glm::dvec4 voxel(number % file.dimensions[0],
      number / file.dimensions[0] % file.dimensions[1],
      number / file.dimensions[0] / file.dimensions[1], 1.0);
    const glm::dvec3 expected(worldFromVoxel * voxel);
    ASSERT_LT(glm::distance(worldOf(reading.image(), point), expected), ToleranceMm)
      << "voxel " << number;
  }
  EXPECT_EQ(static_cast<int>(seen.size()), file.count());
  EXPECT_NEAR(reading.image()->GetDirectionMatrix()->Determinant(), 1.0, 1e-12);
}

void expectPlaced(const NIFTITestFile& file, const glm::dmat4& worldFromVoxel,
  bool identityDirection, const std::string& name)
{
  const std::string fileName = temporary(name + ".nii");
  writePlain(fileName, file.bytes());
  Reading reading(fileName);
  expectPlaced(reading, file, worldFromVoxel);
  EXPECT_EQ(hasIdentityDirection(reading.image()), identityDirection);
  EXPECT_EQ(reading.warnings.empty(), file.qformCode > 0 || file.sformCode > 0) << reading.warnings;
}

const glm::dmat4 Oblique = glm::translate(glm::dmat4(1.0), glm::dvec3(-90.5, -126.25, 72.0)) *
  glm::rotate(glm::dmat4(1.0), 0.5, glm::dvec3(1.0, -2.0, 0.5)) *
  glm::scale(glm::dmat4(1.0), glm::dvec3(0.9375, 1.25, 3.0));
}

TEST(NIFTIReader, IdentityHeaderGivesIdentityGrid)
{
  const NIFTITestFile file = withSform(glm::dmat4(1.0));
  expectPlaced(file, glm::dmat4(1.0), true, "identity");
  Reading reading(temporary("identity.nii"));
  const double* origin = reading.image()->GetOrigin();
  const double* spacing = reading.image()->GetSpacing();
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(origin[axis], 0.0);
    EXPECT_EQ(spacing[axis], 1.0);
    EXPECT_EQ(reading.image()->GetDimensions()[axis], file.dimensions[axis]);
  }
  for (int voxel = 0; voxel < file.count(); ++voxel)
  {
    EXPECT_EQ(reading.scalars()->GetTuple1(voxel), voxel + 1);
  }
}

// RAS, LPS, PIR, AIL and the 44 others; VTK's own reader reverses the slices of half of them.
TEST(NIFTIReader, AllTurnsAndFlipsOfAnSformBecomeTheIdentity)
{
  std::array<int, 3> axes{ 0, 1, 2 };
  do
  {
    for (int flips = 0; flips < 8; ++flips)
    {
      glm::dmat4 sform(0.0);
      for (int column = 0; column < 3; ++column)
      {
        sform[column][axes[column]] = (flips >> column & 1 ? -1.0 : 1.0) * (0.75 + 0.5 * column);
      }
      sform[3] = glm::dvec4(-388.25, 81.125, 405.5, 1.0);
      expectPlaced(withSform(sform), sform, true, "turned");
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
}

TEST(NIFTIReader, ObliqueRotationGoesToTheDirection)
{
  const glm::dmat4 aboutZ =
    glm::rotate(glm::dmat4(1.0), glm::radians(30.0), glm::dvec3(0.0, 0.0, 1.0));
  expectPlaced(withSform(aboutZ), aboutZ, false, "oblique-z");
  Reading reading(temporary("oblique-z.nii"));
  EXPECT_NEAR(reading.image()->GetDirectionMatrix()->GetElement(1, 0), 0.5, 1e-6);
  expectPlaced(withSform(Oblique), Oblique, false, "oblique");
}

TEST(NIFTIReader, RoundingIsNoRotationButASmallAngleIs)
{
  glm::dmat4 rounded = glm::scale(glm::dmat4(1.0), glm::dvec3(0.5, 0.75, 2.0));
  rounded[0][1] = 2e-8;
  rounded[2][0] = -9e-8;
  expectPlaced(withSform(rounded), rounded, true, "rounded");
  const glm::dmat4 small = glm::rotate(glm::dmat4(1.0), 1e-4, glm::dvec3(0.0, 0.0, 1.0));
  expectPlaced(withSform(small), small, false, "small");
}

// A sagittal scan that is also oblique: permuted, flipped and turned.
TEST(NIFTIReader, ObliqueTurnedAndFlippedStaysNearestToRas)
{
  glm::dmat4 turned = Oblique;
  turned[0] = -Oblique[2];
  turned[1] = Oblique[0];
  turned[2] = -Oblique[1];
  const NIFTITestFile file = withSform(turned);
  expectPlaced(file, turned, false, "oblique-turned");
  Reading reading(temporary("oblique-turned.nii"));
  EXPECT_EQ(reading.image()->GetDimensions()[0], file.dimensions[1]);
  EXPECT_EQ(reading.image()->GetDimensions()[1], file.dimensions[2]);
  EXPECT_EQ(reading.image()->GetDimensions()[2], file.dimensions[0]);
}

TEST(NIFTIReader, SformWinsOverQform)
{
  NIFTITestFile file = withSform(Oblique);
  file.qformCode = 1;
  file.qformOffset = glm::dvec3(1.0, 2.0, 3.0);
  const std::string fileName = temporary("both.nii");
  for (const double qfac : { 1.0, -1.0 }) // VTK's reader reverses the slices of -1
  {
    file.qfac = qfac;
    writePlain(fileName, file.bytes());
    Reading reading(fileName);
    expectPlaced(reading, file, Oblique);
  }
}

TEST(NIFTIReader, QformAlonePlacesVoxels)
{
  NIFTITestFile file;
  file.qformCode = 2;
  file.sform = Oblique; // has no code, so does not count
  file.pixelSize = { 0.5, 0.75, 2.0, 0.0 };
  file.quaternion = glm::dvec3(0.0, 0.0, std::sin(glm::radians(15.0)));
  file.qformOffset = glm::dvec3(-10.0, 20.0, 30.0);
  for (double qfac : { 1.0, -1.0, 0.0 })
  {
    file.qfac = qfac;
    const glm::dmat4 expected = glm::translate(glm::dmat4(1.0), glm::dvec3(-10.0, 20.0, 30.0)) *
      glm::rotate(glm::dmat4(1.0), glm::radians(30.0), glm::dvec3(0.0, 0.0, 1.0)) *
      glm::scale(glm::dmat4(1.0), glm::dvec3(0.5, 0.75, qfac < 0.0 ? -2.0 : 2.0));
    expectPlaced(file, expected, false, "qform");
  }
}

// float32 leaves 1 - |quaternion|^2 = 6e-8 here: taken at its word that is a turn by 0.03 degrees.
TEST(NIFTIReader, QformOfHalfATurnIsExact)
{
  NIFTITestFile file;
  file.qformCode = 1;
  file.quaternion = glm::dvec3(std::sqrt(0.5), std::sqrt(0.5), 0.0) * (1.0 - 3e-8);
  glm::dmat4 expected(0.0);
  expected[0][1] = expected[1][0] = 1.0;
  expected[2][2] = -1.0;
  expected[3][3] = 1.0;
  expectPlaced(file, expected, true, "half-turn");
}

TEST(NIFTIReader, WithoutFormsPixelSizesLieAlongRas)
{
  NIFTITestFile file;
  file.pixelSize = { 0.5, 0.75, 2.0, 0.0 };
  expectPlaced(file, glm::scale(glm::dmat4(1.0), glm::dvec3(0.5, 0.75, 2.0)), true, "no-form");
  file.pixelSize = { 0.0, -0.75, 2.0, 0.0 }; // as nifti_clib takes them: 0 is 1, signs do not count
  writePlain(temporary("odd-pixdim.nii"), file.bytes());
  Reading reading(temporary("odd-pixdim.nii"));
  expectPlaced(reading, file, glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 0.75, 2.0)));
}

TEST(NIFTIReader, MicrometresBecomeMillimetres)
{
  NIFTITestFile file = withSform(glm::scale(glm::dmat4(1.0), glm::dvec3(250.0, 500.0, 125.0)));
  file.units = 3;
  expectPlaced(
    file, glm::scale(glm::dmat4(1.0), glm::dvec3(0.25, 0.5, 0.125)), true, "micrometres");
}

TEST(NIFTIReader, ShearIsReportedAndTheCentreKept)
{
  glm::dmat4 sheared(1.0);
  sheared[1][0] = 0.1; // mm to the right for each voxel to the front
  const std::string fileName = temporary("sheared.nii");
  writePlain(fileName, withSform(sheared).bytes());
  Reading reading(fileName);
  EXPECT_NE(reading.warnings.find("0.0995037"), std::string::npos) << reading.warnings;
  EXPECT_EQ(reading.errors, "");
  const double centre[3] = { 1.5, 1.0, 2.0 };
  glm::dvec3 world;
  reading.image()->TransformContinuousIndexToPhysicalPoint(centre, &world.x);
  EXPECT_LT(glm::distance(world, glm::dvec3(1.6, 1.0, 2.0)), ToleranceMm);
  EXPECT_NEAR(reading.image()->GetDirectionMatrix()->Determinant(), 1.0, 1e-12);
}

template <typename T>
class NIFTIReaderOf : public ::testing::Test
{
};
using VoxelTypes =
  ::testing::Types<std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, float, double>;
TYPED_TEST_SUITE(NIFTIReaderOf, VoxelTypes);

TYPED_TEST(NIFTIReaderOf, KeepsTypeAndValuesInEitherByteOrderPackedOrNot)
{
  for (bool swapped : { false, true })
  {
    NIFTITestFile file = withSform(-Oblique);
    file.dataType = NIFTIType<TypeParam>;
    file.swapped = swapped;
    writePlain(temporary("type.nii"), file.template bytes<TypeParam>());
    writePacked(temporary("type.nii.gz"), file.template bytes<TypeParam>());
    for (const char* name : { "type.nii", "type.nii.gz" })
    {
      Reading reading(temporary(name));
      ASSERT_TRUE(reading.scalars()) << reading.errors;
      expectPlaced(reading, file, -Oblique);
      EXPECT_EQ(reading.image()->GetScalarSize(), static_cast<int>(sizeof(TypeParam)));
      EXPECT_EQ(reading.scalars()->GetDataType() == VTK_FLOAT, (std::is_same_v<TypeParam, float>));
    }
  }
}

TEST(NIFTIReader, SlopeAndInterceptRescaleToFloat)
{
  NIFTITestFile file = withSform(glm::dmat4(1.0));
  file.slope = 2.5;
  file.intercept = -100.0;
  writePlain(temporary("slope.nii"), file.bytes());
  Reading reading(temporary("slope.nii"));
  ASSERT_EQ(reading.errors, "");
  EXPECT_EQ(reading.image()->GetScalarType(), VTK_FLOAT);
  for (int voxel = 0; voxel < file.count(); ++voxel)
  {
    EXPECT_EQ(reading.scalars()->GetTuple1(voxel), 2.5 * (voxel + 1) - 100.0);
  }
}

TEST(NIFTIReader, NoSlopeKeepsValues)
{
  NIFTITestFile file = withSform(glm::dmat4(1.0));
  const double none[][2] = { { 0.0, 7.0 }, { std::nan(""), 7.0 }, { 1.0, 0.0 } };
  for (const auto& pair : none)
  {
    file.slope = pair[0];
    file.intercept = pair[1];
    writePlain(temporary("no-slope.nii"), file.bytes());
    Reading reading(temporary("no-slope.nii"));
    expectPlaced(reading, file, glm::dmat4(1.0));
    EXPECT_EQ(reading.image()->GetScalarType(), VTK_SHORT);
  }
}

TEST(NIFTIReader, TimeSeriesBecomesTimeSteps)
{
  NIFTITestFile file = withSform(-Oblique);
  file.dimensions = { 4, 3, 5, 3 };
  file.pixelSize[3] = 500.0;
  file.timeOffset = 1000.0;
  file.units = 2 + 16; // mm, ms
  writePacked(temporary("time.nii.gz"), file.bytes());
  Reading reading(temporary("time.nii.gz"));
  ASSERT_EQ(reading.errors, "");
  vtkInformation* information = reading.reader->GetOutputInformation(0);
  ASSERT_EQ(information->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 3);
  const double* times = information->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  file.dimensions.pop_back();
  for (int step : { 2, 0, 1 })
  {
    EXPECT_NEAR(times[step], 1.0 + 0.5 * step, 1e-12);
    reading.reader->UpdateTimeStep(times[step]);
    EXPECT_EQ(reading.image()->GetNumberOfScalarComponents(), 1);
    for (vtkIdType voxel = 0; voxel < file.count(); ++voxel)
    {
      const double value = reading.scalars()->GetTuple1(voxel);
      reading.scalars()->SetTuple1(voxel, value - step * file.count());
    }
    expectPlaced(reading, file, -Oblique);
  }
}

TEST(NIFTIReader, VectorsBecomeComponents)
{
  NIFTITestFile file = withSform(glm::dmat4(1.0));
  file.dimensions = { 4, 3, 5, 1, 3 };
  writePlain(temporary("vector.nii"), file.bytes());
  Reading reading(temporary("vector.nii"));
  ASSERT_EQ(reading.errors, "");
  ASSERT_EQ(reading.image()->GetNumberOfScalarComponents(), 3);
  EXPECT_EQ(reading.scalars()->GetComponent(7, 0), 8.0);
  EXPECT_EQ(reading.scalars()->GetComponent(7, 2), 8.0 + 2 * 60);
}

// What each rank of a parallel server asks for.
TEST(NIFTIReader, PiecesAreParts)
{
  const NIFTITestFile file = withSform(-Oblique);
  writePlain(temporary("pieces.nii"), file.bytes());
  Reading whole(temporary("pieces.nii"));
  vtkIdType cells = 0;
  for (int piece = 0; piece < 2; ++piece)
  {
    NIFTI reader;
    reader->SetFileName(temporary("pieces.nii").c_str());
    reader->UpdatePiece(piece, 2, 0);
    vtkImageData* part = reader->GetOutput();
    cells += part->GetNumberOfCells();
    ASSERT_LT(part->GetNumberOfPoints(), whole.image()->GetNumberOfPoints());
    for (vtkIdType point = 0; point < part->GetNumberOfPoints(); ++point)
    {
      const vtkIdType same = whole.image()->FindPoint(part->GetPoint(point));
      EXPECT_EQ(
        part->GetPointData()->GetScalars()->GetTuple1(point), whole.scalars()->GetTuple1(same));
    }
  }
  EXPECT_EQ(cells, whole.image()->GetNumberOfCells());
}

TEST(NIFTIReader, PairsAndSlicesLoad)
{
  NIFTITestFile file = withSform(Oblique);
  file.magic = "ni1";
  file.voxelOffset = 0.0;
  writePlain(temporary("pair.hdr"), file.header());
  writePlain(temporary("pair.img"), file.voxels<std::int16_t>());
  writePlain(temporary("packed.hdr"), file.header());
  writePacked(temporary("packed.img.gz"), file.voxels<std::int16_t>());
  for (const char* name : { "pair.hdr", "pair.img", "packed.hdr", "packed.img.gz" })
  {
    Reading reading(temporary(name));
    expectPlaced(reading, file, Oblique);
  }
  NIFTITestFile slice = withSform(glm::dmat4(1.0));
  slice.dimensions = { 4, 3 };
  writePlain(temporary("slice.nii"), slice.bytes());
  Reading reading(temporary("slice.nii"));
  expectPlaced(reading, slice, glm::dmat4(1.0));
}

TEST(NIFTIReader, SecondVersionLoads)
{
  const NIFTITestFile file;
  std::vector<char> bytes(544, 0);
  file.put<std::int32_t>(bytes, 0, 540);
  const char magic[] = { 'n', '+', '2', 0, '\r', '\n', '\032', '\n' };
  std::copy_n(magic, 8, bytes.begin() + 4);
  file.put<std::int16_t>(bytes, 12, NIFTIType<std::int16_t>);
  for (std::size_t i = 0; i < 8; ++i)
  {
    file.put<std::int64_t>(bytes, 16 + 8 * i, i == 0 ? 3 : (i < 4 ? file.dimensions[i - 1] : 1));
    file.put<double>(bytes, 104 + 8 * i, 1.0);
  }
  file.put<std::int64_t>(bytes, 168, 544);
  file.put<std::int32_t>(bytes, 348, 1); // sform_code
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 4; ++column)
    {
      file.put<double>(bytes, 400 + 32 * row + 8 * column, Oblique[column][row]);
    }
  }
  const std::vector<char> voxels = file.voxels<std::int16_t>();
  bytes.insert(bytes.end(), voxels.begin(), voxels.end());
  writePlain(temporary("second.nii"), bytes);
  Reading reading(temporary("second.nii"));
  expectPlaced(reading, file, Oblique);
}

// Numbers read from the file by other means.
TEST(NIFTIReader, RealHeadLiesWhereItsHeaderSays)
{
  Reading head(BRAINSHIFT_TEST_DATA "/seg3d-utah/seg3d_mr_t1.nii.gz");
  Reading mask(BRAINSHIFT_TEST_DATA "/seg3d-utah/seg3d_brainmask.nii.gz");
  ASSERT_EQ(head.errors + mask.errors, "");
  EXPECT_TRUE(hasIdentityDirection(head.image()));
  EXPECT_EQ(head.image()->GetScalarType(), VTK_FLOAT);
  EXPECT_EQ(mask.image()->GetScalarType(), VTK_UNSIGNED_CHAR);
  const int dimensions[3] = { 160, 232, 160 };
  const double bounds[6] = { -388.260009765625, -229.260009765625, -81.11995697021484,
    126.41899538040161, 405.4209899902344, 548.2724766731262 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(head.image()->GetDimensions()[i / 2], dimensions[i / 2]);
    EXPECT_NEAR(head.image()->GetBounds()[i], bounds[i], ToleranceMm);
    EXPECT_NEAR(mask.image()->GetBounds()[i], bounds[i], ToleranceMm);
  }
  EXPECT_NEAR(head.scalars()->GetRange()[0], 0.0, 0.0);
  EXPECT_NEAR(head.scalars()->GetRange()[1], 512.00003, 1e-4);
  double inBrain[3] = { -278.26, 53.646, 486.28 };
  const vtkIdType brain = head.image()->FindPoint(inBrain);
  EXPECT_NEAR(head.scalars()->GetTuple1(brain), 148.5804, 1e-4);
  EXPECT_EQ(mask.scalars()->GetTuple1(brain), 1.0);
  EXPECT_EQ(mask.scalars()->GetTuple1(0), 0.0);
  vtkIdType brainVoxels = 0;
  for (vtkIdType point = 0; point < mask.image()->GetNumberOfPoints(); ++point)
  {
    brainVoxels += mask.scalars()->GetTuple1(point) == 1.0 ? 1 : 0;
  }
  EXPECT_EQ(brainVoxels, 1822964);
}

TEST(NIFTIReader, NamesTheSidesOnlyIfTheFileDoes)
{
  const std::vector<std::pair<int, int>> codes{ { 0, 0 }, { 1, 0 }, { 0, 2 } };
  for (const auto& [sformCode, qformCode] : codes)
  {
    NIFTITestFile file;
    file.sformCode = sformCode;
    file.qformCode = qformCode;
    writePlain(temporary("sides.nii"), file.bytes());
    Reading reading(temporary("sides.nii"));
    const bool named = brainshift::worldAxesOf(reading.image()) == brainshift::WorldAxes::RAS;
    EXPECT_EQ(named, sformCode + qformCode > 0) << sformCode << ' ' << qformCode;
    const bool isSaid =
      reading.warnings.find("does not say where the sides of the patient are") != std::string::npos;
    EXPECT_NE(isSaid, named) << reading.warnings;
  }
}
