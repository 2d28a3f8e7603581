// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a lattice asks of the field on the GPU.
#ifndef BrainShift_TestFieldRequest_h
#define BrainShift_TestFieldRequest_h

#include "Filters/Deformation/Lattice.h"
#include "Representations/Field/FieldTexture.h"

namespace brainshift::testing
{
inline FieldRequest requestFor(const Lattice& lattice, int samples, Inverse inverse)
{
  FieldRequest request;
  request.dimensions = lattice.grid.dimensions;
  request.kernel = lattice.kernel;
  request.samples = samples;
  request.inverse = inverse;
  request.mask = lattice.mask;
  request.inCells = displacementsInCells(lattice);
  request.nodes = backwardNodes(lattice.grid, request.inCells, samples);
  return request;
}
}

#endif
