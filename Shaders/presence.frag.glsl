// The presence map in the deformed frame: whether anything can be seen in a brick, for any lattice.
// What the ray caster evaluates is trilinear between nodes, so over a brick the offset lies between
// the least and the greatest of the nodes its cells touch. That box, asked of the rest volume's
// summed visibility, never misses a visible sample. See ARCHITECTURE.md, "Skipping".

uniform sampler3D summed;        // visible bricks with lower indices; one more a side than bricks
uniform ivec3 restBricks;        // bricks a side of the rest volume
uniform float brickSide;         // voxels, deformed frame
uniform float restBrickSide;     // voxels, rest volume
uniform ivec3 firstBrick;        // the target's first brick; below 0 beyond the volume
uniform vec3 lowestVoxel;        // the volume's box, voxels
uniform vec3 highestVoxel;

#ifdef DEFORMED
uniform sampler3D offsets;       // the volume's texture coordinates
uniform ivec3 offsetCount;
uniform vec3 voxelsFromOffset;   // voxels for one unit of an offset
uniform vec3 nodesFromVoxel;     // node = voxel * nodesFromVoxel + nodesFromVoxelShift
uniform vec3 nodesFromVoxelShift;

// Widens a box by all offsets found on it.
void widenByOffsets(inout vec3 low, inout vec3 high)
{
  ivec3 last = offsetCount - 1;
  ivec3 from = clamp(ivec3(floor(low * nodesFromVoxel + nodesFromVoxelShift)), ivec3(0), last);
  ivec3 to = clamp(ivec3(ceil(high * nodesFromVoxel + nodesFromVoxelShift)), ivec3(0), last);
  vec3 least = vec3(1e30);
  vec3 greatest = vec3(-1e30);
  ivec3 node = from;
  while (node.z <= to.z)
  {
    vec3 offset = texelFetch(offsets, node, 0).xyz;
    least = min(least, offset);
    greatest = max(greatest, offset);
    // One loop that carries over: nested ones are miscompiled by old software drivers.
    node.x += 1;
    bool rowDone = node.x > to.x;
    node.x = rowDone ? from.x : node.x;
    node.y += rowDone ? 1 : 0;
    bool layerDone = node.y > to.y;
    node.y = layerDone ? from.y : node.y;
    node.z += layerDone ? 1 : 0;
  }
  low += least * voxelsFromOffset;
  high += greatest * voxelsFromOffset;
}
#endif

float sumAt(int x, int y, int z)
{
  return texelFetch(summed, ivec3(x, y, z), 0).r;
}

// Visible bricks from `low` to `high`, both included.
float visibleBricks(ivec3 low, ivec3 high)
{
  ivec3 above = high + 1;
  float back = sumAt(above.x, above.y, above.z) - sumAt(low.x, above.y, above.z) -
    sumAt(above.x, low.y, above.z) + sumAt(low.x, low.y, above.z);
  float front = sumAt(above.x, above.y, low.z) - sumAt(low.x, above.y, low.z) -
    sumAt(above.x, low.y, low.z) + sumAt(low.x, low.y, low.z);
  return back - front;
}

void main()
{
  vec3 low = vec3(firstBrick + targetTexel()) * brickSide;
  vec3 high = low + brickSide;
#ifdef DEFORMED
  widenByOffsets(low, high);
#endif
  low = max(low, lowestVoxel);
  high = min(high, highestVoxel);
  bool present = false;
  if (all(lessThanEqual(low, high + 1.0))) // one voxel for rounding
  {
    ivec3 lastBrick = restBricks - 1;
    // Rest bricks overlap, so the one that begins where the box ends is not needed.
    ivec3 from = clamp(ivec3(floor(low / restBrickSide)), ivec3(0), lastBrick);
    ivec3 to = clamp(ivec3(ceil(high / restBrickSide)) - 1, from, lastBrick);
    present = visibleBricks(from, to) > 0.5;
  }
  gl_FragData[0] = vec4(present ? 1.0 : 0.0);
}
