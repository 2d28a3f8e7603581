// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/SourceFacts.h"

#include "Formats/Files/Text.h"
#include "vtkVolumeFileReader.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <iomanip>
#include <vector>

namespace fs = std::filesystem;

namespace brainshift
{
namespace
{
constexpr std::uint64_t HashStart = 14695981039346656037U; // FNV-1a, of 8 bytes at a time
constexpr std::uint64_t HashFactor = 1099511628211U;

std::uint64_t hashOf(const char* bytes, std::size_t count, std::uint64_t hash)
{
  for (std::size_t i = 0; i < count; i += sizeof(std::uint64_t))
  {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min(sizeof(word), count - i));
    hash = (hash ^ word) * HashFactor;
    hash ^= hash >> 29;
  }
  return hash;
}

std::string factsOf(const fs::path& file)
{
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  const auto time = fs::last_write_time(file, error).time_since_epoch().count();
  return error ? std::string() : joined(file.string(), " ", size, " ", time, "\n");
}

// Of a file, or of all files in a folder.
std::string factsBelow(const std::string& name)
{
  std::error_code error;
  const fs::path path = fs::absolute(name, error);
  if (!fs::is_directory(path, error))
  {
    return factsOf(path);
  }
  std::vector<std::string> all;
  for (fs::recursive_directory_iterator entry(path, error), end; !error && entry != end;
    entry.increment(error))
  {
    if (entry->is_regular_file(error))
    {
      all.push_back(factsOf(entry->path()));
    }
  }
  std::sort(all.begin(), all.end());
  std::uint64_t hash = HashStart;
  for (const std::string& facts : all)
  {
    hash = hashOf(facts.data(), facts.size(), hash);
  }
  return all.empty() || error
    ? std::string()
    : joined(path.string(), " ", all.size(), " files ", std::hex, hash, "\n");
}

// The reader of BrainShift that makes a volume; ParaView may put a filter between that changes
// nothing. Null: another source.
vtkVolumeFileReader* readerOf(vtkAlgorithm* producer)
{
  while (producer && producer->GetNumberOfInputPorts() == 1 &&
    producer->GetNumberOfInputConnections(0) == 1 &&
    (producer->IsA("vtkPVPostFilter") || producer->IsA("vtkCompleteArrays")))
  {
    producer = producer->GetInputAlgorithm(0, 0);
  }
  return vtkVolumeFileReader::SafeDownCast(producer);
}
}

std::string sourceFacts(vtkAlgorithm* producer, const std::string& file)
{
  vtkVolumeFileReader* reader = readerOf(producer);
  const char* read = reader ? reader->GetFileName() : nullptr;
  const std::string name = !file.empty() ? file : read ? read : "";
  const std::string facts = name.empty() ? std::string() : factsBelow(name);
  return facts.empty() || !reader
    ? facts
    : joined(facts, reader->GetFormat(), " '", reader->GetChoice(), "' ",
        reader->GetResampleSlices(), reader->GetLuminance(), " ", reader->GetLevel(), " ",
        reader->GetMemoryLimit(), " ", reader->GetChannel(), "\n");
}

std::string gridFacts(const PyramidContent& content, vtkImageData* image)
{
  std::string facts = joined(content.type, " ", content.components, " ", content.isLabelMap,
    content.isVersion3, content.knowsSides, " ");
  const Grid& grid = content.grid;
  for (const double number : boxOf(grid))
  {
    facts += joined(std::setprecision(17), number, " ");
  }
  vtkInformation* data = image->GetInformation();
  const bool knowsTime = data->Has(vtkDataObject::DATA_TIME_STEP()) != 0;
  return facts +
    joined(grid.dimensions.x, " ", grid.dimensions.y, " ", grid.dimensions.z, " at ",
      knowsTime ? data->Get(vtkDataObject::DATA_TIME_STEP()) : 0.0, "\n");
}

std::string hashFacts(int type, const VoxelBox& box)
{
  const auto bytes = static_cast<std::int64_t>(vtkDataArray::GetDataTypeSize(type));
  std::uint64_t hash = HashStart;
  for (std::int64_t z = 0; z < box.size.z; ++z)
  {
    for (std::int64_t y = 0; y < box.size.y; ++y)
    {
      const char* row = box.first + (y * box.steps.y + z * box.steps.z) * bytes;
      hash = hashOf(row, static_cast<std::size_t>(box.size.x * box.steps.x * bytes), hash);
    }
  }
  return joined(std::hex, hash);
}
}
