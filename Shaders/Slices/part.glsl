// The part of the deformed frame that this MPI rank draws, and the voxels that it has. All ranks
// count texture coordinates from the whole volume, so that they agree to the bit whose pixel it is.

uniform int partCount; // 0: one process draws all of it
uniform vec4 partPlanes[6];
uniform vec3 wholeVoxels; // of the volume, a side
uniform vec3 heldFirst;   // the first voxel that is here
uniform vec3 heldVoxels;  // those that the texture of scalars stands for, a side
uniform int heldNearest;  // 1: voxels are drawn as they are

// A border belongs to the part beyond it.
bool inPart(vec3 deformed)
{
  bool inside = true;
  for (int i = 0; i < partCount; ++i)
  {
    float height = dot(partPlanes[i].xyz, deformed) + partPlanes[i].w;
    inside = inside && (height > 0.0 || (height == 0.0 && i % 2 == 0));
  }
  return inside;
}

// Where the texture has what rests there. Between two voxels, rounding must not choose another one
// than in the texture of the whole volume.
vec3 heldFromRest(vec3 rest)
{
  vec3 voxel = rest * wholeVoxels;
  voxel = heldNearest == 1 ? floor(voxel) + 0.5 : voxel;
  return partCount == 0 ? rest : (voxel - heldFirst) / heldVoxels;
}
