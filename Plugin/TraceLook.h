// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the window shows a Trace Distance for the first time: coloured by distance, with a scale in
/// mm.
#ifndef BrainShift_TraceLook_h
#define BrainShift_TraceLook_h

class pqDataRepresentation;

namespace brainshift
{
/// Colours a representation of a Trace Distance by signed distance: white at the cortex, green
/// outside, purple inside. Hides the traced points that the filter was made of. Other
/// representations stay as they are.
void showByDistance(pqDataRepresentation* display);
}

#endif
