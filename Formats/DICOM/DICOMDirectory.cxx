// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMDirectory.h"

#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMFile.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

namespace brainshift
{
namespace
{
namespace fs = std::filesystem;

constexpr int DeepestLevel = 4;           // patient, study, series, and one for the medium
constexpr int MostProbed = 1000;          // files that are looked at before a folder is opened
constexpr std::size_t MostFolders = 1000; // of one level
constexpr DICOMTag DirectoryRecords = 0x00041220;
constexpr DICOMTag ReferencedFile = 0x00041500;

struct Entries
{
  std::vector<fs::path> files;
  std::vector<fs::path> folders;
};

Entries entriesOf(const fs::path& folder)
{
  Entries entries;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
    entry.increment(error))
  {
    std::error_code kindError;
    const bool isFolder = entry->is_directory(kindError) && !entry->is_symlink(kindError);
    (isFolder ? entries.folders : entries.files).push_back(entry->path());
  }
  std::sort(entries.files.begin(), entries.files.end());
  std::sort(entries.folders.begin(), entries.folders.end());
  return entries;
}

bool isDICOMDIR(const fs::path& path)
{
  return path.filename() == "DICOMDIR" || path.filename() == "dicomdir";
}

// A file's name in a DICOMDIR: parts between backslashes, none of which leads out of the folder.
// Media in lower case are tried, too.
fs::path listedFile(const fs::path& folder, const std::string& name)
{
  fs::path path = folder;
  fs::path lower = folder;
  for (std::size_t begin = 0; begin < name.size();)
  {
    const std::size_t end = std::min(name.find('\\', begin), name.size());
    std::string part = name.substr(begin, end - begin);
    if (part.empty() || part == "." || part == ".." || part.find('/') != std::string::npos)
    {
      return {};
    }
    path /= part;
    std::transform(part.begin(), part.end(), part.begin(),
      [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    lower /= part;
    begin = end + 1;
  }
  std::error_code error;
  return fs::exists(path, error) ? path : lower;
}

std::vector<std::string> listedFiles(const fs::path& directory)
{
  std::vector<std::string> files;
  DICOMBytes bytes(directory.string(), DICOMBytes::MostOfHeader);
  DICOMContent content;
  if (!isDICOMFile(directory.string()) || !parseDICOM(bytes, content))
  {
    return files;
  }
  for (const DICOMDataSet& record : itemsOf(content.set, DirectoryRecords))
  {
    const std::string name = textOf(record, ReferencedFile);
    const fs::path file = name.empty() ? fs::path() : listedFile(directory.parent_path(), name);
    if (!file.empty() && isDICOMFile(file.string()))
    {
      files.push_back(file.string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

// Files of a folder that are DICOM. Those whose name begins with a dot are another system's notes.
std::vector<std::string> filesIn(const Entries& entries)
{
  std::vector<std::string> files;
  for (const fs::path& file : entries.files)
  {
    if (!isDICOMDIR(file) && file.filename().string().front() != '.' && isDICOMFile(file.string()))
    {
      files.push_back(file.string());
    }
  }
  return files;
}

// Files of the uppermost level that has any.
std::vector<std::string> filesBelow(const fs::path& folder)
{
  std::vector<fs::path> level{ folder };
  std::vector<std::string> files;
  for (int depth = 0; depth <= DeepestLevel && files.empty() && !level.empty(); ++depth)
  {
    std::vector<fs::path> next;
    for (const fs::path& one : level)
    {
      const Entries entries = entriesOf(one);
      const std::vector<std::string> found = filesIn(entries);
      files.insert(files.end(), found.begin(), found.end());
      next.insert(next.end(), entries.folders.begin(), entries.folders.end());
    }
    next.resize(std::min(next.size(), MostFolders));
    level = std::move(next);
  }
  return files;
}
}

bool leadsToDICOM(const std::string& path)
{
  std::error_code error;
  if (!fs::is_directory(path, error))
  {
    return isDICOMFile(path);
  }
  int probed = 0;
  std::vector<fs::path> level{ path };
  for (int depth = 0; depth <= DeepestLevel && !level.empty(); ++depth)
  {
    std::vector<fs::path> next;
    for (const fs::path& folder : level)
    {
      const Entries entries = entriesOf(folder);
      for (const fs::path& file : entries.files)
      {
        if (isDICOMFile(file.string()))
        {
          return true;
        }
        if (++probed >= MostProbed)
        {
          return false;
        }
      }
      next.insert(next.end(), entries.folders.begin(), entries.folders.end());
    }
    next.resize(std::min<std::size_t>(next.size(), MostProbed));
    level = std::move(next);
  }
  return false;
}

std::vector<std::string> filesBeside(const std::string& path)
{
  std::error_code error;
  if (!fs::is_directory(path, error))
  {
    if (isDICOMDIR(path)) // some list other directories, in a way of their own
    {
      const std::vector<std::string> listed = listedFiles(path);
      return listed.empty() ? filesBelow(fs::path(path).parent_path()) : listed;
    }
    return isDICOMFile(path) ? filesIn(entriesOf(fs::path(path).parent_path()))
                             : std::vector<std::string>();
  }
  return filesBelow(path);
}
}
