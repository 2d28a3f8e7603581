// SPDX-License-Identifier: BSD-3-Clause
// Which Free-Form Deformation the tools and the toolbar act on.
#ifndef BrainShift_ActiveDeformation_h
#define BrainShift_ActiveDeformation_h

class pqPipelineSource;

bool isDeformation(pqPipelineSource* source);

// The active source if it is a Free-Form Deformation; else the nearest one upstream or downstream
// of it that the active view shows; else the only one there is. Null if there is none.
pqPipelineSource* activeDeformation();

#endif
