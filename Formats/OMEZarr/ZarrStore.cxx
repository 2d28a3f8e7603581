// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/ZarrStore.h"

#include "Common/Problem.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/SystemPath.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/ZipFile.h"

#include <algorithm>
#include <array>
#include <filesystem>

namespace fs = std::filesystem;

namespace brainshift
{
namespace
{
// What is at the top of a store, of version 3 and 2.
constexpr std::array<const char*, 4> MetadataNames{ "zarr.json", ".zattrs", ".zgroup", ".zarray" };

class FolderStore : public ZarrStore
{
public:
  explicit FolderStore(std::string folder)
    : Folder(std::move(folder))
  {
  }

  std::optional<std::uint64_t> size(const std::string& key) const override
  {
    const fs::path path = systemPath(this->pathOf(key));
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found)
    {
      return std::nullopt;
    }
    if (status.type() != fs::file_type::regular) // a pipe would wait for ever
    {
      throw Problem(error ? "cannot be read: " + error.message() : "is no plain file");
    }
    const std::uintmax_t size = fs::file_size(path, error);
    throwIfAny(error ? "cannot be read: " + error.message() : std::string());
    return size;
  }

  std::string part(const std::string& key, std::uint64_t offset, std::uint64_t count) const override
  {
    return fileBytes(this->pathOf(key), offset, count);
  }

  std::optional<std::int64_t> written(const std::string& key) const override
  {
    std::error_code error;
    const fs::file_time_type time = fs::last_write_time(systemPath(this->pathOf(key)), error);
    return error ? std::nullopt : std::optional<std::int64_t>(time.time_since_epoch().count());
  }

private:
  std::string Folder;

  std::string pathOf(const std::string& key) const { return this->Folder + "/" + key; }
};

// From the folder in a zip file on that holds the outermost metadata.
class ZipStore : public ZarrStore
{
public:
  explicit ZipStore(const std::string& fileName)
    : File(fileName)
  {
    this->findTop();
  }

  std::optional<std::uint64_t> size(const std::string& key) const override
  {
    return this->File.size(this->Top + key);
  }

  std::string part(const std::string& key, std::uint64_t offset, std::uint64_t count) const override
  {
    return this->File.part(this->Top + key, offset, count);
  }

  std::optional<std::int64_t> written(const std::string& key) const override
  {
    return this->size(key) ? std::optional<std::int64_t>(0) : std::nullopt;
  }

private:
  ZipFile File;
  std::string Top; // before the keys

  // The first by the alphabet of several that are as far out.
  void findTop()
  {
    std::optional<std::string> top;
    std::ptrdiff_t least = 0;
    for (const std::string& key : this->File.names())
    {
      const std::size_t slash = key.rfind('/');
      const std::string name = key.substr(slash == std::string::npos ? 0 : slash + 1);
      const std::string folder = key.substr(0, key.size() - name.size());
      const std::ptrdiff_t depth = std::count(folder.begin(), folder.end(), '/');
      const bool isMetadata = name == "zarr.json" || name == ".zattrs" || name == ".zgroup";
      if (isMetadata && (!top || depth < least || (depth == least && folder < *top)))
      {
        top = folder;
        least = depth;
      }
    }
    this->Top = top.value_or("");
  }
};

// Empty unless a name is that of a folder, or of metadata in it.
std::string folderOf(const std::string& fileName)
{
  std::error_code error;
  if (fs::is_directory(systemPath(fileName), error))
  {
    return fileName;
  }
  const fs::path path = systemPath(fileName);
  const bool isMetadata = std::any_of(MetadataNames.begin(), MetadataNames.end(),
    [&path](const char* name) { return path.filename() == name; });
  return !isMetadata || !isPlainFile(fileName) ? std::string()
    : path.has_parent_path()                   ? nameOfPath(path.parent_path())
                                               : std::string(".");
}

bool beginsLikeZip(const std::string& fileName)
{
  return isPlainFile(fileName) && readBeginning(fileName, 2) == "PK";
}

bool holdsMetadata(const ZarrStore& store)
{
  return std::any_of(MetadataNames.begin(), MetadataNames.end(),
    [&store](const char* name) { return store.size(name).has_value(); });
}
}

std::optional<std::string> ZarrStore::read(const std::string& key, std::uint64_t limit) const
{
  const std::optional<std::uint64_t> size = this->size(key);
  if (!size)
  {
    return std::nullopt;
  }
  if (*size > limit)
  {
    throw Problem(
      "has " + std::to_string(*size) + " bytes; it may have up to " + std::to_string(limit));
  }
  return this->part(key, 0, *size);
}

std::unique_ptr<ZarrStore> openZarrStore(const std::string& fileName)
{
  const std::string folder = folderOf(fileName);
  std::unique_ptr<ZarrStore> store;
  if (!folder.empty())
  {
    store = std::make_unique<FolderStore>(folder);
  }
  else if (beginsLikeZip(fileName))
  {
    store = std::make_unique<ZipStore>(fileName);
  }
  else
  {
    throw Problem("is neither a folder, nor a file of metadata (zarr.json, .zattrs, .zgroup, "
                  ".zarray), nor a zip file");
  }
  if (!holdsMetadata(*store))
  {
    throw Problem("holds no metadata of zarr: neither zarr.json nor .zattrs");
  }
  return store;
}

std::unique_ptr<ZarrStore> openFolderStore(const std::string& folder)
{
  return std::make_unique<FolderStore>(folder);
}

bool isZarrStore(const std::string& fileName)
{
  return problemOf([&] { openZarrStore(fileName); }).empty();
}

std::string keyIn(const std::string& group, const std::string& name)
{
  return group.empty() ? name : group + "/" + name;
}

void requireInside(const std::string& path)
{
  for (std::size_t begin = 0; begin <= path.size();)
  {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const std::string word = path.substr(begin, end - begin);
    if (word.empty() || word == "." || word == ".." || word.find('\0') != std::string::npos)
    {
      throw Problem("has the path '" + shownWords(path) +
        "'; it must be words between slashes that stay in the store");
    }
    begin = end + 1;
  }
}
}
