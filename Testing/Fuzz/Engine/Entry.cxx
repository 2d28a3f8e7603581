// SPDX-License-Identifier: BSD-3-Clause
// What libFuzzer calls with each case: the parser that CMake names.
#include "Common/Problem.h"
#include "Testing/Fuzz/Engine/Parsers.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  try
  {
    brainshift::fuzz::BRAINSHIFT_PARSER(std::string(data, data + size));
  }
  catch (const brainshift::Problem&)
  {
    // a refusal; any other exception ends the program, which libFuzzer reports
  }
  return 0;
}
