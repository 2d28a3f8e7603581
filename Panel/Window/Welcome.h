// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// ParaView's window of welcome. It waits for an answer and locks the main window until then.
#ifndef BrainShift_Welcome_h
#define BrainShift_Welcome_h

class QObject;

namespace brainshift
{
/// Closes it if it is open. Returns whether it was.
bool closeWelcome();

/// Closes it as soon as it opens, in the next seconds, while `owner` lives.
void keepWelcomeAway(QObject* owner);
}

#endif
