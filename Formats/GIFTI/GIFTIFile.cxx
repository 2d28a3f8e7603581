// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/GIFTI/GIFTIFile.h"

#include "Common/Numbers.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"

#include "vtk_expat.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

namespace brainshift
{
namespace
{
constexpr std::size_t Piece = 1 << 20;     // bytes that expat parses at a time
constexpr std::size_t DeepestElement = 16; // the format needs 6
constexpr std::size_t MostLabels = 1 << 20;
constexpr std::size_t LongestMatrix = 4096;    // letters
constexpr std::size_t LongestBeginning = 4096; // bytes by which a file is known

// Expat 2.9 names them anew.
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
constexpr auto currentLine = XML_GetCurrentLineNumber64;
constexpr auto currentByte = XML_GetCurrentByteIndex64;
#else
constexpr auto currentLine = XML_GetCurrentLineNumber;
constexpr auto currentByte = XML_GetCurrentByteIndex;
#endif

// What expat tells of the file as it goes along.
class Listener
{
public:
  Listener(XML_Parser parser, GIFTIFile& file)
    : Parser(parser)
    , File(file)
  {
  }

  std::string problem() const { return this->Problem; }
  bool hasRoot() const { return this->IsGIFTI; }

  void begin(const std::string& name, const XML_Char** attributes)
  {
    this->Open.push_back(name);
    this->Text.clear();
    this->IsGIFTI = this->IsGIFTI || (this->Open.size() == 1 && name == "GIFTI");
    if (!this->IsGIFTI || this->Open.size() > DeepestElement)
    {
      this->stop(this->IsGIFTI ? "has elements inside each other, deeper than 16"
                               : "is no GIFTI file: its first element is " + shownWords(name));
      return;
    }
    if (name == "DataArray")
    {
      this->File.arrays.emplace_back();
    }
    this->Transform =
      name == "CoordinateSystemTransformMatrix" ? GIFTITransform() : this->Transform;
    this->Attributes.clear();
    for (; *attributes; attributes += 2)
    {
      this->Attributes[attributes[0]] = attributes[1];
    }
    if (name == "GIFTI")
    {
      this->File.attributes = this->Attributes;
    }
    if (name == "DataArray")
    {
      this->File.arrays.back().attributes = this->Attributes;
    }
  }

  void letters(const XML_Char* text, int length) { this->Text.append(text, length); }

  void end(const std::string& name)
  {
    if (name == "Label")
    {
      this->addLabel();
    }
    if (!this->File.arrays.empty() && this->isInside("DataArray"))
    {
      this->endInArray(name, this->File.arrays.back());
    }
    else if (name == "Name")
    {
      this->MetaName = trimmed(this->Text);
    }
    else if (name == "Value")
    {
      this->File.meta.insert({ this->MetaName, trimmed(this->Text) });
    }
    this->Open.pop_back();
    this->Text.clear();
  }

  void stop(const std::string& problem)
  {
    this->Problem = this->Problem.empty() ? problem : this->Problem;
    XML_StopParser(this->Parser, XML_FALSE);
  }

private:
  bool isInside(const std::string& name) const
  {
    return std::find(this->Open.begin(), this->Open.end(), name) != this->Open.end();
  }

  void endInArray(const std::string& name, GIFTIArray& array)
  {
    if (name == "Name")
    {
      this->MetaName = trimmed(this->Text);
    }
    else if (name == "Value")
    {
      const auto [known, isNew] = array.meta.insert({ this->MetaName, trimmed(this->Text) });
      if (!isNew && known->second != trimmed(this->Text))
      {
        this->stop(twice("metadata " + shownWords(this->MetaName)) + ", with different values");
      }
    }
    else if (name == "DataSpace")
    {
      this->setOnce(this->Transform.from, name);
    }
    else if (name == "TransformedSpace")
    {
      this->setOnce(this->Transform.to, name);
    }
    else if (name == "MatrixData")
    {
      if (this->Text.size() > LongestMatrix)
      {
        this->stop("has a matrix of " + std::to_string(this->Text.size()) +
          " letters; it must be 16 numbers in 4096 letters or fewer");
        return;
      }
      if (!this->Transform.numbers.empty())
      {
        this->stop(twice("element MatrixData"));
      }
      this->Transform.numbers = numbersIn(this->Text);
    }
    else if (name == "CoordinateSystemTransformMatrix")
    {
      array.transforms.push_back(this->Transform);
    }
    else if (name == "Data")
    {
      this->readData(array);
    }
  }

  // The text of an element of a transform, which may have one of that name.
  void setOnce(std::string& word, const std::string& name)
  {
    if (!word.empty())
    {
      this->stop(twice("element " + name));
    }
    word = trimmed(this->Text);
  }

  void readData(GIFTIArray& array)
  {
    const std::string problem = problemOf([&] {
      throwIfAny(array.bytes.empty() ? "" : "has two elements Data");
      readGIFTINumbers(this->Text, array);
    });
    if (!problem.empty())
    {
      this->stop(problem + " in array " + std::to_string(this->File.arrays.size()));
    }
  }

