// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Runs a reader of volumes on a file of the test's scratch folder and keeps what it says.
#ifndef BrainShift_VolumeFormatTesting_h
#define BrainShift_VolumeFormatTesting_h

#include "Formats/Volumes/VolumeFile.h"
#include "Formats/Volumes/vtkVolumeFileReader.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace brainshift::testing
{
inline std::string scratchFile(const std::string& name)
{
  return std::string(BRAINSHIFT_TEST_TEMP) + "/VolumeFormats-" + name;
}

inline void writeFile(const std::string& name, const std::string& bytes)
{
  std::ofstream(scratchFile(name), std::ios::binary) << bytes;
}

// A reader of one format only.
template <const char* const& FormatName>
struct ReaderOf : vtkNew<vtkVolumeFileReader>
{
  ReaderOf() { (*this)->SetFormat(FormatName); }
};

///@{
// Readers of the formats.
constexpr const char* MGHName = "MGH";
constexpr const char* MetaImageName = "MetaImage";
constexpr const char* NIFTIName = "NIFTI";
constexpr const char* NRRDName = "NRRD";
using MGH = ReaderOf<MGHName>;
using Meta = ReaderOf<MetaImageName>;
using NIFTI = ReaderOf<NIFTIName>;
using NRRD = ReaderOf<NRRDName>;
///@}

// What a reader makes of a file.
template <typename Reader>
struct FormatReading
{
  explicit FormatReading(const std::string& name)
    : Heard(this->reader)
  {
    this->reader->SetFileName(scratchFile(name).c_str());
    this->reader->Update();
  }

  vtkImageData* image() { return this->reader->GetOutput(); }

  std::vector<double> values()
  {
    vtkDataArray* scalars = this->image()->GetPointData()->GetScalars();
    std::vector<double> numbers;
    for (vtkIdType i = 0; scalars && i < scalars->GetNumberOfValues(); ++i)
    {
      const int components = scalars->GetNumberOfComponents();
      numbers.push_back(scalars->GetComponent(i / components, static_cast<int>(i % components)));
    }
    return numbers;
  }

  std::string said() { return this->Heard.take(); }

  Reader reader;

private:
  Errors Heard;
};

// Whether a reader only said that the file does not say where the sides of the patient are.
inline bool isOnlyOfSides(const std::string& said)
{
  const std::string begin = "Warning: ";
  const std::size_t first = said.find(begin);
  return said.find(brainshift::UnknownSidesWarning) != std::string::npos &&
    said.find(begin, first + 1) == std::string::npos && said.find("ERROR: ") == std::string::npos;
}

// A file is refused in a sentence with these words, and leaves no voxels.
template <typename Reader>
void expectRefused(const std::string& name, const std::string& words)
{
  FormatReading<Reader> reading(name);
  const std::string said = reading.said();
  EXPECT_NE(said.find(words), std::string::npos) << words << ": " << said;
  EXPECT_EQ(reading.image()->GetNumberOfPoints(), 0) << words;
}

template <typename Reader>
void expectRefused(const std::string& name, const std::string& bytes, const std::string& words)
{
  writeFile(name, bytes);
  expectRefused<Reader>(name, words);
}
}

#endif
