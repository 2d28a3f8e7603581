// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Volumes in OME-Zarr stores: one resolution at a time, and of it only the chunks that the extent
/// needs.
#include "Common/HostMemory.h"
#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/OMEZarr/CoarserVoxels.h"
#include "Formats/OMEZarr/OMEImage.h"
#include "Formats/OMEZarr/ZarrBox.h"
#include "Formats/Volumes/FinerLevels.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

namespace brainshift
{
namespace
{
constexpr double BytesInMiB = 1048576.0;
constexpr std::int64_t MostTimes = 65536; // each takes memory
constexpr std::int64_t MostChannels = 1024;

std::string sizeOf(double bytes)
{
  return joined(bytes / BytesInMiB, " MiB");
}

// The number of an axis that may not be there.
template <typename Numbers>
auto at(const Numbers& numbers, int axis, typename Numbers::value_type otherwise)
{
  return axis < 0 ? otherwise : numbers[static_cast<std::size_t>(axis)];
}

class OMEZarrVolume : public VolumeFile
{
public:
  std::string noun() const override { return "OME-Zarr store"; }

  void choose(const std::string& name) override { this->Chosen = name; }

  void setPyramid(const PyramidChoice& pyramid) override { this->Pyramid = pyramid; }

  std::vector<std::string> choices() const override
  {
    std::vector<std::string> names;
    names.reserve(this->Images.size());
    for (const OMEChoice& image : this->Images)
    {
      names.push_back(image.name);
    }
    return names;
  }

  void readHeader(const std::string& fileName, VolumeHeader& header) override
  {
    this->Images.clear();
    this->Store = openZarrStore(fileName);
    this->Images = imagesOf(*this->Store);
    const OMEChoice choice = this->chosenImage();
    this->Image = readOMEImage(*this->Store, choice);
    this->Level = this->chosenLevel(header);
    const OMELevel& level = this->Image.levels[this->Level];
    header.dimensions = this->sizeOfLevel(this->Level);
    header.storedType = level.array.type.vtkType;
    header.components = static_cast<int>(this->channelsRead(this->Level));
    header.warnings.insert(
      header.warnings.end(), this->Image.warnings.begin(), this->Image.warnings.end());
    this->place(level, header);
    this->warnOfLevel(level, header);
    this->takeTimes(level, header);
    header.labels = this->Image.labels;
    header.isLabelMap = this->Image.isLabelMap;
    this->nameComponents(header);
    this->attach(fileName, choice, header);
  }

  // Without what a scale below 0 mirrors, which `load` asks for: it knows the box.
  double storedBytes(const VolumeHeader&) const override
  {
    const ZarrArray& array = this->Image.levels[this->Level].array;
    double chunks = 1.0;
    for (const int axis : this->Image.axes.space)
    {
      chunks *= std::ceil(static_cast<double>(at(array.shape, axis, 1)) /
        static_cast<double>(at(array.chunk, axis, 1)));
    }
    const double threads = std::max(1U, std::thread::hardware_concurrency());
    constexpr double PackedAndUnpacked = 2.0;
    return std::min(chunks, threads) * PackedAndUnpacked * static_cast<double>(array.chunkBytes());
  }

