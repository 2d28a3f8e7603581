// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Masks and label maps that are open: what a volume can be shown by.
#ifndef BrainShift_LabelMaps_h
#define BrainShift_LabelMaps_h

#include <QList>

class pqDataRepresentation;
class pqPipelineSource;

namespace brainshift
{
/// Notes that the volume of a reader is a mask or a label map.
void noteLabelMap(pqPipelineSource* source);

/// The label maps that a display's Free-Form Deformation could take as Segmentation. None if it has
/// one already, or if the display is of another source.
QList<pqPipelineSource*> labelMapsFor(pqDataRepresentation* display);

/// Makes one of them the Segmentation and hides its outline in the view of the display. It belongs
/// into an undo set. Null does nothing.
void segmentBy(pqDataRepresentation* display, pqPipelineSource* labels);
}

#endif
