// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The camera of a view where a volume is shown for the first time.
#ifndef BrainShift_FirstSight_h
#define BrainShift_FirstSight_h

#include <vector>

class pqDataRepresentation;
class pqPipelineSource;

namespace brainshift
{
/// The source of a display. A display's own input comes later than the display.
pqPipelineSource* sourceOf(pqDataRepresentation* display);

/// Whether a source is another one, or made of it.
bool isMadeOf(pqPipelineSource* source, pqPipelineSource* other);

/// Remembers where the tissue of a display's volume is, for all volumes that are made of it.
/// `points`: x y z after each other, mm, world: the farthest ones (FarPoints).
void noteTissue(pqDataRepresentation* display, const std::vector<double>& points);

/// Aims the camera at the tissue of all visible volumes of the view, if the user has not moved it.
/// Outlines of masks do not count. A camera that the user moved stays if the volume of `display` is
/// in sight; if not, it keeps its direction and moves until all is seen. A volume that is alone in
/// its view is seen whole unless the user has turned the camera.
void bringIntoSight(pqDataRepresentation* display);
}

#endif