  void load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override
  {
    const ZarrArray& array = this->Image.levels[this->Level].array;
    const std::array<int, 6>& wanted = voxels.wanted;
    const std::int64_t components = this->channelsRead(this->Level);
    ZarrBox box;
    box.first.assign(array.shape.size(), 0);
    box.count.assign(array.shape.size(), 1);
    box.steps.assign(array.shape.size(), 0);
    const auto cut = [&box](int axis, std::int64_t first, std::int64_t count, std::int64_t step) {
      if (axis >= 0)
      {
        box.first[static_cast<std::size_t>(axis)] = first;
        box.count[static_cast<std::size_t>(axis)] = count;
        box.steps[static_cast<std::size_t>(axis)] = step;
      }
    };
    std::int64_t numbers = components;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int64_t count = std::int64_t(wanted[2 * i + 1]) - wanted[2 * i] + 1;
      cut(this->Image.axes.space[i], wanted[2 * i], count, numbers);
      numbers *= count;
    }
    cut(this->Image.axes.time, static_cast<std::int64_t>(volume), 1, 0);
    cut(this->Image.axes.channel, std::max(this->Pyramid.channel, 0), components, 1);
    if (this->isMirrored())
    {
      constexpr double readAndShown = 2.0;
      requireHostMemory("a part of it that its scale mirrors",
        readAndShown * static_cast<double>(numbers) * static_cast<double>(array.type.bytes));
    }
    auto stored =
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(array.type.vtkType));
    stored->SetNumberOfComponents(static_cast<int>(components));
    stored->SetNumberOfTuples(numbers / components);
    box.numbers = static_cast<char*>(stored->GetVoidPointer(0));
    std::vector<ZarrDamage> damages;
    if (readZarrBox(*this->Store, array, box, progress, &damages) &&
      this->replaceDamaged(damages, progress, voxels))
    {
      requireAsRead(*this->Store, array); // or chunks that are missing would count as empty
      voxels.image = vtkSmartPointer<vtkImageData>::New();
      voxels.image->SetExtent(const_cast<int*>(wanted.data()));
      voxels.image->GetPointData()->SetScalars(stored);
      voxels.mayBeShown = true;
    }
  }

private:
  std::unique_ptr<ZarrStore> Store;
  std::vector<OMEChoice> Images;
  OMEImage Image;
  std::size_t Level = 0;
  std::string Chosen;
  PyramidChoice Pyramid{ -1, 2048.0, -1 };

  bool isMirrored() const
  {
    const std::vector<double>& scale = this->Image.levels[this->Level].scale;
    const std::array<int, 3>& space = this->Image.axes.space;
    return std::any_of(
      space.begin(), space.end(), [&scale](int axis) { return at(scale, axis, 1.0) < 0.0; });
  }

  // Fills what could not be read. False: stopped.
  bool replaceDamaged(
    const std::vector<ZarrDamage>& damages, const Progress& progress, StoredVoxels& voxels) const
  {
    std::set<std::size_t> levels;
    std::set<std::string> reasons;
    for (const ZarrDamage& damage : damages)
    {
      if (!progress(1.0))
      {
        return false;
      }
      if (damage.isMissing && this->fillIfEmpty(damage))
      {
        continue;
      }
      levels.insert(fillFromCoarser(*this->Store, this->Image, this->Level, damage));
      reasons.insert(damage.reason);
    }
    if (!reasons.empty())
    {
      voxels.warning = "cannot be read everywhere at level " + std::to_string(this->Level) + ": " +
        *reasons.begin() +
        (reasons.size() > 1 ? ", the first of " + std::to_string(reasons.size()) + " chunks" : "") +
        this->replacedBy(levels);
    }
    return true;
  }

  // The end of a sentence on the levels that are shown in place of this one.
  std::string replacedBy(const std::set<std::size_t>& levels) const
  {
    std::string list;
    std::string places;
    for (const std::size_t level : levels)
    {
      list += (list.empty() ? "" : ", ") + std::to_string(level);
      const double shiftMm =
        this->shiftMm(this->Image.levels[level], this->Image.levels[this->Level]);
      if (shiftMm > 0.0)
      {
        places += "; level " + std::to_string(level) + " has no translation against level " +
          std::to_string(this->Level) + ": if it was made by averages, its voxels are up to " +
          roundedText(shiftMm) + " mm from their place";
      }
    }
    return "; voxels of level " + list + " are shown there" + places;
  }

