// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Marks what other libraries may call of the deformation core.
 *
 * The core is compiled with hidden visibility and becomes a part of the library of the Filters
 * module. Three cases differ, and CMake defines the macro that names each of them:
 *  - `BRAINSHIFT_DEFORMATION_BUILD`: the core itself and the library that takes it in.
 *  - `BRAINSHIFT_DEFORMATION_DIRECT`: a program that links the core's objects without that library.
 *  - neither: a library or program that calls the core through that library.
 */
#ifndef BrainShift_Export_h
#define BrainShift_Export_h

#if defined(BRAINSHIFT_DEFORMATION_DIRECT)
#define BRAINSHIFT_DEFORMATION_EXPORT
#elif defined(_WIN32) && defined(BRAINSHIFT_DEFORMATION_BUILD)
#define BRAINSHIFT_DEFORMATION_EXPORT __declspec(dllexport)
#elif defined(_WIN32)
#define BRAINSHIFT_DEFORMATION_EXPORT __declspec(dllimport)
#else
#define BRAINSHIFT_DEFORMATION_EXPORT __attribute__((visibility("default")))
#endif

#endif
