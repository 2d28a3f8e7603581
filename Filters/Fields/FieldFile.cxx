// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fields/FieldFile.h"

#include "Filters/Fields/NIFTIField.h"
#include "Filters/Fields/TextHeaderField.h"

#include <algorithm>
#include <cctype>

namespace brainshift
{
namespace
{
bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() &&
    std::equal(end.rbegin(), end.rend(), text.rbegin(), [](char wanted, char found) {
      return wanted == std::tolower(static_cast<unsigned char>(found));
    });
}

enum class Format
{
  Unknown,
  NIFTI,
  MetaImage,
  NRRD,
};

Format formatOf(const std::string& fileName)
{
  if (endsWith(fileName, ".nii") || endsWith(fileName, ".nii.gz"))
  {
    return Format::NIFTI;
  }
  if (endsWith(fileName, ".mha") || endsWith(fileName, ".mhd"))
  {
    return Format::MetaImage;
  }
  const bool isNRRD = endsWith(fileName, ".nrrd") || endsWith(fileName, ".nhdr");
  return isNRRD ? Format::NRRD : Format::Unknown;
}

std::string unknownFormat(const std::string& fileName)
{
  return "The extension of the displacement field " + fileName +
    " must be .nii, .nii.gz, .mha, .mhd, .nrrd or .nhdr";
}
}

bool isFieldFile(const std::string& fileName)
{
  switch (formatOf(fileName))
  {
    case Format::NIFTI:
      return isNIFTIField(fileName);
    case Format::MetaImage:
    case Format::NRRD:
      return isTextHeaderField(fileName);
    default:
      return false;
  }
}

std::string readFieldFile(const std::string& fileName, DirectedField& field)
{
  switch (formatOf(fileName))
  {
    case Format::NIFTI:
      return readNIFTIField(fileName, field);
    case Format::MetaImage:
    case Format::NRRD:
      return readTextHeaderField(fileName, field);
    default:
      return unknownFormat(fileName);
  }
}

std::string writeFieldFile(const std::string& fileName, const DirectedField& field)
{
  switch (formatOf(fileName))
  {
    case Format::NIFTI:
      return writeNIFTIField(fileName, field);
    case Format::MetaImage:
      return writeMetaImageField(fileName, field);
    case Format::NRRD:
      return writeNRRDField(fileName, field);
    default:
      return unknownFormat(fileName);
  }
}
}
