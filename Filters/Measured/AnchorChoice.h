// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Keeps the anchors of a fit as long as nothing changes that they depend on.
 *
 * Choosing takes a fifth of the processor time of a live step beside traces, and a hand that pulls
 * changes neither the cortex nor the opening.
 */
#ifndef BrainShift_AnchorChoice_h
#define BrainShift_AnchorChoice_h

#include "Filters/Fit/Anchors.h"
#include "Filters/Measured/RestCortex.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace brainshift
{
class AnchorChoice
{
public:
  /** Whether a position (mm, rest frame) is too near to the opening. */
  using IsOpen = std::function<bool(const glm::dvec3&)>;

  /** Anchors on a cortex whose opening is a ball. */
  const std::vector<SurfacePoint>& beside(const OpeningBall& ball, const CortexSource& cortex);

  /**
   * Anchors on a cortex whose opening is a mask.
   *
   * @param maskTime    modification time of the mask's image: another one is another mask
   * @param makeIsOpen  reads the mask; it is called only if the anchors must be chosen
   */
  const std::vector<SurfacePoint>& beside(
    std::uint64_t maskTime, const std::function<IsOpen()>& makeIsOpen, const CortexSource& cortex);

private:
  struct Key
  {
    std::uint64_t cortex = 0;
    std::uint64_t maskTime = 0; // 0: the opening is the ball
    OpeningBall ball;

    bool operator==(const Key& other) const;
  };

  const std::vector<SurfacePoint>& find(
    const Key& key, const std::function<IsOpen()>& makeIsOpen, const CortexSource& cortex);

  std::optional<Key> Known;
  std::vector<SurfacePoint> Anchors;
};
}

#endif
