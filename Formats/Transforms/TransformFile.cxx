// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Transforms/TransformFile.h"

#include "Common/HostMemory.h"
#include "Formats/Fields/FieldFile.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/NIFTI/NIFTIVolume.h"
#include "Formats/Transforms/TransformBinary.h"
#include "Formats/Transforms/TransformText.h"

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int LongestChain = 32;
constexpr std::size_t LargestText = std::size_t(1) << 30; // bytes

std::string beginOf(const std::string& fileName, std::size_t bytes)
{
  std::ifstream file(fileName, std::ios::binary);
  std::string begin(bytes, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(bytes));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  return begin;
}

std::string readAll(const std::string& fileName, std::string& bytes)
{
  std::error_code error;
  const auto size = std::filesystem::file_size(fileName, error);
  if (error || size > LargestText)
  {
    return error ? "cannot be opened"
                 : "has " + std::to_string(size) + " bytes; a transform has up to 1 GiB";
  }
  const std::string tooLarge = hostMemoryProblem("its text", 3.0 * static_cast<double>(size));
  if (!tooLarge.empty())
  {
    return "cannot be read: " + tooLarge;
  }
  bytes = beginOf(fileName, size);
  return bytes.size() == size ? std::string() : "cannot be read to its end";
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

// RAS from the millimetres of FSL: from the first voxel, x reversed unless the file is left-handed.
std::string readFSLFrame(const std::string& what, const std::string& image, glm::dmat4& frame)
{
  if (image.empty())
  {
    return "holds a matrix of FSL's flirt, whose points depend on both images: name the " + what +
      " image too, the NIfTI file that flirt was given";
  }
  NIFTIVolume file;
  VolumeHeader header;
  const std::string problem = file.readHeader(image, header);
  if (!problem.empty())
  {
    return "needs the " + what + " image " + image + ", which " + problem;
  }
  glm::dmat4 worldFromVoxel = header.worldFromVoxel;
  if (file.reversesSlices())
  {
    worldFromVoxel[3] += worldFromVoxel[2] * (header.dimensions.z - 1.0);
    worldFromVoxel[2] = -worldFromVoxel[2];
  }
  glm::dmat4 voxelFromFSL(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    voxelFromFSL[axis][axis] = 1.0 / glm::length(glm::dvec3(worldFromVoxel[axis]));
  }
  if (glm::determinant(glm::dmat3(worldFromVoxel)) > 0.0)
  {
    voxelFromFSL[0][0] = -voxelFromFSL[0][0];
    voxelFromFSL[3][0] = header.dimensions.x - 1;
  }
  frame = worldFromVoxel * voxelFromFSL;
  return {};
}

// Reads files one after another into a chain of LPS.
class Reader
{
public:
  explicit Reader(const TransformFiles& files)
    : Files(files)
  {
  }

  std::string add(const std::string& fileName, PointTransform& transform)
  {
    if (++this->Count > LongestChain)
    {
      return "is one of a chain of more than " + std::to_string(LongestChain) + " transforms";
    }
    std::string problem = plainFileProblem(fileName);
    if (problem.empty() && isFieldFile(fileName))
    {
      return this->addFieldFile(fileName, transform);
    }
    std::vector<TransformRecord> records;
    if (problem.empty() && isHDF5(fileName))
    {
      problem = readHDF5Records(fileName, records);
      return problem.empty() ? addRecords(records, transform) : problem;
    }
    std::string bytes;
    problem = problem.empty() ? readAll(fileName, bytes) : problem;
    return problem.empty() ? this->addBytes(fileName, bytes, transform) : problem;
  }

private:
  std::string addFieldFile(const std::string& fileName, PointTransform& transform)
  {
    DirectedField field;
    const std::string problem = readFieldFile(fileName, field);
    if (!problem.empty())
    {
      return "is a field that cannot be read: " + problem;
    }
    if (field.direction == Direction::Forward)
    {
      return "is a forward field; Displacement Field Reader reads it";
    }
    addField(std::move(field), transform);
    return {};
  }

  std::string addBytes(
    const std::string& fileName, const std::string& bytes, PointTransform& transform)
  {
    std::vector<TransformRecord> records;
    if (bytes.rfind(ITKTextBegin, 0) == 0)
    {
      const std::string problem = readITKText(bytes, records);
      return problem.empty() ? addRecords(records, transform) : problem;
    }
    if (isElastixText(bytes))
    {
      return addElastixText(
        bytes, fileName,
        [this](const std::string& named, PointTransform& chain) {
          const std::string problem = this->add(named, chain);
          return problem.empty() ? problem : "names the file " + named + ", which " + problem;
        },
        transform);
    }
    if (const std::optional<std::vector<double>> rows = matrixText(bytes))
    {
      return this->addRasMatrix(fileName, matrixOf(*rows), transform);
    }
    if (std::filesystem::path(fileName).extension() == ".mat")
    {
      const std::string problem = readMatlabRecords(bytes, records);
      return problem.empty() ? addRecords(records, transform) : problem;
    }
    return "is no transform of ITK, ANTs, elastix, NiftyReg or FSL";
  }

  std::string addRasMatrix(
    const std::string& fileName, const glm::dmat4& matrix, PointTransform& transform) const
  {
    const glm::dmat4 signs = glm::dmat4(glm::dvec4(-1, 0, 0, 0), glm::dvec4(0, -1, 0, 0),
      glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1));
    if (std::filesystem::path(fileName).extension() != ".mat")
    {
      return addMatrix(rowsOf(signs * matrix * signs), transform);
    }
    glm::dmat4 fixed;
    glm::dmat4 moving;
    std::string problem = readFSLFrame("fixed", this->Files.fixedImage, fixed);
    problem = problem.empty() ? readFSLFrame("moving", this->Files.movingImage, moving) : problem;
    if (problem.empty() && glm::determinant(matrix) == 0.0)
    {
      problem = "holds a matrix without an inverse";
    }
    return problem.empty()
      ? addMatrix(
          rowsOf(signs * moving * glm::inverse(matrix) * glm::inverse(fixed) * signs), transform)
      : problem;
  }

  const TransformFiles& Files;
  int Count = 0;
};
}

bool isTransformFile(const std::string& fileName)
{
  if (!plainFileProblem(fileName).empty())
  {
    return false;
  }
  if (isHDF5(fileName))
  {
    std::vector<TransformRecord> records;
    return readHDF5Records(fileName, records).empty();
  }
  const std::string begin = beginOf(fileName, 65536);
  std::vector<TransformRecord> records;
  return begin.rfind(ITKTextBegin, 0) == 0 || isElastixText(begin) || matrixText(begin) ||
    (std::filesystem::path(fileName).extension() == ".mat" &&
      readMatlabRecords(begin, records).empty());
}

std::string readTransformFiles(const TransformFiles& files, PointTransform& transform)
{
  PointTransform chain;
  Reader reader(files);
  for (const std::string& name : files.names)
  {
    const std::string problem = reader.add(name, chain);
    if (!problem.empty())
    {
      return std::string("Transform file ").append(name).append(" ").append(problem);
    }
  }
  reverseXY(chain);
  transform = std::move(chain);
  return {};
}
}
