// SPDX-License-Identifier: BSD-3-Clause
// How Trace Distance looks when it is first shown in the window: by distance, with a scale in mm.
#ifndef BrainShift_TraceLook_h
#define BrainShift_TraceLook_h

class pqDataRepresentation;

// If it shows a Trace Distance, colours it white at the cortex, red outside and blue inside, as far
// as the distances go; hides the points it was made of.
void showByDistance(pqDataRepresentation* shown);

#endif
