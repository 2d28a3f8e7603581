// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Self-similarity of the surroundings of a point: 12 numbers that do not change with contrast,
/// brightness or inversion.
///
/// Method: the self-similarity context (SSC) of Heinrich et al., Towards Realtime Multimodal Fusion
/// for Image-Guided Interventions Using Self-Similarities, MICCAI 2013. Each number compares two of
/// the six neighbours at `SelfSimilarityDistance`.
#ifndef BrainShift_SelfSimilarity_h
#define BrainShift_SelfSimilarity_h

#include "Filters/Register/Similarity.h"

namespace brainshift
{
constexpr int SelfSimilarityNumbers = 12;
constexpr int SelfSimilarityDistance = 2; ///< points between the middle and its neighbours
constexpr int SelfSimilarityRadius = 1;   ///< points, of the boxes that are compared

/** Points around a point that its numbers depend on. */
constexpr Support SelfSimilaritySupport{ SelfSimilarityDistance + SelfSimilarityRadius,
  SelfSimilarityRadius };

/** The 12 numbers (0 to 1) of each point, interleaved. */
BRAINSHIFT_DEFORMATION_EXPORT UnsetVector<float> selfSimilarity(const Volume& volume);

/** The 12 numbers as a descriptor. */
Descriptor selfSimilarityDescriptor();

/** The mean squared difference of the 12 numbers of both volumes. */
Metric selfSimilarityMetric();

/** The same by a quarter of the samples. */
Metric thinSelfSimilarity();

/**
 * The squared difference of the numbers of both volumes and of those of their edges, half each, by
 * a quarter of the samples. Edges are the lengths of gradients; where the direction of an
 * ultrasound beam is known, the rise along it of the reference and of the volume's gradient
 * lengths. Samples count by the steepness of the volume. The quicker part takes half of these, if
 * they are many.
 */
Metric thinSelfSimilarityWithEdges();
}

#endif
