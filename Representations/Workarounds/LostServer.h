// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Says that a server has ended.
 */
#ifndef BrainShift_LostServer_h
#define BrainShift_LostServer_h

namespace brainshift
{
/**
 * Watches the connection to the server of the active session. When it is lost, one message says so,
 * and how strokes are kept. Without it, ParaView's sockets say "Broken pipe", and no more. In a
 * session without a server this does nothing.
 */
void watchServer();
}

#endif
