// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Fields/FieldFile.h"

#include "Formats/Files/Endings.h"
#include "Formats/Files/WayOut.h"
#include "Formats/Volumes/OutgoingVolume.h"

namespace brainshift
{
namespace
{
const FieldFormat& knownFormatOf(const std::string& fileName)
{
  if (const FieldFormat* format = formatByEnding(fieldFormats(), fileName))
  {
    return *format;
  }
  throw Problem("The extension of the displacement field " + fileName + " must be " +
    endingsInWords(fieldFormats()));
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
  return formatByEnding(fieldFormats(), fileName) != nullptr;
}

bool isFieldFile(const std::string& fileName)
{
  const FieldFormat* format = formatByEnding(fieldFormats(), fileName);
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
