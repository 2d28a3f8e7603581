// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMFolder.h"

#include "Common/Parallel.h"
#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMSettings.h"
#include "Formats/DICOM/DICOMStack.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>
#include <system_error>
#include <tuple>

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

// Files that begin as DICOM does, sorted by name: those that a DICOMDIR lists; those of a folder,
// or of its subfolders down to the fourth level if it has none; else those beside a file. The path
// is absolute.
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

constexpr std::int64_t FilesAtOnce = 64;     // between two calls of progress
constexpr double LargestCosineChange = 1e-3; // of the axes of one stack
constexpr double LargestSpacingChange = 1e-3;

bool isSameStack(const DICOMFrame& a, const DICOMFrame& b)
{
  const glm::dvec3 turned =
    glm::max(glm::abs(a.alongRow - b.alongRow), glm::abs(a.alongColumn - b.alongColumn));
  const glm::dvec2 resized = glm::abs(a.spacingMm - b.spacingMm);
  return a.isPlaced == b.isPlaced &&
    std::max({ turned.x, turned.y, turned.z }) <= LargestCosineChange &&
    resized.x <= LargestSpacingChange * a.spacingMm.x &&
    resized.y <= LargestSpacingChange * a.spacingMm.y;
}

// What the images of one stack have in common, apart from numbers that are rounded.
using Kind = std::tuple<std::string, int, int, std::string, std::string, std::string, std::string>;

Kind kindOf(const DICOMFile& file, const DICOMFrame& frame)
{
  // Frames without positions of their own are a volume, or the times of one, in their file only.
  const std::string place = file.standsAlone ? file.series + '\n' + file.path : file.series;
  const std::string quantity = frame.quantity + (file.smallIsBright ? "\nINVERSE" : "") +
    (file.pixels.colors == DICOMColors::None ? "" : "\nCOLORS");
  return { place, file.columns, file.rows, frame.type, file.problem, quantity, frame.stack };
}

std::vector<DICOMSeries> stacksOf(const std::vector<DICOMFile>& files)
{
  std::vector<DICOMSeries> series;
  std::map<Kind, std::vector<std::size_t>> ofKind; // indices of series
  for (const DICOMFile& file : files)
  {
    if (file.segments.kind != SegmentKind::None)
    {
      series.push_back({ {}, file.frames, {}, {} }); // one grid, whatever its frames are
      continue;
    }
    for (const DICOMFrame& frame : file.frames)
    {
      std::vector<std::size_t>& candidates = ofKind[kindOf(file, frame)];
      const auto same = std::find_if(candidates.begin(), candidates.end(),
        [&](std::size_t index) { return isSameStack(series[index].frames.front(), frame); });
      if (same == candidates.end())
      {
        candidates.push_back(series.size());
        series.push_back({ {}, { frame }, {}, {} });
      }
      else
      {
        series[*same].frames.push_back(frame);
      }
    }
  }
  return series;
}

// Original or derived, primary or secondary, and whether it is a localizer, a phase, and so on.
std::string mainType(const DICOMFrame& frame)
{
  std::size_t end = 0;
  for (int part = 0; part < 3 && end != std::string::npos; ++part)
  {
    end = frame.type.find('\\', end == 0 ? 0 : end + 1);
  }
  return frame.type.substr(0, end);
}

bool shareNoPlace(const DICOMSeries& a, const DICOMSeries& b)
{
  const std::vector<double> placesA = placesOf(a.frames);
  const std::vector<double> placesB = placesOf(b.frames);
  const double nearMm = 1e-2 * std::min(a.frames.front().spacingMm.x, 1.0);
  return std::none_of(placesA.begin(), placesA.end(), [&](double place) {
    const auto next = std::lower_bound(placesB.begin(), placesB.end(), place - nearMm);
    return next != placesB.end() && *next <= place + nearMm;
  });
}

// Some scanners write slices of one volume with details of the type that differ.
void joinParts(const std::vector<DICOMFile>& files, std::vector<DICOMSeries>& series)
{
  std::map<Kind, std::vector<std::size_t>> ofKind;
  std::vector<DICOMSeries> joined;
  for (DICOMSeries& part : series)
  {
    DICOMFrame first = part.frames.front();
    first.type = mainType(first);
    std::vector<std::size_t>& candidates = ofKind[kindOf(files[first.file], first)];
    const auto whole =
      std::find_if(candidates.begin(), candidates.end(), [&](std::size_t candidate) {
        return isSameStack(joined[candidate].frames.front(), first) && first.isPlaced &&
          shareNoPlace(joined[candidate], part);
      });
    if (whole == candidates.end())
    {
      candidates.push_back(joined.size());
      joined.push_back(std::move(part));
    }
    else
    {
      std::vector<DICOMFrame>& frames = joined[*whole].frames;
      frames.insert(frames.end(), part.frames.begin(), part.frames.end());
    }
  }
  series = std::move(joined);
}

