// SPDX-License-Identifier: BSD-3-Clause
// Proves that surfaces and streamlines lie where their files say, and that a file of each format
// that ends early, or in which any byte is another, is read whole or refused whole. The
// sanitizers watch. nibabel judges places in Surfaces.py and Tracts.py.
#include "vtkSurfaceReader.h"
#include "vtkTractReader.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace
{
template <typename T>
std::string stored(const std::vector<T>& numbers, bool isBigEndian)
{
  std::string bytes;
  for (const T number : numbers)
  {
    char raw[sizeof(T)];
    std::memcpy(raw, &number, sizeof(T));
    if (isBigEndian)
    {
      std::reverse(raw, raw + sizeof(T)); // the tests run on little-endian machines
    }
    bytes.append(raw, sizeof(T));
  }
  return bytes;
}

// A triangle in tkRAS of a conformed volume whose middle lies at 10 20 30.
std::string freeSurferFile()
{
  return "\xFF\xFF\xFE" + std::string("made by a test\n\n") + stored<std::int32_t>({ 3, 1 }, true) +
    stored<float>({ 1, 2, 3, 4, 5, 6, 7, 8, 10 }, true) + stored<std::int32_t>({ 0, 1, 2 }, true) +
    stored<std::int32_t>({ 2, 0, 20 }, true) +
    "valid = 1  # volume info valid\nfilename = orig.mgz\nvolume = 256 256 256\n"
    "voxelsize = 1 1 1\nxras = -1 0 0\nyras = 0 0 -1\nzras = 0 1 0\ncras = 10 20 30\n";
}

std::string giftiArray(const std::string& intent, const std::string& type, const std::string& rest)
{
  return "<DataArray Intent=\"NIFTI_INTENT_" + intent + "\" DataType=\"NIFTI_TYPE_" + type +
    "\" ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=\"2\" Dim1=\"3\" " + rest +
    "</Data></DataArray>";
}

// The same triangle with a matrix to the scanner's space. Its indices are base64.
std::string giftiFile()
{
  return "<?xml version=\"1.0\"?><GIFTI Version=\"1.0\" NumberOfDataArrays=\"2\">" +
    giftiArray("POINTSET", "FLOAT32",
      "Dim0=\"3\" Encoding=\"ASCII\" Endian=\"LittleEndian\"><CoordinateSystemTransformMatrix>"
      "<DataSpace>NIFTI_XFORM_UNKNOWN</DataSpace><TransformedSpace>NIFTI_XFORM_SCANNER_ANAT"
      "</TransformedSpace><MatrixData>1 0 0 10 0 1 0 20 0 0 1 30 0 0 0 1</MatrixData>"
      "</CoordinateSystemTransformMatrix><Data>1 2 3 4 5 6 7 8 10") +
    giftiArray("TRIANGLE", "INT32",
      "Dim0=\"1\" Encoding=\"Base64Binary\" Endian=\"LittleEndian\"><Data>AAAAAAEAAAACAAAA") +
    "</GIFTI>";
}

// Two points in voxels of 1 x 2 x 4 mm, with a number each, and a number of the streamline.
std::string trackVisFile()
{
  std::string header(1000, '\0');
  const auto put = [&](std::size_t place, const std::string& bytes) {
    header.replace(place, bytes.size(), bytes);
  };
  put(0, "TRACK");
  put(6, stored<std::int16_t>({ 9, 8, 7 }, false));
  put(12, stored<float>({ 1, 2, 4 }, false));
  put(36, stored<std::int16_t>({ 1 }, false) + "fa");
  put(238, stored<std::int16_t>({ 1 }, false) + "length");
  put(440, stored<float>({ 1, 0, 0, 10, 0, 2, 0, 20, 0, 0, 4, 30, 0, 0, 0, 1 }, false));
  put(948, "RAS");
  put(988, stored<std::int32_t>({ 1, 2, 1000 }, false));
  return header + stored<std::int32_t>({ 2 }, false) +
    stored<float>({ 1.5f, 3, 5, 0.25f, 2.5f, 5, 9, 0.5f, 7 }, false);
}

std::string mrtrixFile()
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float end = std::numeric_limits<float>::infinity();
  const std::string head = "mrtrix tracks\ncount: 1\ndatatype: Float32LE\nfile: . 64\nEND\n";
  return head + std::string(64 - head.size(), '\0') +
    stored<float>({ 11, 22, 33, 12, 24, 37, nan, nan, nan, end, end, end }, false);
}

