// SPDX-License-Identifier: BSD-3-Clause
#ifndef BrainShift_FacePass_h
#define BrainShift_FacePass_h

namespace brainshift
{
class Program;
struct RayCastScene;

// Draws the faces of a scene's occupied bricks with the program of Shaders/proxy, which is in use.
// Where rays end in tissue, and the eye is outside, those alone that look towards it: nothing is
// gained by knowing where such rays would leave the tissue, and a software driver's time goes by
// the number of faces.
void drawFaces(Program& program, const RayCastScene& scene);
}

#endif
