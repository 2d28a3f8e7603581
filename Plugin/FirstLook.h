// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The first picture of a volume: without background, in natural colours, filling the view.
#ifndef BrainShift_FirstLook_h
#define BrainShift_FirstLook_h

class pqDataRepresentation;

namespace brainshift
{
/// Gives a Deformed Volume without colours an array to colour by, and its first look, or the one
/// that the user chose last for volumes of its kind. Volumes that the pipeline makes of each other
/// share their colours; another volume with an array of the same name gets colours of its own. The
/// camera turns to the tissue (FirstSight.h). A choice that the user made stays.
///
/// A label map has no look. Its reader's first picture is its outline, so that it covers nothing.
/// A volume of one constant value has no look either, but remains drawn as ParaView draws it.
void showFirstLook(pqDataRepresentation* display);

/// Gives a filter's volume the look of its input. ParaView colours it by its array's name, which
/// may mean the colours of another volume. The scale of colours is hidden unless the user
/// asked for it before.
void joinLook(pqDataRepresentation* display);

/// Gives a display the colours and opacities of another one, as its own.
void shareColors(pqDataRepresentation* display, pqDataRepresentation* from);

/// The first point array of a volume, else the first of all, becomes the one to colour by.
void colorByFirstArray(pqDataRepresentation* display);

// How the window shows a Trace Distance for the first time: coloured by distance, with a scale in
// mm.

/// Colours a representation of a Trace Distance by signed distance: white at the cortex, green
/// outside, purple inside. Hides the traced points that the filter was made of. Other
/// representations stay as they are.
void showByDistance(pqDataRepresentation* display);
}

#endif
