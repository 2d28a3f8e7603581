// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Tables/ColumnOfNames.h"

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <array>
#include <functional>

namespace brainshift
{
namespace
{
// Words in the names of columns of names, in the languages of Europe. A column of words needs none.
constexpr std::array<const char*, 44> NameWords{ "label", "name", "electrode", "contact", "channel",
  "id", "landmark", "point", "title", "fiducial", "marker", "mark", "number", "no", "nr", "index",
  "site", "sensor", "optode", "code", "tag", "key", "nom", "nombre", "nome", "naam", "navn", "namn",
  "nazwa", "punkt", "punto", "ponto", "bezeichnung", "elektrode", "kontakt", "marke", "nummer",
  "numero", "etiqueta", "etiquette", "etichetta", "electrodo", "contacto", "elettrodo" };

// Words in the names of columns of anything else.
constexpr std::array<const char*, 35> OtherWords{ "subject", "patient", "participant", "file",
  "filename", "path", "url", "session", "node", "comment", "comments", "kommentar", "note", "notes",
  "description", "desc", "remark", "remarks", "date", "datum", "timestamp", "time", "color",
  "colour", "type", "status", "defined", "visible", "selected", "locked", "unit", "units",
  "coordinatesystem", "space", "frame" };

// Letters and digits between other signs, in small letters; "electrodeName" is two words.
std::vector<std::string> wordsOfColumn(const std::string& written)
{
  std::string spaced;
  for (std::size_t i = 0; i < written.size(); ++i)
  {
    const char letter = written[i];
    const bool isCapital = letter >= 'A' && letter <= 'Z';
    const bool isAfterSmall = i > 0 && written[i - 1] >= 'a' && written[i - 1] <= 'z';
    const bool isSign = std::string("_-.:/()[]#\"").find(letter) != std::string::npos;
    spaced += isCapital && isAfterSmall ? " " : "";
    spaced += isSign ? ' ' : letter;
  }
  return wordsIn(lowerCase(spaced));
}

template <std::size_t Count>
bool hasWord(const std::vector<std::string>& words, const std::array<const char*, Count>& wanted)
{
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    const bool isPlural = word.size() > 3 && word.back() == 's'; // "points"
    const std::string one = isPlural ? word.substr(0, word.size() - 1) : word;
    return std::find(wanted.begin(), wanted.end(), word) != wanted.end() ||
      std::find(wanted.begin(), wanted.end(), one) != wanted.end();
  });
}

bool isNumber(std::string value)
{
  std::replace(value.begin(), value.end(), ',', '.');
  return numberIn(value).has_value();
}
}

ColumnOfNames::ColumnOfNames(
  const std::vector<std::string>& header, const std::vector<std::size_t>& taken)
{
  for (std::size_t i = 0; i < header.size(); ++i)
  {
    if (std::find(taken.begin(), taken.end(), i) != taken.end())
    {
      continue;
    }
    const std::vector<std::string> words = wordsOfColumn(header[i]);
    Candidate candidate;
    candidate.at = i;
    candidate.isPlain = words.size() == 1 && (words[0] == "label" || words[0] == "name");
    candidate.isOther = hasWord(words, OtherWords);
    candidate.isKnown = !candidate.isOther && hasWord(words, NameWords);
    this->Candidates.push_back(std::move(candidate));
  }
}

void ColumnOfNames::add(const std::vector<std::string>& values)
{
  for (Candidate& candidate : this->Candidates)
  {
    const std::string value = candidate.at < values.size() ? trimmed(values[candidate.at]) : "";
    if (value.empty() || lowerCase(value) == "n/a" || candidate.isOther)
    {
      continue;
    }
    candidate.hasWords = candidate.hasWords || !isNumber(value);
    const bool isEnough = candidate.isPlain && !candidate.hashes.empty();
    if (!isEnough && (candidate.isKnown || candidate.hasWords))
    {
      candidate.hashes.push_back(std::hash<std::string>()(value));
    }
  }
}

bool ColumnOfNames::Candidate::differs() const
{
  std::vector<std::size_t> sorted = this->hashes;
  std::sort(sorted.begin(), sorted.end());
  return !sorted.empty() && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

std::optional<ColumnOfNames::Found> ColumnOfNames::find() const
{
  using Rule = bool (*)(const Candidate&);
  constexpr Rule Rules[] = {
    [](const Candidate& one) { return one.isPlain && !one.hashes.empty(); },
    [](const Candidate& one) { return one.isKnown && one.hasWords && one.differs(); },
    [](const Candidate& one) { return one.isKnown && one.differs(); },
    [](const Candidate& one) { return one.hasWords && one.differs(); },
    [](const Candidate& one) { return one.isKnown && !one.hashes.empty(); },
  };
  for (const Rule rule : Rules)
  {
    const auto found = std::find_if(this->Candidates.begin(), this->Candidates.end(), rule);
    if (found != this->Candidates.end())
    {
      return Found{ found->at, !found->isPlain };
    }
  }
  return std::nullopt;
}
}
