// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Window and level of slices: their own, one for each volume, and never the colours of a 3D look.
#ifndef BrainShift_SliceGreys_h
#define BrainShift_SliceGreys_h

class pqDataRepresentation;

namespace brainshift
{
/// Gives Deformed Slices that have the colours of a look greys instead: those of other slices of
/// the volume, or new ones that span its tissue. Colours that the user chose stay. It acts a moment
/// later, when all who set colours are done, and is no step to undo.
void keepGreysSoon(pqDataRepresentation* display);

/// Gives a display that is shown otherwise back the colours that it had before it was shown as
/// slices. This belongs to the step that changes the representation: undo must find the same
/// change of the display, and redo too. Where they are not known, as after Four Views or in a state
/// file, a Deformed Volume gets those of another one of its volume, else a first look.
void takeColorsBack(pqDataRepresentation* display);
}

#endif
