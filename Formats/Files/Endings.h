// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The choice of a format by the ending of a file's name. `Format` has a function `endings`.
#ifndef BrainShift_Endings_h
#define BrainShift_Endings_h

#include "Formats/Files/Text.h"

#include <string>
#include <vector>

namespace brainshift
{
/** The first format that the ending of a name stands for. Null: none. */
template <typename Format>
const Format* formatByEnding(const std::vector<const Format*>& formats, const std::string& fileName)
{
  for (const Format* format : formats)
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

/** The endings of all formats in words: ".one, .two or .three". */
template <typename Format>
std::string endingsInWords(const std::vector<const Format*>& formats)
{
  std::vector<std::string> all;
  for (const Format* format : formats)
  {
    const std::vector<std::string> endings = format->endings();
    all.insert(all.end(), endings.begin(), endings.end());
  }
  std::string words;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    words.append(i == 0 ? "" : i + 1 == all.size() ? " or " : ", ").append(all[i]);
  }
  return words;
}
}

#endif
