// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicerSceneReader.h"

#include "Common/Guard.h"
#include "Common/Problem.h"

#include "vtkObjectFactory.h"

#include <vtksys/FStream.hxx>

#include <array>
#include <string_view>

using namespace brainshift;

vtkStandardNewMacro(vtkSlicerSceneReader);
brainshiftGuardRequestsMacro(vtkSlicerSceneReader);

namespace
{
constexpr std::size_t BeginBytes = 4096; // a comment may precede the first node
constexpr std::string_view Zip("PK\3\4", 4);
}

vtkSlicerSceneReader::vtkSlicerSceneReader()
{
  this->SetNumberOfInputPorts(0);
}

int vtkSlicerSceneReader::CanReadFile(const char* fileName)
{
  if (!fileName)
  {
    return 0;
  }
  std::array<char, BeginBytes> bytes{};
  vtksys::ifstream file(fileName, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  const std::string_view begin(bytes.data(), static_cast<std::size_t>(file.gcount()));
  return begin.substr(0, Zip.size()) == Zip || begin.find("<MRML") != std::string_view::npos ? 1
                                                                                             : 0;
}

int vtkSlicerSceneReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector*)
{
  throw Problem("Scene " + this->FileName +
    " makes several sources; open it in ParaView's window, or in Python with "
    "brainshift.open_scene");
}

void vtkSlicerSceneReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
