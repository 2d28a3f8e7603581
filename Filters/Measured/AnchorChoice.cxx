// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Measured/AnchorChoice.h"

#include <glm/geometric.hpp>

namespace brainshift
{
bool AnchorChoice::Key::operator==(const Key& other) const
{
  return this->cortex == other.cortex && this->maskTime == other.maskTime &&
    this->ball.centre == other.ball.centre && this->ball.radiusMm == other.ball.radiusMm;
}

const std::vector<SurfacePoint>& AnchorChoice::beside(
  const OpeningBall& ball, const CortexSource& cortex)
{
  const auto makeIsOpen = [&ball]() -> IsOpen {
    return [&ball](const glm::dvec3& rest) {
      return glm::distance(rest, ball.centre) < ball.radiusMm + AnchorMarginMm;
    };
  };
  return this->find({ cortex.version(), 0, ball }, makeIsOpen, cortex);
}

const std::vector<SurfacePoint>& AnchorChoice::beside(
  std::uint64_t maskTime, const std::function<IsOpen()>& makeIsOpen, const CortexSource& cortex)
{
  return this->find({ cortex.version(), maskTime, {} }, makeIsOpen, cortex);
}

const std::vector<SurfacePoint>& AnchorChoice::find(
  const Key& key, const std::function<IsOpen()>& makeIsOpen, const CortexSource& cortex)
{
  if (!(this->Known == key))
  {
    this->Known.reset(); // if memory runs out
    this->Anchors = chooseAnchors(cortex.cortex().points(), makeIsOpen());
    this->Known = key;
  }
  return this->Anchors;
}
}
