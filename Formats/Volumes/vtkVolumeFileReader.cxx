// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVolumeFileReader.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/ImageParts.h"
#include "Common/RankAgreement.h"
#include "Common/SharedArray.h"
#include "Common/WorldAxes.h"
#include "Formats/Volumes/FinerLevels.h"
#include "Formats/Volumes/WriterAtWork.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
const brainshift::VolumeFormat* formatNamed(const std::string& name)
{
  for (const brainshift::VolumeFormat* format : brainshift::volumeFormats())
  {
    if (name == format->name)
    {
      return format;
    }
  }
  return nullptr;
}

// The first format, or the only one that is allowed, whose file this is. Null: none.
const brainshift::VolumeFormat* formatOf(const std::string& fileName, const std::string& allowed)
{
  for (const brainshift::VolumeFormat* format : brainshift::volumeFormats())
  {
    if ((allowed.empty() || allowed == format->name) && format->isOne(fileName))
    {
      return format;
    }
  }
  return nullptr;
}

std::string formatNames()
{
  std::string names;
  for (const brainshift::VolumeFormat* format : brainshift::volumeFormats())
  {
    names.append(names.empty() ? "" : ", ").append(format->name);
  }
  return names;
}

std::size_t nearestIndex(const std::vector<double>& times, double time)
{
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
  {
    if (std::abs(times[i] - time) < std::abs(times[nearest] - time))
    {
      nearest = i;
    }
  }
  return nearest;
}

glm::dmat4 affineOfRows(const double rows[16])
{
  glm::dmat4 affine;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      affine[column][row] = rows[4 * row + column];
    }
  }
  if (rows[12] != 0.0 || rows[13] != 0.0 || rows[14] != 0.0 || rows[15] != 1.0)
  {
    throw brainshift::Problem("WorldFromFile has another last row than 0 0 0 1; it must be affine");
  }
  return affine;
}

// What the header says beside where the voxels lie.
void attachFacts(
  const brainshift::VolumeHeader& header, const std::string& array, vtkImageData* volume)
{
  vtkDataArray* const scalars = volume->GetPointData()->GetScalars();
  scalars->SetName(array.empty() ? brainshift::ScalarsOfVolumes : array.c_str());
  for (std::size_t i = 0; i < header.componentNames.size(); ++i)
  {
    scalars->SetComponentName(static_cast<vtkIdType>(i), header.componentNames[i].c_str());
  }
  for (vtkAbstractArray* array : header.attached)
  {
    volume->GetFieldData()->AddArray(array);
  }
  brainshift::attachLabels(volume, header.labels);
  brainshift::markLabelMap(volume, header.isLabelMap);
  brainshift::nameWorldAxes(
    volume, header.knowsSides ? brainshift::WorldAxes::RAS : brainshift::WorldAxes::Unknown);
  brainshift::nameTemplate(volume, header.space);
}

void announceTimes(vtkInformation* output, const std::vector<double>& times)
{
  output->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  output->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  if (times.size() > 1)
  {
    const double range[2] = { times.front(), times.back() };
    output->Set(
      vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  }
}

// The unit of the numbers, and whether small ones are bright.
void attachMeaning(vtkImageData* image, const brainshift::VolumeHeader& header)
{
  if (!header.unit.empty())
  {
    vtkNew<vtkStringArray> word;
    word->SetName("Unit");
    word->InsertNextValue(header.unit);
    image->GetFieldData()->AddArray(word);
  }
  if (header.smallIsBright)
  {
    vtkNew<vtkUnsignedCharArray> mark;
    mark->SetName("SmallIsBright");
    mark->InsertNextValue(1);
    image->GetFieldData()->AddArray(mark);
  }
}
}

vtkStandardNewMacro(vtkVolumeFileReader);
brainshiftGuardRequestsMacro(vtkVolumeFileReader);

vtkVolumeFileReader::vtkVolumeFileReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkVolumeFileReader::~vtkVolumeFileReader()
{
  this->SetFileName(nullptr);
}

void vtkVolumeFileReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Format: " << this->Format << "\n";
  os << indent << "Choice: " << this->Choice << "\n";
  os << indent << "ResampleSlices: " << this->ResampleSlices << "\n";
  os << indent << "Luminance: " << this->Luminance << "\n";
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "Level: " << this->Level << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "WorldFromFile:";
  for (const double number : this->WorldFromFile)
  {
    os << " " << number;
  }
  os << "\n" << indent << "Channel: " << this->Channel << "\n";
}

void vtkVolumeFileReader::SetFormat(const char* name)
{
  const std::string format = name ? name : "";
  if (format != this->Format)
  {
    this->Format = format;
    this->Modified();
  }
}

void vtkVolumeFileReader::SetChoice(const char* name)
{
  const std::string choice = name ? name : "";
  if (choice == this->Choice)
  {
    return;
  }
  // ParaView writes the name of what is shown into the property. Nothing need be read again then.
  const std::vector<std::string> names =
    this->File ? this->File->choices() : std::vector<std::string>();
  const bool isShown = this->Choice.empty() && !names.empty() && names.front() == choice;
  this->Choice = choice;
  if (this->File)
  {
    this->File->choose(choice);
  }
  if (!isShown)
  {
    this->Modified();
  }
}

vtkStringArray* vtkVolumeFileReader::GetChoiceList()
{
  this->ChoiceList->Initialize();
  for (const std::string& name : this->File ? this->File->choices() : std::vector<std::string>())
  {
    this->ChoiceList->InsertNextValue(name);
  }
  return this->ChoiceList;
}

void vtkVolumeFileReader::SetResampleSlices(int resample)
{
  resample = std::clamp(resample, 0, 2);
  if (resample != this->ResampleSlices)
  {
    this->ResampleSlices = resample;
    this->Modified();
  }
}

void vtkVolumeFileReader::SetLuminance(bool luminance)
{
  if (luminance != this->Luminance)
  {
    this->Luminance = luminance;
    this->Modified();
  }
}

void vtkVolumeFileReader::SetArrayName(const char* name)
{
  const std::string array = name ? name : "";
  if (array != this->ArrayName)
  {
    this->ArrayName = array;
    this->Modified();
  }
}

void vtkVolumeFileReader::SetLevel(int level)
{
  level = std::max(level, -1);
  if (level != this->Level)
  {
    this->Level = level;
    this->Modified();
  }
}

void vtkVolumeFileReader::SetMemoryLimit(double mebibytes)
{
  mebibytes = mebibytes > 0.0 ? mebibytes : 0.0; // also of NaN
  if (mebibytes != this->MemoryLimit)
  {
    this->MemoryLimit = mebibytes;
    this->Modified();
  }
}

void vtkVolumeFileReader::SetChannel(int channel)
{
  channel = std::max(channel, -1);
  if (channel != this->Channel)
  {
    this->Channel = channel;
    this->Modified();
  }
}

std::string vtkVolumeFileReader::GetNote() const
{
  return this->Stored && this->Stored->isPlaced() ? this->Stored->header().note : std::string();
}

std::string vtkVolumeFileReader::GetShownFile() const
{
  return this->File ? this->File->firstFile() : std::string();
}

int vtkVolumeFileReader::CanReadFile(const char* fileName)
{
  return fileName && formatOf(fileName, this->Format) ? 1 : 0;
}

void vtkVolumeFileReader::takeFormat()
{
  const std::string fileName = this->FileName ? this->FileName : "";
  // A file that is damaged at its very beginning still gets the sentence of the format that was
  // chosen for it.
  const brainshift::VolumeFormat* format =
    this->Format.empty() ? formatOf(fileName, this->Format) : formatNamed(this->Format);
  if (!format && !this->Format.empty())
  {
    throw brainshift::Problem("Format is '" + this->Format + "'; it must be one of " +
      formatNames() + ", or empty to take that of the file");
  }
  if (!format)
  {
    throw brainshift::Problem("File " + fileName +
      " is no volume of a format that BrainShift reads: " + formatNames() +
      "; convert it to .nii.gz or .nrrd in a program that opens it");
  }
  if (format != this->Taken)
  {
    std::unique_ptr<brainshift::VolumeFile> file = format->make();
    this->File = file.get();
    this->Stored = std::make_unique<brainshift::PlacedVolume>(std::move(file));
    this->Taken = format;
    this->File->setScanProgress([this](double fraction) {
      this->UpdateProgress(fraction);
      return !this->GetAbortExecute();
    });
  }
  this->Stored->setPlacement(affineOfRows(this->WorldFromFile));
  this->File->choose(this->Choice);
  this->File->setLuminance(this->Luminance);
  this->File->setPyramid({ this->Level, this->MemoryLimit, this->Channel });
  this->File->setResampling(static_cast<brainshift::SliceResampling>(this->ResampleSlices));
}

