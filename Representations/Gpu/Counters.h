// SPDX-License-Identifier: BSD-3-Clause
// What the renderer did, since it was made: proof that only what changed is done again.
#ifndef BrainShift_Counters_h
#define BrainShift_Counters_h

#include <cstdint>

namespace brainshift
{
struct Counters
{
  std::int64_t frames = 0;          // images ray cast
  std::int64_t pixelsCast = 0;      // of all of them
  std::int64_t volumeUploads = 0;   // scalars sent to the GPU
  std::int64_t latticeUploads = 0;  // control points sent to the GPU
  std::int64_t transferUploads = 0; // colour and opacity maps sent to the GPU
  std::int64_t segmentUploads = 0;  // segments sent to the GPU, to be drawn alone
  std::int64_t bytesUploaded = 0;   // all of them together
  std::int64_t texelsRefined = 0;   // nodes of the offset field computed
  std::int64_t presenceUpdates = 0; // times the deformed presence map was computed
  std::int64_t skippingBytes = 0; // of that map, sent back as faces and leaps; not in bytesUploaded
  std::int64_t samplesTaken = 0;  // while CountSamples is on, in the part of the image that is cast
  std::int64_t samplesSkipped = 0;   // before a ray's end; likewise
  std::int64_t imageScale = 1;       // screen pixels a side for one pixel of the last image
  std::int64_t programsCompiled = 0; // shader programs compiled and linked

  // How things are, not what was done.
  std::int64_t gpuScalarBytes = 0;       // textures of the volume's scalars
  std::int64_t gpuOtherBytes = 0;        // all other textures and buffers
  std::int64_t gpuFieldMicroseconds = 0; // the GPU's last run from control points to offset field
};
}

#endif
