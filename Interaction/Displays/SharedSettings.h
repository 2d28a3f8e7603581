// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the user chose for all sessions on the page BrainShift of Edit > Settings.
#ifndef BrainShift_SharedSettings_h
#define BrainShift_SharedSettings_h

class vtkSMProxy;

namespace brainshift
{
/// The settings; null if there is no session.
vtkSMProxy* sharedSettings();

/// Whether good and bad, own and other are distinguished by blue and orange instead of green and
/// red. Default false.
bool wantsBlueAndOrange();
}

#endif