std::string nameOf(const DICOMFile& file, const std::vector<DICOMFrame>& frames)
{
  const std::size_t places = frames.front().isPlaced ? placesOf(frames).size() : frames.size();
  const bool isSegmented = file.segments.kind != SegmentKind::None; // several at one position
  const std::size_t times = isSegmented ? 1 : frames.size() / places;
  std::string name = std::to_string(file.seriesNumber);
  for (const std::string& part : { file.description, file.modality,
         std::to_string(file.columns) + " x " + std::to_string(file.rows) + " x " +
           std::to_string(places),
         times > 1 ? std::to_string(times) + " times" : std::string(), file.date,
         frames.front().measured })
  {
    name += part.empty() ? "" : ", " + part;
  }
  return name;
}

// Parts series that have each setting of the scanner at several times.
void partSettings(const std::vector<DICOMFile>& files, std::vector<DICOMSeries>& series)
{
  std::vector<DICOMSeries> all;
  for (DICOMSeries& whole : series)
  {
    const std::string name = nameOf(files[whole.frames.front().file], whole.frames);
    for (DICOMSettingPart& part : partedBySetting(std::move(whole.frames)))
    {
      all.push_back({ {}, std::move(part.frames), part.setting, name });
    }
  }
  series = std::move(all);
}

// Names that are alike get the type of their images, or a number.
void nameAll(const std::vector<DICOMFile>& files, std::vector<DICOMSeries>& series)
{
  std::map<std::string, int> count;
  for (DICOMSeries& one : series)
  {
    one.name = nameOf(files[one.frames.front().file], one.frames);
    one.name += one.setting.empty() ? "" : ", " + one.setting;
    ++count[one.name];
  }
  std::set<std::string> taken;
  for (DICOMSeries& one : series)
  {
    std::string type = plainText(one.frames.front().type);
    std::replace(type.begin(), type.end(), '\\', ' ');
    one.name += count[one.name] > 1 && !type.empty() ? ", " + type : "";
    const std::string base = one.name;
    for (int number = 2; !taken.insert(one.name).second; ++number)
    {
      one.name = base + " (" + std::to_string(number) + ")";
    }
  }
}

// Names of what keeps the images of two entries of a list apart.
std::string differencesOf(
  const DICOMFile& fileA, const DICOMFrame& a, const DICOMFile& fileB, const DICOMFrame& b)
{
  const glm::dvec3 turned =
    glm::max(glm::abs(a.alongRow - b.alongRow), glm::abs(a.alongColumn - b.alongColumn));
  const glm::dvec2 resized = glm::abs(a.spacingMm - b.spacingMm) / a.spacingMm;
  std::string names;
  for (const auto& [differs, name] :
    { std::pair<bool, const char*>{ fileA.columns != fileB.columns, "Columns" },
      { fileA.rows != fileB.rows, "Rows" },
      { std::max({ turned.x, turned.y, turned.z }) > LargestCosineChange,
        "ImageOrientationPatient" },
      { fileA.smallIsBright != fileB.smallIsBright ||
          (fileA.pixels.colors == DICOMColors::None) != (fileB.pixels.colors == DICOMColors::None),
        "PhotometricInterpretation" },
      { std::max(resized.x, resized.y) > LargestSpacingChange, "PixelSpacing" },
      { a.quantity != b.quantity, "RescaleType or Units" }, { a.type != b.type, "ImageType" },
      { a.stack != b.stack, "StackID" } })
  {
    names += !differs ? "" : (names.empty() ? "" : ", ") + std::string(name);
  }
  return names;
}

constexpr double LeastCosine = 0.94; // of 20 degrees

// Whether the axes of two images are nearly the same.
bool areAlongSameAxes(const DICOMFrame& a, const DICOMFrame& b)
{
  return glm::dot(a.alongRow, b.alongRow) > LeastCosine &&
    glm::dot(a.alongColumn, b.alongColumn) > LeastCosine;
}

// Whether they are in another direction or order: a slice that is stored mirrored or rotated.
bool areMirrored(const DICOMFrame& a, const DICOMFrame& b)
{
  const auto isAlong = [](const glm::dvec3& one, const glm::dvec3& other) {
    return std::abs(glm::dot(one, other)) > LeastCosine;
  };
  return !areAlongSameAxes(a, b) &&
    ((isAlong(a.alongRow, b.alongRow) && isAlong(a.alongColumn, b.alongColumn)) ||
      (isAlong(a.alongRow, b.alongColumn) && isAlong(a.alongColumn, b.alongRow)));
}

// A series whose places count along the normal of another image.
DICOMSeries alongAxesOf(const DICOMFrame& frame, DICOMSeries series)
{
  for (DICOMFrame& one : series.frames)
  {
    one.alongRow = frame.alongRow;
    one.alongColumn = frame.alongColumn;
  }
  return series;
}

