// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Displacement fields in NIfTI files (.nii, .nii.gz).
///
/// Written: intent 1006 (DISPVECT), vectors in RAS, which ITK from 5.4 on turns into LPS when it
/// reads them; intent_name holds the direction.
///
/// Read: intent 1006 (vectors in RAS); intent 1007 (VECTOR) as ITK, ANTs and elastix write it
/// (without a name; vectors in LPS); intent 1007 of NiftyReg (vectors in RAS; intent_p1 0:
/// positions, 1: displacements) and of SPM ("Mapping": positions in RAS). Other names are refused:
/// their vectors may be anything.
#include "Common/Guard.h"
#include "Formats/Fields/FieldFile.h"
#include "Formats/Fields/FieldImage.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WholeFile.h"
#include "Formats/NIFTI/NIFTIHeader.h"
#include "Formats/NIFTI/NIFTIVolume.h"
#include "Formats/Volumes/OutgoingVolume.h"
#include "Formats/Volumes/PlacedVolume.h"

#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNIFTIImageHeader.h"
#include "vtkNIFTIImageWriter.h"
#include "vtkPointData.h"
#include "vtk_zlib.h"

#include <map>
#include <set>

namespace brainshift
{
namespace
{
constexpr int SmallestNIFTIHeader = 348; // bytes
constexpr const char* NiftyRegName = "NREG_TRANS";
constexpr int NiftyRegPositions = 0;       // intent_p1: where a point goes
constexpr int NiftyRegDisplacements = 1;   // how far
constexpr const char* SPMName = "Mapping"; // y_*.nii: where a point of the template comes from
constexpr const char* ForwardName = "forward";
constexpr const char* BackwardName = "backward";

// Names that programs and users give to intent 1006, in small letters.
const std::set<std::string> DisplacementNames{ "", ForwardName, BackwardName, "dispvect",
  "displacement", "displacements", "displacement field", "displacement vec" };

// FSL's own codes, whose files look like fields of three volumes.
const std::map<int, const char*> FSLNames{ { 2006, "FSL_FNIRT_DISPLACEMENT_FIELD" },
  { 2007, "FSL_CUBIC_SPLINE_COEFFICIENTS" }, { 2008, "FSL_DCT_COEFFICIENTS" },
  { 2009, "FSL_QUADRATIC_SPLINE_COEFFICIENTS" }, { 2016, "FSL_TOPUP_CUBIC_SPLINE_COEFFICIENTS" },
  { 2017, "FSL_TOPUP_QUADRATIC_SPLINE_COEFFICIENTS" }, { 2018, "FSL_TOPUP_FIELD" } };

// What a header says about the vectors.
struct Intent
{
  int code = 0;
  std::string name;
  double p1 = 0.0;
  int xyztUnits = 0;
  bool isVectors = false; // three components
};

Intent intentOf(const std::string& fileName)
{
  Intent intent;
  vtkNew<vtkNIFTIImageReader> reader;
  reader->SetFileName(fileName.c_str());
  vtkNew<vtkCallbackCommand> silent; // the reader of the voxels reports problems
  silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  reader->AddObserver(vtkCommand::WarningEvent, silent);
  reader->AddObserver(vtkCommand::ErrorEvent, silent);
  reader->UpdateInformation();
  if (vtkNIFTIImageHeader* header = reader->GetNIFTIHeader())
  {
    intent.code = header->GetIntentCode();
    intent.name = trimmed(header->GetIntentName() ? header->GetIntentName() : "");
    intent.p1 = header->GetIntentP1();
    intent.xyztUnits = header->GetXYZTUnits();
    intent.isVectors = header->GetDim(0) >= 5 && header->GetDim(4) <= 1 && header->GetDim(5) == 3;
  }
  return intent;
}

// Vectors under a name that is not known may be velocities, coefficients or positions.
void requireName(const Intent& intent)
{
  const bool isKnown = intent.code == vtkNIFTIImageHeader::IntentDispVect
    ? DisplacementNames.count(lowerCase(intent.name)) > 0
    : intent.name.empty() || intent.name == NiftyRegName || intent.name == SPMName;
  if (!isKnown)
  {
    throw Problem(joined("has the intent ", intent.code, " with the intent_name \"",
      shownWords(intent.name), "\"; ",
      intent.code == vtkNIFTIImageHeader::IntentDispVect
        ? "of 1006 (DISPVECT) it must be empty, forward, backward or displacement"
        : "of 1007 (VECTOR) it must be empty (ITK, ANTs, elastix), NREG_TRANS (NiftyReg) or "
          "Mapping (SPM)"));
  }
}

// Throws the end of a sentence unless a file is of vectors that can be used.
void requireIntent(const Intent& intent)
{
  if (const auto ofFSL = FSLNames.find(intent.code); ofFSL != FSLNames.end())
  {
    const bool isWarp = intent.code == 2006 || intent.code == 2007;
    throw Problem(joined("has the intent ", intent.code, " (", ofFSL->second, "), ",
      isWarp ? "whose numbers depend on the images of fnirt: open it with Transform Reader, and "
               "name Moving Image (--in) and, of coefficients, Fixed Image (--ref)"
             : "which BrainShift does not read; a displacement field must have 1006 (DISPVECT: "
               "RAS, mm)"));
  }
  if (!intent.isVectors)
  {
    throw Problem("does not have 3 components per voxel (in dim[5])");
  }
  if (intent.code != vtkNIFTIImageHeader::IntentDispVect &&
    intent.code != vtkNIFTIImageHeader::IntentVector)
  {
    throw Problem("has the intent " + std::to_string(intent.code) +
      "; a displacement field must have 1006 (DISPVECT) or 1007 (VECTOR). Open it with "
      "Transform Reader, and choose SPM as its program, if SPM wrote it");
  }
  requireName(intent);
  if (mmPerNIFTIUnit(intent.xyztUnits) != 1.0)
  {
    throw Problem(joined("has the xyzt_units ", intent.xyztUnits, ", whose unit of length is not ",
      "mm; a displacement field must be in mm (2)"));
  }
  if (intent.name == NiftyRegName && intent.p1 != NiftyRegPositions &&
    intent.p1 != NiftyRegDisplacements)
  {
    throw Problem("is a NiftyReg transformation of type " +
      std::to_string(static_cast<int>(intent.p1)) +
      "; it must be 0 (deformation field) or 1 (displacement field). Make one by "
      "NiftyReg's reg_transform");
  }
}

// Reads the grid and the vectors as the file has them.
void readVectors(const std::string& fileName, DirectedField& field)
{
  PlacedVolume file(std::make_unique<NIFTIVolume>());
  file.readHeader(fileName);
  for (const std::string& warning : file.warnings())
  {
    warn(nullptr, warning);
  }
  if (file.header().components != 3)
  {
    throw Problem("NIfTI file " + fileName + " has " + std::to_string(file.header().components) +
      " components per voxel; it must have 3");
  }
  const glm::ivec3 last = file.geometry().grid.dimensions - 1;
  const int extent[6] = { 0, last.x, 0, last.y, 0, last.z };
  vtkNew<vtkImageData> image;
  file.read(0, extent, [](double) { return true; }, image);
  field.grid = file.geometry().grid;
  field.knowsSides = file.header().knowsSides;
  field.displacements = vectorsOf(image->GetPointData()->GetScalars());
}

// From where points go to how far they go.
void subtractPositions(DirectedField& field)
{
  const glm::ivec3& n = field.grid.dimensions;
  for (std::size_t i = 0; i < field.displacements.size(); ++i)
  {
    const auto row = i / n.x;
    const glm::dvec3 index(i % n.x, row % n.y, row / n.y);
    field.displacements[i] =
      glm::vec3(glm::dvec3(field.displacements[i]) - field.grid.worldFromGrid(index));
  }
}

// vtkNIFTIImageWriter does not see that its last bytes found no place.
void requireStored(const std::string& fileName, double bytesOfVectors)
{
  gzFile file = gzopen(fileName.c_str(), "rb");
  double found = -static_cast<double>(SmallestNIFTIHeader);
  std::vector<char> piece(1 << 20);
  int read = 0;
  while (file && (read = gzread(file, piece.data(), static_cast<unsigned>(piece.size()))) > 0)
  {
    found += read;
  }
  const bool whole = file && gzclose(file) == Z_OK && read == 0 && found >= bytesOfVectors;
  if (!whole)
  {
    throw Problem("the disk stored only a part of its bytes");
  }
}

void reverseVectorsXY(DirectedField& field)
{
  for (glm::vec3& displacement : field.displacements)
  {
    displacement *= glm::vec3(-1.0f, -1.0f, 1.0f);
  }
}

bool isNIFTIField(const std::string& fileName)
{
  const bool isRead = problemOf([&] { requireNIFTIFile(fileName); }).empty();
  const Intent intent = isRead ? intentOf(fileName) : Intent();
  return intent.isVectors &&
    (intent.code == vtkNIFTIImageHeader::IntentDispVect ||
      intent.code == vtkNIFTIImageHeader::IntentVector);
}

void readNIFTIField(const std::string& fileName, DirectedField& field)
{
  const Intent intent = withBeginning("NIfTI file " + fileName + " ", [&] {
    requireNIFTIFile(fileName);
    const Intent found = intentOf(fileName);
    requireIntent(found);
    return found;
  });
  readVectors(fileName, field);
  field.direction.reset();
  const bool isVector = intent.code == vtkNIFTIImageHeader::IntentVector;
  if (isVector && intent.name.empty())
  {
    reverseVectorsXY(field); // ITK stores its LPS vectors as they are
  }
  else if (isVector)
  {
    field.direction = Direction::Backward;
    if (intent.name == SPMName || intent.p1 == NiftyRegPositions)
    {
      subtractPositions(field);
    }
  }
  else if (const std::string name = lowerCase(intent.name);
    name == ForwardName || name == BackwardName)
  {
    field.direction = name == ForwardName ? Direction::Forward : Direction::Backward;
  }
}

void writeNIFTIField(const std::string& fileName, const DirectedField& field)
{
  const Grid& grid = field.grid;
  const Direction direction = field.direction.value_or(Direction::Backward);
  Grid unplaced; // the affine goes by the header
  unplaced.dimensions = grid.dimensions;
  unplaced.spacing = grid.spacing;
  vtkNew<vtkImageData> image;
  setField(image, unplaced, field.displacements, direction);
  image->GetPointData()->SetActiveScalars(DisplacementName);

  vtkNew<vtkMatrix4x4> worldFromRotated; // spacing comes with the image
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      worldFromRotated->SetElement(row, column, grid.direction[column][row]);
    }
    worldFromRotated->SetElement(row, 3, grid.origin[row]);
  }
  vtkNew<vtkNIFTIImageHeader> header;
  header->SetIntentCode(vtkNIFTIImageHeader::IntentDispVect);
  header->SetIntentName(direction == Direction::Forward ? ForwardName : BackwardName);
  vtkNew<vtkNIFTIImageWriter> writer;
  writer->SetInputData(image);
  writer->SetNIFTIHeader(header);
  writer->SetDescription(joined("BrainShift displacement field, mm", field.knowsSides ? "" : ", ",
    field.knowsSides ? "" : UnknownSidesNote)
      .c_str());
  if (glm::determinant(grid.direction) > 0.0 && field.knowsSides)
  {
    writer->SetQFormMatrix(worldFromRotated); // a rotation: a mirror has none
  }
  if (field.knowsSides || needsTransform(grid))
  {
    writer->SetSFormMatrix(worldFromRotated);
  }
  vtkNew<vtkCallbackCommand> silent; // the error code says enough
  silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  writer->AddObserver(vtkCommand::ErrorEvent, silent);
  const double bytes = 12.0 * static_cast<double>(grid.count());
  writeWhole(fileName, [&](const std::string& beside) {
    writer->SetFileName(beside.c_str());
    writer->Write();
    if (const int error = writer->GetErrorCode(); error != vtkErrorCode::NoError)
    {
      throw Problem(vtkErrorCode::GetStringFromErrorCode(error));
    }
    requireStored(beside, bytes);
  });
}
}

extern const FieldFormat FieldsOfNIFTI{ []() -> std::vector<std::string> {
                                         return { ".nii", ".nii.gz" };
                                       },
  isNIFTIField, readNIFTIField, writeNIFTIField };
}
