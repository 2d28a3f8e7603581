// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// OpenGL's functions.
///
/// VTK changed its loader between the two supported versions of ParaView: GLEW in 5.13, glad in
/// 6.1. Nothing else in this folder depends on which.
#ifndef BrainShift_OpenGL_h
#define BrainShift_OpenGL_h

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
