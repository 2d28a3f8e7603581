// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Fields/FieldFile.h"

#include "Formats/Files/Text.h"

namespace brainshift
{
namespace
{
// The format that the ending of a name stands for. Null: none.
const FieldFormat* formatOf(const std::string& fileName)
{
  for (const FieldFormat* format : fieldFormats())
  {
    for (const std::string& ending : format->endings())
    {
      if (endsWith(fileName, ending))
      {
        return format;
      }
    }
  }
  return nullptr;
}

std::string unknownFormat(const std::string& fileName)
{
  std::vector<std::string> all;
  for (const FieldFormat* format : fieldFormats())
  {
    const std::vector<std::string> endings = format->endings();
    all.insert(all.end(), endings.begin(), endings.end());
  }
  std::string names;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    names.append(i == 0 ? "" : i + 1 == all.size() ? " or " : ", ").append(all[i]);
  }
  return "The extension of the displacement field " + fileName + " must be " + names;
}
}

bool isFieldFile(const std::string& fileName)
{
  const FieldFormat* format = formatOf(fileName);
  return format && format->isOne(fileName);
}

std::string readFieldFile(const std::string& fileName, DirectedField& field)
{
  const FieldFormat* format = formatOf(fileName);
  return format ? format->read(fileName, field) : unknownFormat(fileName);
}

std::string writeFieldFile(const std::string& fileName, const DirectedField& field)
{
  const FieldFormat* format = formatOf(fileName);
  return format ? format->write(fileName, field) : unknownFormat(fileName);
}
}
