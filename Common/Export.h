// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Marks what other libraries may call of code that knows no VTK and so no export macro of a VTK
/// module: the parallel loop, and the deformation core with what stands on it.
///
/// That code is compiled with hidden visibility. CMake defines the macros that tell the cases
/// apart: - `BRAINSHIFT_COMMON_BUILD`, `BRAINSHIFT_DEFORMATION_BUILD`: the library that takes the
/// code in. - `BRAINSHIFT_DEFORMATION_DIRECT`: a program that links the objects without that
/// library. - neither: a library or program that calls the code through that library.
#ifndef BrainShift_Export_h
#define BrainShift_Export_h

#if defined(_WIN32)
#define BRAINSHIFT_GIVES __declspec(dllexport)
#define BRAINSHIFT_TAKES __declspec(dllimport)
#else
#define BRAINSHIFT_GIVES __attribute__((visibility("default")))
#define BRAINSHIFT_TAKES BRAINSHIFT_GIVES
#endif

#if defined(BRAINSHIFT_DEFORMATION_DIRECT)
#define BRAINSHIFT_COMMON_EXPORT
#elif defined(BRAINSHIFT_COMMON_BUILD)
#define BRAINSHIFT_COMMON_EXPORT BRAINSHIFT_GIVES
#else
#define BRAINSHIFT_COMMON_EXPORT BRAINSHIFT_TAKES
#endif

#if defined(BRAINSHIFT_DEFORMATION_DIRECT)
#define BRAINSHIFT_DEFORMATION_EXPORT
#elif defined(BRAINSHIFT_DEFORMATION_BUILD)
#define BRAINSHIFT_DEFORMATION_EXPORT BRAINSHIFT_GIVES
#else
#define BRAINSHIFT_DEFORMATION_EXPORT BRAINSHIFT_TAKES
#endif

#endif
