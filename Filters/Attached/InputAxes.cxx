// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/InputAxes.h"

#include "vtkAbstractPolyDataReader.h"
#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkDataSet.h"
#include "vtkFileSeriesReader.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <cstddef>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr std::size_t HeaderBytes = 4096;  // the word is in the first lines
constexpr std::size_t StlHeaderBytes = 80; // of a binary file

// Empty for an algorithm that reads no file with a comment.
std::string fileReadBy(vtkAlgorithm* reader)
{
  const char* name = nullptr;
  if (auto* series = vtkFileSeriesReader::SafeDownCast(reader))
  {
    name = series->GetNumberOfFileNames() > 0 ? series->GetFileName(0) : nullptr;
  }
  else if (auto* one = vtkAbstractPolyDataReader::SafeDownCast(reader))
  {
    name = one->GetFileName();
  }
  return name ? name : "";
}

// The part of a file in which a format has comments; empty for other formats. _axes_of_model in
// Python/brainshift/openscene.py knows the same places, for models of a scene.
std::string commentsOf(const std::string& file)
{
  const std::string ending =
    vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(file));
  vtksys::ifstream stream(file.c_str(), std::ios::binary);
  std::string header(HeaderBytes, '\0');
  stream.read(&header[0], HeaderBytes);
  header.resize(static_cast<std::size_t>(stream.gcount()));
  if (ending == ".ply")
  {
    return header.substr(0, header.find("end_header"));
  }
  if (ending == ".stl")
  {
    return header.substr(0, header.rfind("solid", 0) == 0 ? header.find('\n') : StlHeaderBytes);
  }
  std::istringstream lines(header);
  std::string comments;
  std::string line;
  for (int number = 0; std::getline(lines, line); ++number)
  {
    const bool isComment =
      ending == ".vtk" ? number == 1 : ending == ".obj" && line.rfind('#', 0) == 0;
    comments += isComment ? line + "\n" : std::string();
  }
  return comments;
}

// Whether the points of some data lie where others have theirs. What has no box counts as there.
bool liesWithin(vtkDataObject* data, vtkDataObject* read)
{
  vtkDataSet* inner = vtkDataSet::SafeDownCast(data);
  vtkDataSet* outer = vtkDataSet::SafeDownCast(read);
  if (!inner || !outer || inner->GetNumberOfPoints() == 0 || outer->GetNumberOfPoints() == 0)
  {
    return true;
  }
  vtkBoundingBox box(outer->GetBounds());
  box.Inflate(1e-3 * box.GetDiagonalLength());
  return box.Contains(vtkBoundingBox(inner->GetBounds())) != 0;
}
}

NamedAxes namedAxesOfInput(const std::string& noun, vtkAlgorithm* filter, int port)
{
  if (filter->GetNumberOfInputConnections(port) == 0)
  {
    return { noun };
  }
  vtkDataObject* data = filter->GetInputDataObject(port, 0);
  NamedAxes found = namedAxesOf(noun, data);
  if (found.axes != WorldAxes::Unknown)
  {
    return found;
  }
  vtkAlgorithm* reader = filter->GetInputAlgorithm(port, 0);
  while (
    reader && reader->GetNumberOfInputPorts() == 1 && reader->GetNumberOfInputConnections(0) == 1)
  {
    reader = reader->GetInputAlgorithm(0, 0);
  }
  const std::string file = fileReadBy(reader);
  if (file.empty() || !liesWithin(data, reader->GetOutputDataObject(0)))
  {
    return found;
  }
  const std::string comments = commentsOf(file);
  const auto says = [&](const char* word) { return comments.find(word) != std::string::npos; };
  found.axes = says("SPACE=LPS") ? WorldAxes::LPS
    : says("SPACE=RAS")          ? WorldAxes::RAS
                                 : WorldAxes::Unknown;
  found.noun += found.axes == WorldAxes::Unknown ? "" : " (by the word SPACE in its file)";
  return found;
}
}
