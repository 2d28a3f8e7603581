// SPDX-License-Identifier: BSD-3-Clause
#ifndef BrainShift_LatticeSpacing_h
#define BrainShift_LatticeSpacing_h

class pqPipelineSource;

// What a Free-Form Deformation's last output and its lattice measure, mm; 0 before there is one.
// From the box along the world's axes, so too much by the corners of a volume that is turned.
struct VolumeSize
{
  double diagonal = 0.0;
  double spacing = 0.0; // the widest between two control points
};

VolumeSize volumeSize(pqPipelineSource* deformation);

#endif