void vtkVolumeFileReader::announceLast(vtkInformation* output)
{
  vtkImageData* image = this->Last.image;
  output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Last.wholeExtent, 6);
  output->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), this->Last.wholeExtent, 6);
  announceTimes(output, this->Last.times);
  if (image)
  {
    output->Set(vtkDataObject::SPACING(), image->GetSpacing(), 3);
    output->Set(vtkDataObject::ORIGIN(), image->GetOrigin(), 3);
    output->Set(vtkDataObject::DIRECTION(), image->GetDirectionMatrix()->GetData(), 9);
    vtkDataObject::SetPointDataActiveScalarInfo(
      output, image->GetScalarType(), image->GetNumberOfScalarComponents());
  }
}

void vtkVolumeFileReader::rememberLast(vtkInformation* output)
{
  this->Last.image = vtkSmartPointer<vtkImageData>::New();
  this->Last.image->ShallowCopy(vtkImageData::GetData(output));
  output->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Last.wholeExtent);
  this->Last.times = this->Stored->header().times;
  this->Last.isOfHeader = true;
}

void vtkVolumeFileReader::keepLast(vtkInformation* output)
{
  this->announceLast(output);
  vtkImageData* shown = vtkImageData::GetData(output);
  shown->Initialize();
  if (this->Last.image)
  {
    shown->ShallowCopy(this->Last.image);
  }
  if (output->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    // The step counts as read: it must not be read again at the next picture.
    shown->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(),
      output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()));
  }
}

void vtkVolumeFileReader::reading(const std::function<void()>& read)
{
  struct Scope
  {
    bool& isReading;
    ~Scope() { this->isReading = false; }
  };
  this->IsReading = true;
  const Scope scope{ this->IsReading };
  read();
}

int vtkVolumeFileReader::keepingProblem(const std::function<int()>& step)
{
  try
  {
    const int result = step();
    this->Problem = result ? std::string() : this->Problem;
    return result;
  }
  catch (...)
  {
    this->Problem = brainshift::thrownSentence(this->GetClassName());
    throw;
  }
}

int vtkVolumeFileReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return this->keepingProblem([&] { return this->readHeader(outputs->GetInformationObject(0)); });
}

int vtkVolumeFileReader::readHeader(vtkInformation* output)
{
  try
  {
    this->takeFormat();
  }
  catch (...)
  {
    this->Stored.reset();
    this->File = nullptr;
    this->Taken = nullptr;
    throw;
  }
  const std::string problem = brainshift::problemOf([this] {
    this->reading([this] { this->Stored->readHeader(this->FileName ? this->FileName : ""); });
  });
  this->Last.isOfHeader = false;
  this->Warned.clear();
  this->IsStopped = !problem.empty() && this->GetAbortExecute();
  if (this->IsStopped)
  {
    this->announceLast(output);
    return 1; // RequestData says the rest
  }
  brainshift::throwIfAny(problem);
  // Every MPI rank reads the same header.
  const bool speaks = brainshift::isFirstRank();
  for (const std::string& warning : speaks ? this->Stored->warnings() : std::vector<std::string>())
  {
    brainshift::warn(this, warning);
  }
  brainshift::announce(output, this->Stored->geometry().grid);
  output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  brainshift::announceReadingAll(output, !this->File->readsNothingElse());
  vtkDataObject::SetPointDataActiveScalarInfo(
    output, this->Stored->scalarType(), this->Stored->header().components);
  announceTimes(output, this->Stored->header().times);
  return 1;
}

int vtkVolumeFileReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* information = outputs->GetInformationObject(0);
  if (!this->IsStopped)
  {
    const int result = this->keepingProblem([&] { return this->readVolume(information); });
    if (!this->GetAbortExecute())
    {
      return result;
    }
    this->IsStopped = !this->Last.isOfHeader;
  }
  this->keepLast(information);
  if (this->GetAbortExecute())
  {
    // Nobody else takes the request back, and SetAbortExecute would have all read again.
    this->AbortExecute = 0;
    brainshift::warn(this,
      std::string("Reading ") + (this->FileName ? this->FileName : "") + " was stopped. " +
        (this->Last.image ? "What was read before" : "Nothing") +
        " is shown. Change a property or reload the file to read it");
  }
  return 1;
}

// Of a large file whose parts cannot be found, several MPI ranks read or unpack all, and more ranks
// make it no faster. The first one says so for all, for each of them asks for a part.
void vtkVolumeFileReader::warnOfRanks(vtkInformation* information)
{
  constexpr double FewBytes = 256.0 * 1048576.0; // unpacked in a second or two
  const brainshift::Extent whole = brainshift::wholeExtentOf(information);
  const brainshift::VolumeHeader& header = this->Stored->header();
  const double bytes = brainshift::pointsIn(whole) * header.components *
    static_cast<double>(header.times.size()) * vtkDataArray::GetDataTypeSize(header.storedType);
  vtkMultiProcessController* ranks = brainshift::severalRanks();
  if (!ranks || !brainshift::isFirstRank() || this->File->readsNothingElse() || bytes <= FewBytes ||
    brainshift::updateExtentOf(information) == whole)
  {
    return;
  }
  const std::string sentence = std::string(this->FileName) + ": each of " +
    std::to_string(ranks->GetNumberOfProcesses()) + " MPI ranks " +
    (this->File->loads() == brainshift::Loads::All
        ? "reads the whole file and keeps its part"
        : "unpacks the file from its beginning to the end of its part") +
    ". Save it as an uncompressed NIfTI file or as an OME-Zarr image: each rank then reads its "
    "part alone";
  if (this->Warned.insert(sentence).second)
  {
    brainshift::warn(this, sentence);
  }
}

int vtkVolumeFileReader::readVolume(vtkInformation* information)
{
  // ParaView asks for data even after RequestInformation failed; that has been reported.
  if (!this->Stored || !this->Stored->isPlaced())
  {
    return 0;
  }
  vtkImageData* shown = vtkImageData::GetData(information);
  shown->Initialize(); // the pipeline leaves the old numbers in it
  const std::vector<double>& times = this->Stored->header().times;
  std::size_t volume = 0;
  if (times.size() > 1 && information->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    volume =
      nearestIndex(times, information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()));
    shown->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), times[volume]);
  }
  bool isWanted = true;
  const auto progress = [this, &isWanted](double fraction) {
    this->UpdateProgress(fraction);
    isWanted = isWanted && brainshift::WriterAtWork::goesOn();
    return isWanted && !this->GetAbortExecute();
  };
  this->warnOfRanks(information);
  this->reading([&] {
    this->Stored->read(
      volume, information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()), progress, shown);
  });
  if (!shown->GetPointData()->GetScalars())
  {
    return isWanted ? 0 : 1; // stopped; without points, it is read when it is asked for again
  }
  if (!this->Stored->damage().empty() && this->Warned.insert(this->Stored->damage()).second)
  {
    brainshift::warn(this, this->Stored->damage());
  }
  attachMeaning(shown, this->Stored->header());
  attachFacts(this->Stored->header(), this->ArrayName, shown);
  brainshift::SharedArrays().share(shown->GetPointData());
  brainshift::rememberLevels(shown,
    { this->Taken, this->FileName, this->Choice, 0, this->Channel, volume,
      affineOfRows(this->WorldFromFile) },
    this->Stored->header());
  this->rememberLast(information);
  return 1;
}
