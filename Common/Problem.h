// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The exception of the core, the filters and the formats: why something cannot be done.
///
/// Its text is one sentence without a full stop. It names the thing, its value, its limit and the
/// way out. The guards of Guard.h catch it where VTK calls, add the full stop and report it.
#ifndef BrainShift_Problem_h
#define BrainShift_Problem_h

#include "Common/Export.h" // for the export macro

#include <stdexcept>
#include <string>

namespace brainshift
{
struct BRAINSHIFT_COMMON_EXPORT Problem : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Throws a sentence as a Problem; does nothing if it is empty. */
inline void throwIfAny(const std::string& sentence)
{
  if (!sentence.empty())
  {
    throw Problem(sentence);
  }
}

/** Runs a step. Returns the sentence of the Problem that it threw; empty if it threw none. */
template <typename Step>
std::string problemOf(const Step& step)
{
  try
  {
    step();
    return {};
  }
  catch (const Problem& problem)
  {
    return problem.what();
  }
}

/** Runs a step and returns what it does. A Problem that it throws gets a beginning. */
template <typename Step>
decltype(auto) withBeginning(const std::string& beginning, const Step& step)
{
  try
  {
    return step();
  }
  catch (const Problem& problem)
  {
    throw Problem(beginning + problem.what());
  }
}
}

#endif
