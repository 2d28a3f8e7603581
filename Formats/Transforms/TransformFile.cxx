// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Transforms/TransformFile.h"

#include "Common/HostMemory.h"
#include "Formats/Fields/FieldFile.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WayOut.h"
#include "Formats/Transforms/FSLWarp.h"
#include "Formats/Transforms/TransformRecord.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int LongestChain = 32;
constexpr std::size_t LargestText = std::size_t(1) << 30; // bytes

std::string readAll(const std::string& fileName)
{
  std::error_code error;
  const auto size = std::filesystem::file_size(fileName, error);
  if (error || size > LargestText)
  {
    throw Problem(error ? "cannot be opened"
                        : "has " + std::to_string(size) + " bytes; a transform has up to 1 GiB");
  }
  const auto requireMemory = [](double bytes) {
    withBeginning("cannot be read: ", [bytes] { requireHostMemory("its text", bytes); });
  };
  const double ofText = 3.0 * static_cast<double>(size);
  requireMemory(ofText);
  std::string bytes = readBeginning(fileName, size);
  throwIfAny(bytes.size() == size ? "" : "cannot be read to its end");
  const auto words = std::count_if(bytes.begin(), bytes.end(), [](char letter) {
    return letter == ' ' || letter == '\t' || letter == '\n' || letter == '\r';
  });
  constexpr double ofWord = 160.0; // as a string, a copy of it and a number, while lists grow
  requireMemory(ofText + ofWord * static_cast<double>(words));
  const bool isText = bytes.find('\0') == std::string::npos; // binary files of ITK have some
  return isText ? withLineFeeds(std::move(bytes)) : bytes;
}

void addField(DirectedField field, PointTransform& transform)
{
  reverseXY(field); // the chain is LPS
  FieldLink link;
  link.grid.dimensions = field.grid.dimensions;
  link.grid.origin = field.grid.origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    link.grid.worldFromGrid[axis] = field.grid.direction[axis] * field.grid.spacing[axis];
  }
  link.grid.gridFromWorld = glm::inverse(link.grid.worldFromGrid);
  link.displacements = std::move(field.displacements);
  transform.knowsSides = transform.knowsSides && field.knowsSides;
  transform.links.emplace_back(std::move(link));
}

std::vector<double> rowsOf(const glm::dmat4& matrix)
{
  std::vector<double> rows;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      rows.push_back(matrix[column][row]);
    }
  }
  return rows;
}

glm::dmat4 matrixOf(const std::vector<double>& rows)
{
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i)
  {
    matrix[i % 4][i / 4] = rows[i];
  }
  return matrix;
}

constexpr const char* OfITK = "a transform of ITK, as Slicer and ANTs write it, too";
constexpr const char* AsStored = "It takes points of the fixed image to the moving one, as stored.";
constexpr const char* Turned =
  "It takes points of the moving image to the fixed one; BrainShift inverts it.";

// Remembers what a file says of its direction.
void tell(const std::string& what, const char* leads, PointTransform& transform)
{
  transform.stories.push_back("holds " + what + ". " + leads);
}

// What a field says of its direction.
std::string storyOf(const std::optional<Direction>& direction)
{
  return !direction ? "a displacement field that does not name its direction, which counts as a "
                      "backward one, as those of ITK, ANTs and elastix are"
                    : std::string("a displacement field that says that it is a ") +
      (*direction == Direction::Forward ? "forward" : "backward") + " one";
}

// Reads files one after another into a chain of LPS.
class Reader
{
public:
  explicit Reader(const TransformFiles& files)
    : Files(files)
  {
  }

  void add(const std::string& fileName, PointTransform& transform)
  {
    if (++this->Count > LongestChain)
    {
      throw Problem(
        "is one of a chain of more than " + std::to_string(LongestChain) + " transforms");
    }
    requirePlainFile(fileName);
    const std::optional<NIFTIWarpKind> warp =
      niftiWarpOf(fileName, this->Files.program == MatrixProgram::SPM);
    if (warp && *warp == NIFTIWarpKind::Positions)
    {
      tell("positions of SPM at the voxels of the fixed image, as you say", AsStored, transform);
      addPositions(fileName, transform);
    }
    else if (warp)
    {
      const NamedImages images{ this->Files.fixedImage, this->Files.movingImage };
      tell("a warp of FSL, in the millimetres of its images", AsStored, transform);
      addFSLWarp(fileName, *warp, images, transform);
    }
    else if (hasFieldEnding(fileName)) // a file that is no field then says why
    {
      addFieldFile(fileName, transform);
    }
    else if (isHDF5(fileName))
    {
      tell(OfITK, AsStored, transform);
      addRecords(readHDF5Records(fileName), transform);
    }
    else
    {
      this->addBytes(fileName, readAll(fileName), transform);
    }
  }

private:
  static void addFieldFile(const std::string& fileName, PointTransform& transform)
  {
    DirectedField field;
    withBeginning("is a field that cannot be read: ", [&] { readFieldFile(fileName, field); });
    const bool isForward = field.direction == Direction::Forward;
    tell(storyOf(field.direction), isForward ? Turned : AsStored, transform);
    PointTransform stored;
    addField(std::move(field), isForward ? stored : transform);
    if (isForward)
    {
      transform.knowsSides = transform.knowsSides && stored.knowsSides;
      transform.links.push_back(inverseOf(std::move(stored)));
    }
  }

