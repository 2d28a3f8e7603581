// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Filters/Electrodes/ContactArrays.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

namespace brainshift
{
namespace
{
std::optional<ArrayKind> kindNamed(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  static const std::map<std::string, ArrayKind> kinds{ { "grid", ArrayKind::Grid },
    { "strip", ArrayKind::Strip }, { "depth", ArrayKind::Depth }, { "seeg", ArrayKind::Depth } };
  const auto found = kinds.find(word);
  return found == kinds.end() ? std::optional<ArrayKind>() : found->second;
}
}

ArrayHint hintIn(const std::string& text)
{
  const auto refuse = [&](const std::string& word) {
    throw Problem("The hint \"" + text + "\" says \"" + word +
      "\"; a hint is a group, =, and a shape such as 8x8, a kind (grid, strip, depth) or a pitch "
      "such as 10mm");
  };
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos)
  {
    refuse(text);
  }
  ArrayHint hint;
  hint.group = text.substr(0, equals);
  std::istringstream words(text.substr(equals + 1));
  for (std::string word; words >> word;)
  {
    const std::size_t times = word.find_first_of("xX");
    const bool isPitch = word.size() > 2 && word.compare(word.size() - 2, 2, "mm") == 0;
    if (const std::optional<ArrayKind> kind = kindNamed(word))
    {
      hint.kind = *kind;
    }
    else if (isPitch)
    {
      hint.pitchMm = numberIn(word.substr(0, word.size() - 2)).value_or(0.0);
      if (!(hint.pitchMm > 0.0 && hint.pitchMm <= 100.0))
      {
        refuse(word);
      }
    }
    else
    {
      constexpr int Most = 64; // of rows and of columns
      hint.rows = times == std::string::npos ? 0 : numberIn<int>(word.substr(0, times)).value_or(0);
      hint.columns =
        times == std::string::npos ? 0 : numberIn<int>(word.substr(times + 1)).value_or(0);
      if (hint.rows < 1 || hint.rows > Most || hint.columns < 1 || hint.columns > Most)
      {
        refuse(word);
      }
    }
  }
  return hint;
}
}
