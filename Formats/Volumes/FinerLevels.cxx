// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Volumes/FinerLevels.h"

#include "Common/ImageGrid.h"
#include "Common/Problem.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkWeakPointer.h"

#include <algorithm>

namespace brainshift
{
namespace
{
struct Remembered
{
  vtkWeakPointer<vtkDataArray> numbers;
  LevelSource source;
};

// Of a field array that the header may have; 0: it has none.
int largestOf(const VolumeHeader& header, const char* name)
{
  double largest = 0.0;
  for (vtkAbstractArray* attached : header.attached)
  {
    auto array = vtkDataArray::SafeDownCast(attached);
    const bool isIt = array && array->GetName() && std::string(name) == array->GetName();
    for (vtkIdType i = 0; isIt && i < array->GetNumberOfTuples(); ++i)
    {
      largest = std::max(largest, array->GetComponent(i, 0));
    }
  }
  return static_cast<int>(largest);
}

// Of the main thread, as all VTK pipelines.
std::vector<Remembered>& allRemembered()
{
  static std::vector<Remembered> all;
  return all;
}
}

bool LevelSource::operator==(const LevelSource& other) const
{
  return this->format == other.format && this->fileName == other.fileName &&
    this->choice == other.choice && this->level == other.level && this->channel == other.channel &&
    this->volume == other.volume && this->worldFromFile == other.worldFromFile &&
    this->grid == other.grid && this->type == other.type && this->components == other.components &&
    this->time == other.time;
}

void rememberLevels(vtkImageData* image, LevelSource source, const VolumeHeader& header)
{
  vtkDataArray* numbers = image->GetPointData()->GetScalars();
  source.grid = gridOf(image);
  source.type = numbers->GetDataType();
  source.components = numbers->GetNumberOfComponents();
  source.time = numbers->GetMTime();
  source.level = largestOf(header, LevelArray);
  std::vector<Remembered>& all = allRemembered();
  all.erase(std::remove_if(all.begin(), all.end(),
              [&](const Remembered& one) { return !one.numbers || one.numbers == numbers; }),
    all.end());
  if (source.level > 0)
  {
    all.push_back({ numbers, source });
  }
}

// Filters that hand on an array share its memory.
std::optional<LevelSource> finerLevelsOf(vtkDataArray* numbers)
{
  for (const Remembered& one : allRemembered())
  {
    if (one.numbers && one.source.time == one.numbers->GetMTime() &&
      numbers->HasStandardMemoryLayout() && numbers->GetDataType() == one.numbers->GetDataType() &&
      numbers->GetNumberOfValues() == one.numbers->GetNumberOfValues() &&
      numbers->GetVoidPointer(0) == one.numbers->GetVoidPointer(0))
    {
      return one.source;
    }
  }
  return std::nullopt;
}

FinerLevels::FinerLevels(const LevelSource& source)
  : Volume(source.volume)
{
  for (int level = 0; level < source.level; ++level)
  {
    std::unique_ptr<VolumeFile> file = source.format->make();
    file->choose(source.choice);
    file->setPyramid({ level, 0.0, source.channel });
    this->Levels.push_back(std::make_unique<PlacedVolume>(std::move(file)));
    this->Levels.back()->setPlacement(source.worldFromFile);
    this->Levels.back()->readHeader(source.fileName);
    const PlacedVolume& read = *this->Levels.back();
    if (read.scalarType() != source.type || read.header().components != source.components)
    {
      throw Problem("Level " + std::to_string(level) + " of " + source.fileName +
        " has other numbers than the level that is drawn, of another type or with other "
        "components; no finer voxels are drawn. Set Level of the reader to read it");
    }
    this->Grids.push_back(this->Levels.back()->geometry().grid);
  }
}

FinerLevels::~FinerLevels() = default;

int FinerLevels::blockSide(std::size_t level) const
{
  constexpr int LeastSide = 32;
  constexpr int MostSide = 256;
  return std::clamp(largestOf(this->Levels[level]->header(), ChunkArray), LeastSide, MostSide);
}

vtkSmartPointer<vtkDataArray> FinerLevels::read(
  std::size_t level, const int extent[6], const Progress& progress, std::string& damage)
{
  PlacedVolume& volume = *this->Levels[level];
  vtkNew<vtkImageData> image;
  volume.read(this->Volume, extent, progress, image);
  damage = volume.damage();
  return image->GetPointData()->GetScalars();
}
}
