// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Measured/FitWords.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <vector>

namespace brainshift
{
namespace
{
constexpr double FarTurnDegrees = 10.0; // more than this is rather a wrong pair
}

std::string wordsOnFit(const FittedLattice& fitted, const std::string& unmatched, bool isInCavity)
{
  std::vector<std::string> words;
  if (!unmatched.empty())
  {
    words.push_back("Without a partner: " + unmatched);
  }
  if (isInCavity)
  {
    words.emplace_back("All traced points lie in the cavity and do not count");
  }
  const double turn = glm::degrees(glm::length(vectorFrom(fitted.fit().rigid().rotation)));
  if (turn > FarTurnDegrees && fitted.fit().isTurnExpectedSmall())
  {
    words.push_back("The volume turned by " + std::to_string(turn) +
      " degrees, more than so few pairs can prove; check that the pairs match");
  }
  if (fitted.share() < 1.0)
  {
    words.push_back("The fold guard applied " + std::to_string(fitted.share()) + " of the bend");
  }
  else if (fitted.relaxation() > 1.0)
  {
    words.emplace_back("The fold guard trusted what was measured less, so that no tissue folds");
  }
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : ". ") + word;
  }
  return text;
}
}
