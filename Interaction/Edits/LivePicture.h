// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Pictures of a Free-Form Deformation while something is under the hand, and afterwards.
#ifndef BrainShift_LivePicture_h
#define BrainShift_LivePicture_h

class pqPipelineSource;
class pqView;
class vtkSMProxy;

namespace brainshift
{
/// Draws all views that show a source, at the quality of a moving picture. The source's proxy and
/// `measured` (null: none) announce no new data. The undo stack sees nothing.
void drawMoving(pqPipelineSource* source, vtkSMProxy* measured = nullptr);

/// Draws a view at the quality of a moving picture. Rays of unchanged pixels are not cast again.
void drawRoughly(pqView* view);

/// Lets all views that show a source draw it soon, at full quality.
void drawFully(pqPipelineSource* source);
}

#endif
