// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOMEZarrWriter.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/ImageParts.h"
#include "Formats/Files/Text.h"
#include "Formats/OMEZarr/PyramidStore.h"
#include "Formats/Volumes/OutgoingVolume.h"
#include "Formats/Volumes/WriterAtWork.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

using namespace brainshift;

namespace
{
using SDDP = vtkStreamingDemandDrivenPipeline;

constexpr double BytesInMiB = 1048576.0;
constexpr double FractionOfFinest = 0.85; // of the time

struct Piece
{
  std::array<int, 6> extent;

  Size3 first() const { return { this->extent[0], this->extent[2], this->extent[4] }; }
  Size3 size() const
  {
    return Size3(this->extent[1], this->extent[3], this->extent[5]) - this->first() +
      std::int64_t(1);
  }
};

// Voxels along an axis that a piece may have: whole chunks.
int depthOf(double bytesOfLayer, double limit)
{
  const int chunks = static_cast<int>(std::min(limit / (bytesOfLayer * double(PyramidChunk)), 1e6));
  return static_cast<int>(PyramidChunk) * std::max(1, chunks);
}

// Slabs along z; where one of a chunk's depth is too large, bars along y.
std::vector<Piece> piecesOf(const int whole[6], double bytesOfVoxel, double limit)
{
  const double row = bytesOfVoxel * (whole[1] - whole[0] + 1.0);
  const double slice = row * (whole[3] - whole[2] + 1.0);
  const int depth = depthOf(slice, limit);
  const int step = slice * double(PyramidChunk) > limit ? depthOf(row * double(PyramidChunk), limit)
                                                        : whole[3] - whole[2] + 1;
  std::vector<Piece> pieces;
  for (std::int64_t z = whole[4]; z <= whole[5]; z += depth)
  {
    for (std::int64_t y = whole[2]; y <= whole[3]; y += step)
    {
      pieces.push_back({ { whole[0], whole[1], static_cast<int>(y),
        static_cast<int>(std::min<std::int64_t>(y + step - 1, whole[3])), static_cast<int>(z),
        static_cast<int>(std::min<std::int64_t>(z + depth - 1, whole[5])) } });
    }
  }
  return pieces;
}

// The numbers of a piece in an image that may have more.
VoxelBox boxOf(vtkImageData* image, const OutgoingVolume& volume, const Piece& piece)
{
  const Extent extent = extentOf(image);
  const Size3 has(extent[1] - extent[0] + 1, extent[3] - extent[2] + 1, extent[5] - extent[4] + 1);
  const std::int64_t components = volume.components();
  VoxelBox box;
  box.size = piece.size();
  box.steps = { components, components * has.x, components * has.x * has.y };
  const Size3 away = piece.first() - Size3(extent[0], extent[2], extent[4]);
  box.first = volume.bytes() +
    (away.x * box.steps.x + away.y * box.steps.y + away.z * box.steps.z) * volume.type.bytes;
  return box;
}
}

struct vtkOMEZarrWriter::Run
{
  std::array<int, 6> whole{};
  std::vector<Piece> pieces;
  std::size_t next = 0;
  std::unique_ptr<PyramidStore> store;
  std::string warning;
};

vtkStandardNewMacro(vtkOMEZarrWriter);
brainshiftGuardRequestsMacro(vtkOMEZarrWriter);

vtkOMEZarrWriter::vtkOMEZarrWriter() = default;
vtkOMEZarrWriter::~vtkOMEZarrWriter() = default;

int vtkOMEZarrWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkOMEZarrWriter::Write()
{
  const WriterAtWork work(this);
  this->Work.reset();
  this->PiecesKept = 0;
  const std::string failed = "Store " + this->FileName +
    " was not begun: the input gave no voxels. It failed, or it was stopped";
  this->Problem = failed; // until a piece comes
  this->HasEnded = false;
  const int result = this->Superclass::Write();
  while (!this->HasEnded) // the input failed on this rank
  {
    this->FirstRankGoes(false);
  }
  if (this->Problem == failed)
  {
    vtkErrorMacro(<< failed << ".");
  }
  if (!this->Problem.empty())
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    return 0;
  }
  return result;
}

int vtkOMEZarrWriter::ModifyRequest(vtkInformation* request, int when)
{
  if (when == vtkExecutive::BeforeForward && request->Has(SDDP::REQUEST_UPDATE_EXTENT()))
  {
    guarded(this, [this] { this->AskForFirstPiece(); });
  }
  return this->Superclass::ModifyRequest(request, when);
}

void vtkOMEZarrWriter::AskForFirstPiece()
{
  vtkInformation* input = this->GetInputInformation(0, 0);
  if (!input || !input->Has(SDDP::WHOLE_EXTENT()))
  {
    return;
  }
  this->Work = std::make_unique<Run>();
  input->Get(SDDP::WHOLE_EXTENT(), this->Work->whole.data());
  this->Work->pieces =
    piecesOf(this->Work->whole.data(), bytesOfPoint(input), this->MemoryLimit * BytesInMiB);
  if (!this->Work->pieces.empty())
  {
    input->Set(SDDP::UPDATE_EXTENT(), this->Work->pieces.front().extent.data(), 6);
  }
}

