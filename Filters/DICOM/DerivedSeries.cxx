// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/DICOM/DerivedSeries.h"

#include "Filters/DICOM/DerivedHeader.h"
#include "Filters/DICOM/DerivedPixels.h"
#include "Filters/Files/WholeFile.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>

namespace brainshift
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* Ending = ".dcm";

std::string folderProblem(const fs::path& folder)
{
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status))
  {
    return {};
  }
  if (!fs::is_directory(status))
  {
    return "it exists and is not a folder";
  }
  return fs::is_empty(folder, error) && !error ? std::string()
                                               : "it holds files already; choose a new folder";
}

std::string nameOf(int slice)
{
  char name[32];
  std::snprintf(name, sizeof(name), "IM%05d.dcm", slice + 1);
  return name;
}

std::string writeSlice(const std::string& fileName, const std::string& bytes)
{
  return writeWhole(fileName, [&](const std::string& beside) {
    errno = 0;
    std::ofstream file(beside, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    return file ? std::string() : lastSystemError();
  });
}

std::string writeSlices(const fs::path& folder, DerivedSet header, const OutgoingVolume& volume,
  const DerivedPixels& pixels, const Progress& progress)
{
  const int slices = pixels.grid.dimensions.z;
  for (int slice = 0; slice < slices; ++slice)
  {
    setSlice(pixels, slice, header);
    const std::string bytes = fileOf(header, derivedSlice(volume, pixels, slice));
    const std::string problem = writeSlice((folder / nameOf(slice)).string(), bytes);
    if (!problem.empty())
    {
      return problem;
    }
    if (!progress((slice + 1.0) / slices))
    {
      return "it was stopped";
    }
  }
  return {};
}
}

bool isSeriesName(const std::string& fileName)
{
  return fs::path(fileName).extension() == Ending;
}

std::string writeSeries(const std::string& name, const std::string& like,
  const OutgoingVolume& volume, const Progress& progress)
{
  fs::path folder = isSeriesName(name) ? fs::path(name).replace_extension() : fs::path(name);
  folder = folder.has_filename() ? folder : folder.parent_path(); // a slash at the end
  DICOMDataSet source;
  DerivedPixels pixels;
  std::string problem = volume.knowsSides
    ? readLike(like, source)
    : "The input does not know the sides of the patient, which a DICOM series must; set World to "
      "RAS or LPS if you know them";
  problem = problem.empty() ? derivedPixels(volume, pixels) : problem;
  if (!problem.empty())
  {
    return problem;
  }
  const fs::path beside = folder.parent_path() /
    (".part-" + std::to_string(std::random_device()()) + "-" + folder.filename().string());
  std::error_code error;
  problem = folderProblem(folder);
  if (problem.empty() && !fs::create_directory(beside, error))
  {
    problem = error.message();
  }
  problem = problem.empty()
    ? writeSlices(beside, sharedHeader(source, pixels), volume, pixels, progress)
    : problem;
  if (problem.empty())
  {
    fs::remove(folder, error); // an empty one
    fs::rename(beside, folder, error);
    problem = error ? error.message() : problem;
  }
  if (!problem.empty())
  {
    fs::remove_all(beside, error);
    return "The series in folder " + folder.string() + " cannot be written: " + problem;
  }
  return {};
}
}
