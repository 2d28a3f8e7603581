// SPDX-License-Identifier: BSD-3-Clause
// Proves that FreeSurfer volumes are read in every type, packed or not, with frames as time steps,
// and that damaged headers are named. Python.VolumeFormats proves where voxels lie.
#include "Common/WorldAxes.h"
#include "Testing/Formats/Volumes/VolumeFormatTesting.h"

#include <vtk_zlib.h>

#include <vtkInformation.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <array>
#include <cstdint>
#include <cstring>

using namespace brainshift::testing;

namespace
{

template <typename T>
std::string bigEndian(T number)
{
  std::string raw(sizeof(T), '\0');
  std::memcpy(&raw[0], &number, sizeof(T));
  const std::uint16_t one = 1;
  const bool machineIsBig = *reinterpret_cast<const char*>(&one) == 0;
  return machineIsBig ? raw : std::string(raw.rbegin(), raw.rend());
}

struct MGHTestFile
{
  std::array<std::int32_t, 7> numbers{ 1, 2, 3, 2, 1, 0, 0 }; // version, sides, frames, type, dof
  std::int16_t goodRAS = 1;
  std::array<float, 15> place{ 1, 2, 3, 1, 0, 0, 0, 1, 0, 0, 0, 1, 10, 20, 30 };
  float repetitionMs = 2500.0F;

  int count() const { return this->numbers[1] * this->numbers[2] * this->numbers[3]; }

  template <typename T = std::uint8_t>
  std::string bytes() const
  {
    std::string all;
    for (const std::int32_t number : this->numbers)
    {
      all += bigEndian(number);
    }
    all += bigEndian(this->goodRAS);
    for (const float number : this->place)
    {
      all += bigEndian(number);
    }
    all.resize(284, '\0');
    for (int i = 1; i <= this->count() * this->numbers[4]; ++i)
    {
      all += bigEndian(static_cast<T>(i));
    }
    return all + bigEndian(this->repetitionMs);
  }
};

template <typename T>
void expectType(int type)
{
  MGHTestFile file;
  file.numbers[5] = type;
  writeFile("type.mgh", file.bytes<T>());
  FormatReading<MGH> reading("type.mgh");
  EXPECT_EQ(reading.said(), "");
  const std::vector<double> values = reading.values();
  ASSERT_EQ(values.size(), 12u);
  for (int i = 0; i < 12; ++i)
  {
    EXPECT_EQ(values[i], i + 1) << "type " << type;
  }
}
}

TEST(MGHVolume, AllTypes)
{
  expectType<std::uint8_t>(0);
  expectType<std::int32_t>(1);
  expectType<float>(3);
  expectType<std::int16_t>(4);
  expectType<std::uint16_t>(10);
}

TEST(MGHVolume, FramesAreTimeSteps)
{
  MGHTestFile file;
  file.numbers[4] = 3;
  const std::string bytes = file.bytes();
  writeFile("frames.mgh", bytes);
  gzFile packed = gzopen(scratchFile("frames.mgz").c_str(), "wb");
  gzwrite(packed, bytes.data(), static_cast<unsigned int>(bytes.size()));
  gzclose(packed);
  for (const char* name : { "frames.mgh", "frames.mgz" })
  {
    FormatReading<MGH> reading(name);
    EXPECT_EQ(reading.said(), "");
    vtkInformation* output = reading.reader->GetOutputInformation(0);
    ASSERT_EQ(output->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 3);
    EXPECT_DOUBLE_EQ(output->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS())[2], 5.0);
    for (const int frame : { 2, 0, 1 })
    {
      reading.reader->UpdateTimeStep(2.5 * frame);
      EXPECT_EQ(reading.values().at(11), 12 * frame + 12) << name;
    }
  }
}

TEST(MGHVolume, WithoutGoodRASTheSidesAreNotKnown)
{
  MGHTestFile file;
  file.goodRAS = 0;
  writeFile("bad.mgh", file.bytes());
  FormatReading<MGH> reading("bad.mgh");
  EXPECT_NE(reading.said().find("goodRASFlag is 0"), std::string::npos);
  EXPECT_EQ(brainshift::worldAxesOf(reading.image()), brainshift::WorldAxes::Unknown);
  // Coronal: the second axis of the file, 3 voxels, leads down.
  EXPECT_EQ(reading.image()->GetDimensions()[2], 3);
  EXPECT_EQ(reading.values().size(), 12u);
  file.goodRAS = 1;
  writeFile("good.mgh", file.bytes());
  FormatReading<MGH> good("good.mgh");
  EXPECT_EQ(brainshift::worldAxesOf(good.image()), brainshift::WorldAxes::RAS);
  EXPECT_EQ(good.image()->GetOrigin()[0], 9.0); // half of 2 voxels before the centre
}

TEST(MGHVolume, DirectionsThatScaleTheSpacing)
{
  MGHTestFile file;
  file.place[7] = 0.9F; // of the second axis, which has 2 mm
  writeFile("scaled.mgh", file.bytes());
  FormatReading<MGH> reading("scaled.mgh");
  EXPECT_NE(
    reading.said().find("directions of its axes with the lengths 1, 0.9 and 1, which should be 1"),
    std::string::npos)
    << reading.said();
  EXPECT_NEAR(reading.image()->GetSpacing()[1], 1.8, 1e-6);
}

TEST(MGHVolume, HeadersThatCannotBe)
{
  expectRefused<MGH>("no.mgh", std::string(100, 'x'), "has no whole header, which has 284 bytes");
  expectRefused<MGH>("missing.mgh", "does not exist");
  const auto refused = [](std::size_t which, std::int32_t number, const std::string& words) {
    std::string bytes = MGHTestFile().bytes();
    bytes.replace(4 * which, 4, bigEndian(number));
    expectRefused<MGH>("no.mgh", bytes, words);
  };
  refused(0, 2, "has the version 2; it must have 1");
  refused(1, 0, "has 0 voxels along axis 0");
  refused(2, 2000000000, "where the header announces 8000000000");
  refused(4, -1, "has -1 frames; it must have 1 or more, up to 65536");
  refused(4, 99999, "has 99999 frames");
  refused(5, 7, "has the type 7; BrainShift reads 0 (uchar)");
  MGHTestFile file;
  file.place[0] = 0.0F;
  expectRefused<MGH>("no.mgh", file.bytes(), "column 0 of the affine has length 0 mm");
  const std::string bytes = MGHTestFile().bytes();
  expectRefused<MGH>(
    "no.mgh", bytes.substr(0, 290), "has 6 bytes of numbers where the header announces 12");
  MGH reader;
  writeFile("can.mgh", bytes);
  EXPECT_EQ(reader->CanReadFile(scratchFile("can.mgh").c_str()), 1);
  EXPECT_EQ(reader->CanReadFile(scratchFile("missing.mgh").c_str()), 0);
  EXPECT_EQ(reader->CanReadFile(nullptr), 0);
}
