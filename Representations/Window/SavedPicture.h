// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether a view draws a picture that ParaView is about to save.
#ifndef BrainShift_SavedPicture_h
#define BrainShift_SavedPicture_h

class vtkView;

namespace brainshift
{
bool isToBeSaved(vtkView* view);
}

#endif
