// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The units that OME's rules name for axes of space and time.
#ifndef BrainShift_OMEUnits_h
#define BrainShift_OMEUnits_h

#include <optional>
#include <string>

namespace brainshift
{
/** Millimetres in a unit of length, such as "micrometer"; none if it is no such unit. */
std::optional<double> millimetresIn(const std::string& unit);

/** Seconds in a unit of time, such as "millisecond"; none if it is no such unit. */
std::optional<double> secondsIn(const std::string& unit);
}

#endif
