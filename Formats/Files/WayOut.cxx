// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/WayOut.h"

namespace brainshift
{
std::string withWayOut(const std::string& reason, const std::string& wayOut)
{
  const auto has = [&reason](const char* words) { return reason.find(words) != std::string::npos; };
  return has("; ") || has(". ") || has("was stopped") ? reason : reason + "; " + wayOut;
}
}
