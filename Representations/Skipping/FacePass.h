// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Draws the faces of the occupied bricks, which bound the part of each ray that is sampled.
 */
#ifndef BrainShift_FacePass_h
#define BrainShift_FacePass_h

namespace brainshift
{
class Program;
struct RayCastScene;

/// Draws the faces with the program of Shaders/Skipping/proxy, which is in use. Only the faces that
/// look towards the eye are drawn if rays end inside the tissue and the eye is outside of it:
/// nothing is gained by knowing where such rays would leave the tissue, and a software driver takes
/// more time for more faces.
void drawFaces(Program& program, const RayCastScene& scene);
}

#endif