// Whether slices of one volume may have come apart. Planes that lean much were meant so, as were
// localizers and images of another type at the same positions.
bool areParted(
  const std::vector<DICOMFile>& files, const DICOMSeries& shown, const DICOMSeries& other)
{
  const DICOMFrame& a = shown.frames.front();
  const DICOMFrame& b = other.frames.front();
  const DICOMFile& file = files[b.file];
  const auto isLocalizer = [](const DICOMFrame& frame) {
    return frame.type.find("LOCALIZER") != std::string::npos;
  };
  return file.series == files[a.file].series && isLocalizer(a) == isLocalizer(b) &&
    file.problem.empty() && !file.standsAlone && !files[a.file].standsAlone && a.isPlaced &&
    b.isPlaced &&
    (areMirrored(a, b) ? shareNoPlace(shown, alongAxesOf(a, other))
                       : areAlongSameAxes(a, b) && shareNoPlace(shown, other));
}

std::string noImageSentence(const DICOMFile& file)
{
  const std::string modality = file.modality.empty() ? "" : " (modality " + file.modality + ")";
  return file.isDamaged ? "is a DICOM file whose header is damaged"
                        : "is a DICOM file without an image" + modality;
}

double voxelsOf(const std::vector<DICOMFile>& files, const DICOMSeries& series)
{
  const DICOMFile& file = files[series.frames.front().file];
  return file.problem.empty() ? static_cast<double>(series.frames.size()) * file.columns * file.rows
                              : 0.0;
}

// Brings the series to the front that is shown if nobody chooses.
void sortSeries(
  const std::string& path, const std::vector<DICOMFile>& files, std::vector<DICOMSeries>& series)
{
  std::stable_sort(
    series.begin(), series.end(), [&files](const DICOMSeries& a, const DICOMSeries& b) {
      return files[a.frames.front().file].seriesNumber < files[b.frames.front().file].seriesNumber;
    });
  const auto rank = [&](const DICOMSeries& one) {
    const bool hasFile = std::any_of(one.frames.begin(), one.frames.end(),
      [&](const DICOMFrame& frame) { return files[frame.file].path == path; });
    // A segmentation belongs to images, which are shown before it.
    const bool isImage = files[one.frames.front().file].segments.kind == SegmentKind::None;
    return std::make_tuple(hasFile, isImage && voxelsOf(files, one) > 0.0, voxelsOf(files, one));
  };
  auto first = series.begin();
  for (auto one = series.begin(); one != series.end(); ++one)
  {
    first = rank(*first) < rank(*one) ? one : first;
  }
  if (first != series.end())
  {
    std::rotate(series.begin(), first, first + 1);
  }
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

DICOMFolder readDICOMFolder(const std::string& path, const Progress& progress)
{
  DICOMFolder folder;
  const std::string whole = std::filesystem::absolute(path).lexically_normal().string();
  const std::vector<std::string> paths = filesBeside(whole);
  const auto count = static_cast<std::int64_t>(paths.size());
  std::vector<DICOMFile> read(paths.size());
  for (std::int64_t first = 0; first < count; first += FilesAtOnce)
  {
    parallelFor(
      first, std::min(first + FilesAtOnce, count), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i)
        {
          read[i] = readDICOMHeader(paths[i]);
        }
      });
    if (!progress(static_cast<double>(first) / static_cast<double>(count)))
    {
      folder.isStopped = true;
      return folder;
    }
  }
  for (DICOMFile& file : read)
  {
    folder.damaged += file.isDamaged ? 1 : 0;
    if (file.frames.empty() && file.path == whole)
    {
      folder.noImage = noImageSentence(file);
    }
    if (!file.frames.empty())
    {
      for (DICOMFrame& frame : file.frames)
      {
        frame.file = folder.files.size();
      }
      folder.files.push_back(std::move(file));
    }
  }
  folder.series = stacksOf(folder.files);
  joinParts(folder.files, folder.series);
  partSettings(folder.files, folder.series);
  sortSeries(whole, folder.files, folder.series);
  nameAll(folder.files, folder.series);
  return folder;
}

std::vector<std::string> partedNotes(const DICOMFolder& folder, const DICOMSeries& chosen)
{
  std::vector<std::string> notes;
  const DICOMFrame& shown = chosen.frames.front();
  for (const DICOMSeries& other : folder.series)
  {
    const DICOMFrame& first = other.frames.front();
    const std::string names =
      differencesOf(folder.files[shown.file], shown, folder.files[first.file], first);
    if (&other != &chosen && !names.empty() && areParted(folder.files, chosen, other))
    {
      notes.push_back("lacks images at other positions, which are another entry of its list: " +
        std::to_string(other.frames.size()) + " with another " + names +
        (areMirrored(shown, first) ? "; they are stored mirrored or rotated within their plane, so "
                                     "no slice is missing there"
                                   : ""));
    }
  }
  return notes;
}
}
