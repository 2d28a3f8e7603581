// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a user can do about a file that is refused.
#ifndef BrainShift_WayOut_h
#define BrainShift_WayOut_h

#include "Common/Problem.h"

#include <exception>
#include <string>

namespace brainshift
{
/**
 * A reason with a way out at its end, unless it has one: behind a semicolon or a full stop, a verb
 * that tells the reader what to do, such as "open" or "choose". A limit that a number of the file
 * must keep is none. Work that was stopped needs none.
 */
std::string withWayOut(const std::string& reason, const std::string& wayOut);

/**
 * What the library of JSON says of text that is none, as the end of a sentence. Its advice is for
 * programmers, so it is left out.
 */
std::string badJson(const std::exception& error);

/** Reads a file, as withBeginning does. A reason without a way out gets one. */
template <typename Step>
decltype(auto) withWayOut(const std::string& beginning, const std::string& wayOut, const Step& step)
{
  try
  {
    return step();
  }
  catch (const Problem& problem)
  {
    throw Problem(beginning + withWayOut(problem.what(), wayOut));
  }
}
}

#endif
