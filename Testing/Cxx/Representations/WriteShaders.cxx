// SPDX-License-Identifier: BSD-3-Clause
// Writes every assembled shader into a folder, with what VTK would put in place of its tags, for an
// offline compiler: WriteShaders FOLDER
#include "Representations/Gpu/ShaderSource.h"

#include <fstream>
#include <iostream>
#include <string>

namespace
{
void replaceAll(std::string& text, const std::string& from, const std::string& to)
{
  for (std::size_t at = text.find(from); at != std::string::npos;
    at = text.find(from, at + to.size()))
  {
    text.replace(at, from.size(), to);
  }
}

// What vtkOpenGLShaderCache does to a source before it compiles it.
std::string asCompiled(std::string source)
{
  std::string outputs;
  for (int output = 0; output < 4; ++output)
  {
    const std::string name = "fragOutput" + std::to_string(output);
    const std::string tag = "gl_FragData[" + std::to_string(output) + "]";
    if (source.find(tag) != std::string::npos)
    {
      outputs += "out vec4 " + name + ";\n";
      replaceAll(source, tag, name);
    }
  }
  replaceAll(source, "//VTK::System::Dec", "#version 150");
  replaceAll(source, "//VTK::Output::Dec", outputs);
  return source;
}

bool write(const std::string& path, const std::string& source)
{
  std::ofstream file(path);
  file << asCompiled(source);
  return file.good();
}
}

int main(int count, char** arguments)
{
  if (count != 2)
  {
    std::cerr << "usage: WriteShaders FOLDER\n";
    return 1;
  }
  bool written = true;
  for (const auto& [name, source] : brainshift::allSources())
  {
    const std::string path = std::string(arguments[1]) + "/" + name;
    written = write(path + ".vert", source.vertex) && written;
    written = write(path + ".frag", source.fragment) && written;
    written = (source.geometry.empty() || write(path + ".geom", source.geometry)) && written;
  }
  return written ? 0 : 1;
}
