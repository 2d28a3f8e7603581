// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Fields/FieldFile.h"

#include "Formats/Files/Text.h"
#include "Formats/Files/WayOut.h"
#include "Formats/Volumes/OutgoingVolume.h"

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

const FieldFormat& knownFormatOf(const std::string& fileName)
{
  if (const FieldFormat* format = formatOf(fileName))
  {
    return *format;
  }
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
  throw Problem("The extension of the displacement field " + fileName + " must be " + names);
}
}

void reverseXY(DirectedField& field)
{
  field.grid = withReversedXY(field.grid);
  for (glm::vec3& displacement : field.displacements)
  {
    displacement *= glm::vec3(-1.0f, -1.0f, 1.0f);
  }
}

bool hasFieldEnding(const std::string& fileName)
{
  return formatOf(fileName) != nullptr;
}

bool isFieldFile(const std::string& fileName)
{
  const FieldFormat* format = formatOf(fileName);
  return format && format->isOne(fileName);
}

void readFieldFile(const std::string& fileName, DirectedField& field)
{
  const FieldFormat& format = knownFormatOf(fileName);
  withWayOut("", "copy it again, or write the field anew as .nii.gz, .nrrd or .mha",
    [&] { format.read(fileName, field); });
}

void writeFieldFile(const std::string& fileName, const DirectedField& field)
{
  knownFormatOf(fileName).write(fileName, field);
}
}
