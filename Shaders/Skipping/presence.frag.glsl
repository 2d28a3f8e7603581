// The presence map in the deformed frame: whether anything can be seen in a brick, for any lattice.
// What the ray caster evaluates is trilinear between nodes. So over a brick the offset lies between
// the least and the greatest of the nodes that its cells touch. The brick, moved by these offsets,
// covers a box of the rest volume, whose summed visibility says whether anything is visible there.
// That never misses a visible sample, see Representations/Skipping/README.md.

uniform vec3 mapShift;           // texel of brick 0 0 0 of the map
uniform sampler3D summed;        // visible bricks with lower indices; one more a side than bricks
uniform ivec3 restBricks;        // bricks a side of the rest volume
uniform float restBrickSide;     // voxels, rest volume
uniform vec3 lowestVoxel;        // the volume's box, voxels
uniform vec3 highestVoxel;

#ifdef DEFORMED
uniform sampler3D blockLeast;    // least and greatest offset in each block of bricks, voxels
uniform sampler3D blockGreatest;
uniform ivec3 blocks;            // texels of both a side
#endif

// Sums start from 0 again here, so that single precision is exact: SumModulus in RestPresence.h.
const float sumModulus = 2097152.0;

float sumAt(float x, float y, float z)
{
  return textureLod(summed, (vec3(x, y, z) + 0.5) / vec3(restBricks + 1), 0.0).r;
}

// Visible bricks from `low` to `high`, both included, modulo sumModulus.
float visibleBricks(vec3 low, vec3 high)
{
  vec3 above = high + 1.0;
  float back = sumAt(above.x, above.y, above.z) - sumAt(low.x, above.y, above.z) -
    sumAt(above.x, low.y, above.z) + sumAt(low.x, low.y, above.z);
  float front = sumAt(above.x, above.y, low.z) - sumAt(low.x, above.y, low.z) -
    sumAt(above.x, low.y, low.z) + sumAt(low.x, low.y, low.z);
  return mod(back - front, sumModulus);
}

// Whether anything in a box of voxels of the rest volume is visible, and whether all of it is.
bvec2 visibleWithin(vec3 low, vec3 high)
{
  low = max(low, lowestVoxel);
  high = min(high, highestVoxel);
  if (any(greaterThan(low, high + 1.0))) // one voxel for rounding
  {
    return bvec2(false);
  }
  vec3 last = vec3(restBricks - 1);
  // A rest brick knows what lies within `margin` around it.
  vec3 from = clamp(floor((low + margin) / restBrickSide), vec3(0.0), last);
  vec3 to = clamp(ceil((high - margin) / restBrickSide) - 1.0, from, last);
  vec3 side = to - from + 1.0;
  float bricks = side.x * side.y * side.z;
  if (bricks > sumModulus - 0.5) // sums cannot tell all of them from none
  {
    return bvec2(true, false);
  }
  float found = visibleBricks(from, to);
  return bvec2(found > 0.5, found > bricks - 0.5);
}

bool present(vec3 texel)
{
  vec3 low = (vec3(firstBrick) + texel) * brickSide - margin;
  vec3 high = low + brickSide + 2.0 * margin;
  vec3 least = vec3(0.0);
  vec3 greatest = vec3(0.0);
#ifdef DEFORMED
  vec3 place = (floor((texel + 0.5) / float(BRICKS_IN_BLOCK)) + blockShift + 0.5) /
    vec3(blocks);
  least = textureLod(blockLeast, place, 0.0).xyz;
  greatest = textureLod(blockGreatest, place, 0.0).xyz;
  bvec2 inBlock = visibleWithin(low + least, high + greatest);
  if (inBlock.x == inBlock.y)
  {
    return inBlock.x; // the brick's own box lies in the block's
  }
  offsetRange(low, high, least, greatest);
#endif
  return visibleWithin(low + least, high + greatest).x;
}

void main()
{
  gl_FragData[0] = vec4(present(targetTexel() - mapShift) ? 1.0 : 0.0);
}