// Counts what a reader reports as errors, and keeps warnings quiet.
class Refusals
{
public:
  explicit Refusals(vtkAlgorithm* reader)
  {
    this->Hear->SetClientData(this);
    this->Hear->SetCallback([](vtkObject*, unsigned long event, void* self, void*) {
      static_cast<Refusals*>(self)->Count += event == vtkCommand::ErrorEvent ? 1 : 0;
    });
    reader->AddObserver(vtkCommand::ErrorEvent, this->Hear);
    reader->AddObserver(vtkCommand::WarningEvent, this->Hear);
    reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Hear);
  }
  ~Refusals() { this->Hear->SetCallback(nullptr); } // the reader keeps the command
  Refusals(const Refusals&) = delete;
  Refusals& operator=(const Refusals&) = delete;

  int count() const { return this->Count; }

private:
  vtkNew<vtkCallbackCommand> Hear;
  int Count = 0;
};

template <typename Reader>
class Read
{
public:
  explicit Read(const std::string& bytes)
    : Heard(this->Source)
  {
    const std::string name = std::string(BRAINSHIFT_TEST_TEMP) + "/surface";
    std::ofstream(name, std::ios::binary) << bytes;
    this->Source->SetFileName(name);
    this->Source->Update();
  }

  vtkPolyData* data() { return this->Source->GetOutput(); }
  bool isRefused() const { return this->Heard.count() > 0; }

private:
  vtkNew<Reader> Source;
  Refusals Heard;
};

template <typename Reader>
void expectWholeOrNothing(const std::string& bytes, vtkIdType points)
{
  Read<Reader> read(bytes);
  EXPECT_EQ(read.data()->GetNumberOfPoints() == 0, read.isRefused());
  EXPECT_TRUE(read.isRefused() || read.data()->GetNumberOfPoints() <= points);
}

// Most ends of a file, and every byte reversed.
template <typename Reader>
void expectNoHarm(const std::string& bytes, vtkIdType points)
{
  Read<Reader> good(bytes);
  ASSERT_FALSE(good.isRefused());
  ASSERT_EQ(good.data()->GetNumberOfPoints(), points);
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    std::string spoiled = bytes;
    spoiled[i] = static_cast<char>(~spoiled[i]);
    expectWholeOrNothing<Reader>(spoiled, points);
    if (i % 5 == 0 || i + 200 > bytes.size()) // a header of zeros has little to end
    {
      expectWholeOrNothing<Reader>(bytes.substr(0, i), points);
    }
  }
}

template <typename Reader>
void expectAt(const std::string& bytes, vtkIdType id, const std::vector<double>& expected)
{
  Read<Reader> read(bytes);
  ASSERT_FALSE(read.isRefused());
  double point[3];
  read.data()->GetPoint(id, point);
  EXPECT_EQ(std::vector<double>(point, point + 3), expected);
}
}

TEST(SurfaceReaders, PutPointsWhereFilesSay)
{
  expectAt<vtkSurfaceReader>(freeSurferFile(), 2, { 17, 28, 40 });
  expectAt<vtkSurfaceReader>(giftiFile(), 2, { 17, 28, 40 });
  expectAt<vtkTractReader>(trackVisFile(), 1, { 12, 24, 37 });
  expectAt<vtkTractReader>(mrtrixFile(), 1, { 12, 24, 37 });
}

TEST(SurfaceReaders, ReadFreeSurferWholeOrNotAtAll)
{
  // The geometry may be missing, so a file may end after its triangles.
  expectNoHarm<vtkSurfaceReader>(freeSurferFile(), 3);
}

TEST(SurfaceReaders, ReadGIFTIWholeOrNotAtAll)
{
  expectNoHarm<vtkSurfaceReader>(giftiFile(), 3);
}

TEST(SurfaceReaders, ReadTrackVisWholeOrNotAtAll)
{
  expectNoHarm<vtkTractReader>(trackVisFile(), 2);
}

TEST(SurfaceReaders, ReadMRtrixWholeOrNotAtAll)
{
  expectNoHarm<vtkTractReader>(mrtrixFile(), 2);
}

TEST(SurfaceReaders, WithoutAFileAreInError)
{
  vtkNew<vtkSurfaceReader> surface;
  Refusals ofSurface(surface);
  surface->Update();
  EXPECT_GT(ofSurface.count(), 0);
  vtkNew<vtkTractReader> tracts;
  Refusals ofTracts(tracts);
  tracts->Update();
  EXPECT_GT(ofTracts.count(), 0);
  EXPECT_EQ(vtkSurfaceReader::CanReadFile(nullptr), 0);
  EXPECT_EQ(vtkTractReader::CanReadFile(BRAINSHIFT_TEST_TEMP), 0);
}