  void addLabel()
  {
    Label label;
    const std::vector<double> key = numbersIn(
      this->Attributes.count("Key") ? this->Attributes["Key"] : this->Attributes["Index"]);
    if (key.size() != 1 || !isWhole(key[0], -2147483648.0, 2147483647.0) ||
      this->File.labels.size() >= MostLabels)
    {
      this->stop("has a label without a whole number as its Key, or more than 1048576 labels");
      return;
    }
    label.value = static_cast<int>(key[0]);
    label.name = trimmed(this->Text);
    const char* const names[3] = { "Red", "Green", "Blue" };
    this->File.colorless += this->Attributes.count(names[0]) == 0 ? 1 : 0;
    for (int i = 0; i < 3; ++i)
    {
      const std::vector<double> share = numbersIn(this->Attributes[names[i]]);
      const bool isShare = share.size() == 1 && share[0] >= 0.0 && share[0] <= 1.0;
      label.color[static_cast<std::size_t>(i)] =
        isShare ? static_cast<unsigned char>(std::lround(255.0 * share[0])) : 255;
    }
    const auto [known, isNew] = this->NameOfLabel.insert({ label.value, label.name });
    if (!isNew && known->second != label.name)
    {
      this->stop(twice("label " + std::to_string(label.value)) + ", with different names");
      return;
    }
    this->File.labels.push_back(label);
  }

  XML_Parser Parser;
  GIFTIFile& File;
  std::string Problem;
  std::string Text; // of the element that is open
  std::vector<std::string> Open;
  std::map<std::string, std::string> Attributes; // of the last element that began
  std::string MetaName;
  GIFTITransform Transform;
  std::map<int, std::string> NameOfLabel;
  bool IsGIFTI = false;
};

// Expat is C: it must meet no exception.
template <typename Step>
void heard(void* user, const Step& step)
{
  auto& listener = *static_cast<Listener*>(user);
  try
  {
    step(listener);
  }
  catch (const std::exception&)
  {
    listener.stop("needs more memory than this machine has left; close other data or programs");
  }
}

void beginElement(void* user, const XML_Char* name, const XML_Char** attributes)
{
  heard(user, [&](Listener& listener) { listener.begin(name, attributes); });
}

void endElement(void* user, const XML_Char* name)
{
  heard(user, [&](Listener& listener) { listener.end(name); });
}

void hearLetters(void* user, const XML_Char* text, int length)
{
  heard(user, [&](Listener& listener) { listener.letters(text, length); });
}

// Entities can make a small file a large one. Their names and values do not matter.
template <typename... Ignored>
void hearEntity(void* user, Ignored...)
{
  heard(user, [](Listener& listener) { listener.stop("declares an entity, which is not read"); });
}

// What the first element announces.
void requireRoot(GIFTIFile& file)
{
  const auto said = [&](const char* name) {
    const auto found = file.attributes.find(name);
    return found == file.attributes.end() ? std::string() : found->second;
  };
  const std::vector<double> version = numbersIn(said("Version"));
  if (!version.empty() && !(version[0] >= 1.0 && version[0] < 2.0))
  {
    throw Problem("has the Version " + shownWords(said("Version")) + "; it must be 1");
  }
  const std::vector<double> count = numbersIn(said("NumberOfDataArrays"));
  if (!count.empty() && count[0] != static_cast<double>(file.arrays.size()))
  {
    const std::size_t arrays = file.arrays.size();
    file.notes.push_back(joined("has ", arrays, arrays == 1 ? " array" : " arrays",
      " where NumberOfDataArrays announces ", shownWords(said("NumberOfDataArrays"))));
  }
  if (file.colorless > 1)
  {
    file.notes.push_back(
      joined("has ", file.colorless, " labels without a colour, which are white"));
  }
}

// The name at which expat stopped.
std::string wordAt(const std::vector<char>& text, std::int64_t index)
{
  const std::string_view all(text.data(), text.size());
  const std::size_t begin =
    std::min(all.size(), static_cast<std::size_t>(std::max<std::int64_t>(index, 0)));
  const std::string_view rest = all.substr(begin, LongestBeginning);
  return shownWords(std::string(rest.substr(0, rest.find_first_of("= \t\r\n"))));
}

struct FreeParser
{
  void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
};
}

bool beginsLikeGIFTI(const std::vector<char>& text)
{
  const std::string_view begin(text.data(), std::min(text.size(), LongestBeginning));
  return begin.find("<GIFTI") != std::string_view::npos;
}

bool isGIFTIFile(const std::string& fileName)
{
  const std::string begin = readBeginning(fileName, LongestBeginning);
  return beginsLikeGIFTI({ begin.begin(), begin.end() });
}

GIFTIFile readGIFTIFile(const std::vector<char>& text)
{
  GIFTIFile file;
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, FreeParser> parser(
    XML_ParserCreate(nullptr));
  if (!parser)
  {
    throw Problem("needs more memory than this machine has left; close other data or programs");
  }
  Listener listener(parser.get(), file);
  XML_SetUserData(parser.get(), &listener);
  XML_SetElementHandler(parser.get(), beginElement, endElement);
  XML_SetCharacterDataHandler(parser.get(), hearLetters);
  XML_SetEntityDeclHandler(parser.get(), hearEntity);
  for (std::size_t place = 0, step = 0; place <= text.size(); place += step)
  {
    step = std::min(text.size() - place, Piece);
    const bool isLast = place + step == text.size();
    const XML_Status status =
      XML_Parse(parser.get(), text.data() + place, static_cast<int>(step), isLast ? 1 : 0);
    throwIfAny(listener.problem());
    if (status != XML_STATUS_OK)
    {
      const std::string line = std::to_string(currentLine(parser.get()));
      const XML_Error error = XML_GetErrorCode(parser.get());
      throwIfAny(error != XML_ERROR_DUPLICATE_ATTRIBUTE
          ? ""
          : twice("attribute " + wordAt(text, currentByte(parser.get()))) +
            " in an element in line " + line);
      throw Problem("is not good XML in line " + line + ": " + XML_ErrorString(error));
    }
    if (isLast)
    {
      break;
    }
  }
  requireRoot(file);
  return file;
}
}