  // Writers such as zarr-python leave out chunks of fill values, also when they copy a store. If
  // the bricks say that the chunk is one, fills it. False: it has other numbers, or none are known.
  bool fillIfEmpty(const ZarrDamage& damage) const
  {
    const OMELevel& level = this->Image.levels[this->Level];
    std::array<double, 2> range{ 0.0, 1.0 };
    const std::string problem = problemOf([&] {
      ZarrArray bricks = readZarrArray(*this->Store, level.bricks);
      bricks.hasAllChunks = true; // their fill value, NaN, is none that says that a chunk is empty
      ZarrBox box{ damage.part.first, std::vector<std::int64_t>(damage.part.first.size(), 1),
        reinterpret_cast<char*>(range.data()),
        std::vector<std::int64_t>(damage.part.first.size(), 0) };
      box.first.push_back(0);
      box.count.push_back(2);
      box.steps.push_back(1);
      bool isInside = bricks.type.vtkType == VTK_DOUBLE && bricks.shape.size() == box.first.size();
      for (std::size_t axis = 0; isInside && axis < box.first.size(); ++axis)
      {
        box.first[axis] /= axis < level.array.chunk.size() ? level.array.chunk[axis] : 1;
        isInside = box.first[axis] + box.count[axis] <= bricks.shape[axis];
      }
      throwIfAny(isInside ? "" : "has other bricks");
      readZarrBox(*this->Store, bricks, box, [](double) { return true; });
    });
    if (!problem.empty() || range != std::array<double, 2>{ 0.0, 0.0 } ||
      level.array.fill.find_first_not_of('\0') != std::string::npos)
    {
      return false;
    }
    ZarrArray array = level.array;
    array.hasAllChunks = false;
    return readZarrBox(*this->Store, array, damage.part, [](double) { return true; });
  }

  // By how many mm a level may be misplaced that has no translation against a finer one; 0: it has.
  double shiftMm(const OMELevel& level, const OMELevel& finer) const
  {
    double mostMm = 0.0;
    for (const int axis : this->Image.axes.space)
    {
      const double step =
        std::abs(at(level.scale, axis, 1.0)) - std::abs(at(finer.scale, axis, 1.0));
      if (at(level.translation, axis, 0.0) == at(finer.translation, axis, 0.0) && step > 0.0)
      {
        mostMm = std::max(mostMm, 0.5 * step * at(this->Image.axes.units, axis, 1.0));
      }
    }
    return mostMm;
  }

  OMEChoice chosenImage() const
  {
    const auto found = std::find_if(this->Images.begin(), this->Images.end(),
      [this](const OMEChoice& image) { return image.name == this->Chosen; });
    if (found == this->Images.end() && !this->Chosen.empty())
    {
      std::string names;
      for (const std::string& name : this->choices())
      {
        names += (names.empty() ? "" : ", ") + shownWords(name);
      }
      throw Problem("has no image '" + shownWords(this->Chosen) + "'; it has " + names +
        "; choose one of them as Image");
    }
    return this->Chosen.empty() ? this->Images.front() : *found;
  }

  glm::ivec3 sizeOfLevel(std::size_t level) const
  {
    glm::ivec3 size(1);
    for (int i = 0; i < 3; ++i)
    {
      size[i] = static_cast<int>(at(this->Image.levels[level].array.shape,
        this->Image.axes.space[static_cast<std::size_t>(i)], 1));
    }
    return size;
  }

  std::int64_t channelsRead(std::size_t level) const
  {
    const ZarrArray& array = this->Image.levels[level].array;
    const std::int64_t channels = at(array.shape, this->Image.axes.channel, 1);
    if (this->Pyramid.channel >= channels)
    {
      throw Problem("has the channels 0 to " + std::to_string(channels - 1) + "; Channel is " +
        std::to_string(this->Pyramid.channel) + "; choose one of them");
    }
    if (this->Pyramid.channel < 0 && channels > MostChannels)
    {
      throw Problem("has " + std::to_string(channels) + " channels, of which up to " +
        std::to_string(MostChannels) + " are read as components; choose one by Channel");
    }
    return this->Pyramid.channel < 0 ? channels : 1;
  }