// If the pipeline were told to go on by itself, it would do so for ever once the input is stopped.
int vtkOMEZarrWriter::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  bool goesOn = true;
  while (goesOn)
  {
    goesOn = false;
    const std::string problem = sentenceThrownBy(
      "Store " + this->FileName + " cannot be written:", [&] { goesOn = this->TakePiece(); });
    this->Problem = isFirstRank() ? problem : std::string(); // the others only bring their parts
    goesOn = this->FirstRankGoes(goesOn);
  }
  this->Work.reset();
  if (!this->Problem.empty())
  {
    vtkErrorMacro(<< this->Problem << ".");
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
  return 1;
}

// Whether there is a piece more.
bool vtkOMEZarrWriter::TakePiece()
{
  auto* image = vtkImageData::SafeDownCast(this->GetInput());
  if (!this->Work || this->Work->pieces.empty() || !image)
  {
    throw brainshift::Problem("The input has no voxels");
  }
  const std::size_t number = this->Work->next++;
  const bool isLast = this->Work->next == this->Work->pieces.size();
  const Piece& piece = this->Work->pieces[number];
  const std::string lacking = problemOf([&] {
    number == 0 ? requirePart(image, piece.extent)
                : bringPart(this->GetInputInformation(0, 0), piece.extent);
  });
  this->RequireGoing(!this->CheckAbort());
  throwIfAny(lacking);
  if (!isFirstRank())
  {
    return !isLast;
  }
  OutgoingVolume volume;
  this->TakeVoxels(volume);
  const VoxelBox box = boxOf(image, volume, piece);
  if (!this->Work->store)
  {
    this->Begin(volume);
  }
  const int* whole = this->Work->whole.data();
  const PyramidPiece part{ piece.first() - Size3(whole[0], whole[2], whole[4]), box };
  const double pieces = static_cast<double>(this->Work->pieces.size());
  const double done = static_cast<double>(number) / pieces;
  const std::size_t written = this->Work->store->chunksWritten();
  this->RequireGoing(this->Work->store->write(part,
    [&](double fraction) { return this->Go(FractionOfFinest * (done + fraction / pieces)); }));
  this->PiecesKept += this->Work->store->chunksWritten() == written ? 1 : 0;
  if (!isLast)
  {
    return true;
  }
  this->RequireGoing(this->Work->store->finish([this](double fraction) {
    return this->Go(FractionOfFinest + (1.0 - FractionOfFinest) * fraction);
  }));
  if (!this->Work->warning.empty())
  {
    warn(this, "Store " + this->FileName + ": " + this->Work->warning);
  }
  return false;
}

// What the user must know of the first piece is reported at the end.
void vtkOMEZarrWriter::TakeVoxels(OutgoingVolume& volume)
{
  auto* image = vtkImageData::SafeDownCast(this->GetInput());
  std::string warning;
  takeOut(image, this->PointArray, static_cast<WorldAxes>(this->World), volume, warning);
  constexpr int AsTheVolumeSays = 0;
  if (this->Labels != AsTheVolumeSays)
  {
    volume.isLabelMap = this->Labels == 1;
  }
  if (volume.isLabelMap && volume.type.kind == VoxelNumber::Kind::Floating)
  {
    throw brainshift::Problem(
      joined("The input is of the type ", volume.numbers->GetDataTypeAsString(),
        ", and labels must be whole numbers; convert it, or set Labels to No"));
  }
  if (!this->Work->store)
  {
    const std::string time = noteOfTimes(image, this->GetInputInformation(0, 0), "store");
    this->Work->warning = warning + (warning.empty() || time.empty() ? "" : ". ") + time;
  }
}

// The first piece is there, and with it the type of the numbers.
void vtkOMEZarrWriter::Begin(const OutgoingVolume& volume)
{
  throwIfAny(this->FileName.empty() ? "The name of the store to write is missing" : "");
  auto* image = vtkImageData::SafeDownCast(this->GetInput());
  PyramidContent content;
  content.grid = outgoingGrid(image, this->Work->whole.data(), static_cast<WorldAxes>(this->World));
  content.type = volume.numbers->GetDataType();
  content.components = volume.components();
  content.knowsSides = volume.knowsSides;
  content.isLabelMap = volume.isLabelMap;
  content.labels = volume.isLabelMap ? attachedLabels(image) : std::vector<Label>();
  content.isVersion3 = this->Version == 1;
  for (int i = 0; i < content.components && volume.numbers->HasAComponentName(); ++i)
  {
    const char* name = volume.numbers->GetComponentName(i);
    content.channels.emplace_back(name ? name : std::to_string(i));
  }
  withBeginning("Store " + this->FileName + " cannot be written: ",
    [&] { this->Work->store = std::make_unique<PyramidStore>(this->FileName, content); });
}

// Whether the first rank goes on, whatever another one says: inputs may work on all ranks at once.
// Each run ends with one word of it that it does not.
bool vtkOMEZarrWriter::FirstRankGoes(bool goes)
{
  int word = goes ? 1 : 0;
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  if (ranks && ranks->GetNumberOfProcesses() > 1)
  {
    ranks->Broadcast(&word, 1, 0);
  }
  this->HasEnded = word == 0;
  return !this->HasEnded;
}

bool vtkOMEZarrWriter::Go(double fraction)
{
  this->UpdateProgress(fraction);
  return !this->CheckAbort();
}

void vtkOMEZarrWriter::RequireGoing(bool goes) const
{
  throwIfAny(goes ? std::string()
                  : "Store " + this->FileName +
        " was stopped before its end; write it again under this name to go on");
}

void vtkOMEZarrWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "PointArray: " << this->PointArray << "\n"
     << indent << "World: " << this->World << "\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << "\n"
     << indent << "Version: " << this->Version << "\n"
     << indent << "Labels: " << this->Labels << "\n";
}