  void addBytes(const std::string& fileName, const std::string& bytes, PointTransform& transform)
  {
    if (bytes.rfind(ITKTextBegin, 0) == 0)
    {
      tell(OfITK, AsStored, transform);
      addRecords(readITKText(bytes), transform);
    }
    else if (isLTAText(bytes) || isXFMText(bytes))
    {
      PointTransform ras;
      if (isXFMText(bytes))
      {
        tell(
          "an XFM of the MNI, from its source, the moving image, to its target", Turned, transform);
        addXFMText(bytes, fileName, ras);
      }
      else
      {
        const bool isTurned =
          addLTAText(bytes, { this->Files.fixedImage, this->Files.movingImage }, ras);
        tell(std::string("an LTA of FreeSurfer, from its src to its dst; its src is the ") +
            (isTurned ? "moving" : "fixed") + " image",
          isTurned ? Turned : AsStored, transform);
      }
      reverseXY(ras);
      std::move(ras.links.begin(), ras.links.end(), std::back_inserter(transform.links));
    }
    else if (isElastixText(bytes))
    {
      const auto addNamed = [this](const std::string& named, PointTransform& chain) {
        withBeginning("names the file " + named + ", which ", [&] { this->add(named, chain); });
      };
      tell("a transform of elastix", AsStored, transform);
      addElastixText(bytes, fileName, addNamed, transform);
    }
    else if (const std::optional<std::vector<double>> rows = matrixText(bytes))
    {
      this->addTextMatrix(matrixOf(*rows), transform);
    }
    else if (std::filesystem::path(fileName).extension() == ".mat")
    {
      tell(OfITK, AsStored, transform);
      addRecords(readMatlabRecords(bytes), transform);
    }
    else
    {
      throw Problem("is no transform of ITK, ANTs, elastix, NiftyReg, FSL, FreeSurfer or the "
                    "MNI");
    }
  }

  void addTextMatrix(const glm::dmat4& matrix, PointTransform& transform) const
  {
    const glm::dmat4 signs = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, -1, 0, 0),
      glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1));
    const MatrixProgram program = this->Files.program;
    const bool isOfNoImage = this->Files.fixedImage.empty() && this->Files.movingImage.empty();
    if (program == MatrixProgram::Unknown && isOfNoImage)
    {
      throw Problem("holds 16 numbers and does not say what they mean; name the program that wrote "
                    "it (Matrix Program): fsl, with the fixed and the moving image (the NIfTI "
                    "files of flirt's -ref and -in), or niftyreg (a matrix from RAS to RAS)");
    }
    if (program == MatrixProgram::SPM)
    {
      throw Problem("holds 16 numbers, and SPM writes none as text; name FSL or NiftyReg as the "
                    "program that wrote them");
    }
    if (program == MatrixProgram::NiftyReg)
    {
      tell("a matrix of NiftyReg, as you say", AsStored, transform);
      addMatrix(rowsOf(signs * matrix * signs), transform);
      return;
    }
    tell("a matrix of FSL's flirt, in the millimetres of its images", Turned, transform);
    constexpr const char* Matrix = "a matrix of FSL's flirt, whose points depend on both images";
    const glm::dmat4 fixed =
      readFSLFrame({ "fixed", Matrix }, this->Files.fixedImage, transform.knowsSides).worldFromFSL;
    const glm::dmat4 moving =
      readFSLFrame({ "moving", Matrix }, this->Files.movingImage, transform.knowsSides)
        .worldFromFSL;
    if (glm::determinant(matrix) == 0.0)
    {
      throw Problem("holds a matrix without an inverse");
    }
    addMatrix(
      rowsOf(signs * moving * glm::inverse(matrix) * glm::inverse(fixed) * signs), transform);
  }

  const TransformFiles& Files;
  int Count = 0;
};
}

bool isTransformFile(const std::string& fileName)
{
  if (!isPlainFile(fileName))
  {
    return false;
  }
  if (isHDF5(fileName))
  {
    return problemOf([&] { readHDF5Records(fileName); }).empty();
  }
  const std::string begin = readBeginning(fileName, 65536);
  const std::string text = withLineFeeds(begin);
  return text.rfind(ITKTextBegin, 0) == 0 || isElastixText(text) || isLTAText(text) ||
    isXFMText(text) || matrixText(text) ||
    (std::filesystem::path(fileName).extension() == ".mat" &&
      problemOf([&] { readMatlabRecords(begin); }).empty());
}

PointTransform readTransformFiles(const TransformFiles& files)
{
  constexpr const char* OtherTransform =
    "copy it again, or let its program write a displacement field (.nii.gz or .nrrd) in its place";
  PointTransform chain;
  Reader reader(files);
  for (const std::string& name : files.names)
  {
    withWayOut("Transform file " + name + " ", OtherTransform, [&] { reader.add(name, chain); });
  }
  reverseXY(chain);
  return chain;
}
}
