// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Slices of one volume in several views, bent in some and as loaded in others.
#ifndef BrainShift_SameTissue_h
#define BrainShift_SameTissue_h

class vtkSMProxy;

namespace brainshift
{
/// Lets the slices of the same volume in other views go through the same tissue as those of a
/// display, bent there or not. It renders nothing.
void followInOtherViews(vtkSMProxy* display);
}

#endif
