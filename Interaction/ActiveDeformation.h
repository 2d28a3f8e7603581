// SPDX-License-Identifier: BSD-3-Clause
// Which Free-Form Deformation the tools and the toolbar act on.
#ifndef BrainShift_ActiveDeformation_h
#define BrainShift_ActiveDeformation_h

class pqDataRepresentation;
class pqPipelineSource;
class pqView;

bool isDeformation(pqPipelineSource* source);

// The active source if it is a Free-Form Deformation; else the nearest one upstream or downstream
// of it that a view shows; else the only one there is. Null if there is none.
pqPipelineSource* activeDeformation(pqView* view);
// As the active view shows it.
pqPipelineSource* activeDeformation();

// How a view shows a Free-Form Deformation bent: as Deformed Volume or Deformed Slices, of itself
// or of what a filter like Compare Volumes made of it. Null if it does not.
pqDataRepresentation* shownBent(pqPipelineSource* deformation, pqView* view);
bool showsSlices(pqDataRepresentation* shown);

#endif
