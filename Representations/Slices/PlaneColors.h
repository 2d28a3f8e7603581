// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The colours that name the three planes of Deformed Slices.
 */
#ifndef BrainShift_PlaneColors_h
#define BrainShift_PlaneColors_h

#include <array>

namespace brainshift
{
/// Red, green and blue of the sagittal, the coronal and the axial plane, 0 to 1: yellowish green,
/// blue, orange. They differ in lightness too, so that the colour-blind can tell them apart.
constexpr std::array<std::array<double, 3>, 3> PlaneColors{ { { 0.88, 1.0, 0.25 },
  { 0.30, 0.58, 1.0 }, { 0.92, 0.36, 0.0 } } };

constexpr std::array<const char*, 3> PlaneNames{ "Sagittal", "Coronal", "Axial" };
}

#endif