  // Of one time step.
  double bytesOf(std::size_t level) const
  {
    const glm::dvec3 size(this->sizeOfLevel(level));
    return size.x * size.y * size.z * static_cast<double>(this->channelsRead(level)) *
      static_cast<double>(this->Image.levels[level].array.type.bytes);
  }

  // The level that is read; the header says why.
  std::size_t chosenLevel(VolumeHeader& header) const
  {
    const std::size_t count = this->Image.levels.size();
    if (this->Pyramid.level >= static_cast<int>(count))
    {
      throw Problem("has the levels 0 to " + std::to_string(count - 1) + "; Level is " +
        std::to_string(this->Pyramid.level) + "; choose one of them");
    }
    const double limit = this->Pyramid.limitMiB * BytesInMiB;
    std::size_t finest = 0;
    std::size_t coarsest = 0;
    std::size_t fitting = count;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double bytes = this->bytesOf(i);
      finest = bytes > this->bytesOf(finest) ? i : finest;
      coarsest = bytes < this->bytesOf(coarsest) ? i : coarsest;
      if (bytes <= limit && (fitting == count || bytes > this->bytesOf(fitting)))
      {
        fitting = i;
      }
    }
    const bool isAsked = this->Pyramid.level >= 0;
    const std::size_t level = isAsked ? static_cast<std::size_t>(this->Pyramid.level)
      : fitting < count               ? fitting
                                      : coarsest;
    const std::string over = sizeOf(this->bytesOf(finest)) + ", above the MemoryLimit of " +
      joined(this->Pyramid.limitMiB, " MiB");
    header.note = "Level " + std::to_string(level) + " of " + std::to_string(count) + ", " +
      sizeText(glm::dvec3(this->sizeOfLevel(level))) + " voxels, " + sizeOf(this->bytesOf(level)) +
      (isAsked                                 ? ", as the property Level says"
          : level == finest && fitting < count ? ": the finest"
          : fitting < count
          ? ": the finest that fits; level " + std::to_string(finest) + " has " + over
          : ": the coarsest; even it is above the MemoryLimit of " +
            joined(this->Pyramid.limitMiB, " MiB"));
    return level;
  }

  void place(const OMELevel& level, VolumeHeader& header) const
  {
    header.worldFromVoxel = glm::dmat4(1.0);
    for (int i = 0; i < 3; ++i)
    {
      const int axis = this->Image.axes.space[static_cast<std::size_t>(i)];
      const double unit = at(this->Image.axes.units, axis, 1.0);
      header.worldFromVoxel[i][i] = at(level.scale, axis, 1.0) * unit;
      header.worldFromVoxel[3][i] = at(level.translation, axis, 0.0) * unit;
    }
    if (this->Image.axes.space[2] < 0)
    {
      header.warnings.emplace_back("has no axis z; it is shown as one slice of 1 mm");
    }
    if (this->Image.direction != glm::dmat3(1.0))
    {
      this->turn(header.worldFromVoxel);
    }
    header.worldFromVoxel = glm::dmat4(this->Image.rasFromAxes) * header.worldFromVoxel;
    header.knowsSides = this->Image.knowsSides;
    if (!header.knowsSides)
    {
      header.warnings.emplace_back(UnknownSidesWarning);
    }
  }

  // Turns all levels about the middle of the first voxel of the finest.
  void turn(glm::dmat4& worldFromVoxel) const
  {
    const OMELevel& finest = this->Image.levels.front();
    glm::dvec3 fixed;
    for (int i = 0; i < 3; ++i)
    {
      const int axis = this->Image.axes.space[static_cast<std::size_t>(i)];
      fixed[i] = at(finest.translation, axis, 0.0) * at(this->Image.axes.units, axis, 1.0);
      worldFromVoxel[i] = glm::dvec4(this->Image.direction[i] * worldFromVoxel[i][i], 0.0);
    }
    const glm::dvec3 away = glm::dvec3(worldFromVoxel[3]) - fixed;
    worldFromVoxel[3] = glm::dvec4(fixed + this->Image.direction * away, 1.0);
  }

  // What may be wrong with a level without a fault in its metadata.
  void warnOfLevel(const OMELevel& level, VolumeHeader& header) const
  {
    const std::string missing =
      level.array.hasAllChunks ? std::string() : missingChunk(*this->Store, level.array);
    if (!missing.empty())
    {
      header.warnings.push_back("seems to have no chunk of level " + std::to_string(this->Level) +
        ", such as '" + missing + "'; where one is missing, the fill value is shown");
    }
    const double mostMm = this->shiftMm(level, this->Image.levels.front());
    if (mostMm > 0.0)
    {
      header.warnings.push_back("has no translation of level " + std::to_string(this->Level) +
        " against the finest; if it was made by averages, it is shown up to " +
        roundedText(mostMm) + " mm from its place; level 0 is where it belongs");
    }
  }

  void takeTimes(const OMELevel& level, VolumeHeader& header) const
  {
    const std::int64_t count = at(level.array.shape, this->Image.axes.time, 1);
    if (count > MostTimes)
    {
      throw Problem("has " + std::to_string(count) + " time steps; it may have up to " +
        std::to_string(MostTimes));
    }
    const double unit = at(this->Image.axes.units, this->Image.axes.time, 1.0);
    const double step = at(level.scale, this->Image.axes.time, 1.0) * unit;
    header.times = evenTimes(static_cast<std::size_t>(count), step,
      at(level.translation, this->Image.axes.time, 0.0) * unit);
    if (count > 1 && !(std::isfinite(step) && step > 0.0))
    {
      header.warnings.push_back(
        joined("has ", step, " s between time steps, which is no time; they count as 1 s apart"));
    }
  }

  void nameComponents(VolumeHeader& header) const
  {
    const std::size_t first = static_cast<std::size_t>(std::max(this->Pyramid.channel, 0));
    for (std::size_t i = 0; i < static_cast<std::size_t>(header.components); ++i)
    {
      const bool isNamed = first + i < this->Image.channels.size();
      header.componentNames.push_back(isNamed ? this->Image.channels[first + i] : std::string());
    }
  }

  // What later filters need to find more of the store.
  void attach(const std::string& fileName, const OMEChoice& choice, VolumeHeader& header) const
  {
    const auto text = [&header](const char* name, const std::string& value) {
      vtkNew<vtkStringArray> array;
      array->SetName(name);
      array->InsertNextValue(value);
      header.attached.emplace_back(array.Get());
    };
    text("OMEZarrStore", fileName);
    text("OMEZarrImage", choice.name);
    vtkNew<vtkIntArray> level;
    level->SetName(LevelArray);
    level->InsertNextValue(static_cast<int>(this->Level));
    header.attached.emplace_back(level.Get());
    vtkNew<vtkTypeInt64Array> chunk;
    chunk->SetName(ChunkArray);
    for (const int axis : this->Image.axes.space)
    {
      chunk->InsertNextValue(at(this->Image.levels[this->Level].array.chunk, axis, 1));
    }
    header.attached.emplace_back(chunk.Get());
    vtkNew<vtkTypeInt64Array> sizes;
    sizes->SetName("OMEZarrLevelSizes");
    sizes->SetNumberOfComponents(3);
    for (std::size_t i = 0; i < this->Image.levels.size(); ++i)
    {
      const glm::ivec3 size = this->sizeOfLevel(i);
      sizes->InsertNextTuple3(size.x, size.y, size.z);
    }
    header.attached.emplace_back(sizes.Get());
  }
};
}

extern const VolumeFormat VolumesOfOMEZarr{ "OMEZarr", isZarrStore, makeVolumeFile<OMEZarrVolume> };
}
