// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// TEST_HAND_EXPORT, which makes a function visible to test_hand.py.
#ifndef BrainShift_TestHandExport_h
#define BrainShift_TestHandExport_h

#if defined(_WIN32)
#define TEST_HAND_EXPORT extern "C" __declspec(dllexport)
#else
#define TEST_HAND_EXPORT extern "C" __attribute__((visibility("default")))
#endif

#endif
