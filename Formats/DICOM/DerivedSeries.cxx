// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DerivedSeries.h"

#include "Formats/DICOM/DerivedHeader.h"
#include "Formats/Files/WholeFile.h"

#include <cstdio>
#include <filesystem>
#include <random>
#include <system_error>

namespace brainshift
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* Ending = ".dcm";

void requireNewFolder(const fs::path& folder)
{
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status))
  {
    return;
  }
  if (!fs::is_directory(status))
  {
    throw Problem("it exists and is not a folder");
  }
  if (!fs::is_empty(folder, error) || error)
  {
    throw Problem("it holds files already; choose a new folder");
  }
}

std::string nameOf(int slice)
{
  char name[32];
  std::snprintf(name, sizeof(name), "IM%05d.dcm", slice + 1);
  return name;
}

void writeSlices(const fs::path& folder, DerivedSet header, const OutgoingVolume& volume,
  const DerivedPixels& pixels, const Progress& progress)
{
  const int slices = pixels.grid.dimensions.z;
  for (int slice = 0; slice < slices; ++slice)
  {
    setSlice(pixels, slice, header);
    const std::string bytes = fileOf(header, derivedSlice(volume, pixels, slice));
    writeWholeStream((folder / nameOf(slice)).string(), [&](std::ostream& file) {
      file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    });
    if (!progress((slice + 1.0) / slices))
    {
      throw Problem("it was stopped");
    }
  }
}
}

bool isSeriesName(const std::string& fileName)
{
  return fs::path(fileName).extension() == Ending;
}

void writeSeries(const std::string& name, const std::string& like, const OutgoingVolume& volume,
  const Progress& progress)
{
  fs::path folder = isSeriesName(name) ? fs::path(name).replace_extension() : fs::path(name);
  folder = folder.has_filename() ? folder : folder.parent_path(); // a slash at the end
  if (!volume.knowsSides)
  {
    throw Problem("The world axes of the input are unknown, and a DICOM series needs them; set "
                  "World to RAS or LPS if you know them");
  }
  DICOMDataSet source;
  DerivedPixels pixels;
  readLike(like, source);
  derivedPixels(volume, pixels);
  const fs::path beside = folder.parent_path() /
    (".part-" + std::to_string(std::random_device()()) + "-" + folder.filename().string());
  std::error_code error;
  try
  {
    withBeginning("The series in folder " + folder.string() + " cannot be written: ", [&] {
      requireNewFolder(folder);
      throwIfAny(fs::create_directory(beside, error) ? std::string() : error.message());
      writeSlices(beside, sharedHeader(source, pixels), volume, pixels, progress);
      fs::remove(folder, error); // an empty one
      fs::rename(beside, folder, error);
      throwIfAny(error ? error.message() : std::string());
    });
  }
  catch (...)
  {
    fs::remove_all(beside, error);
    throw;
  }
}
}
