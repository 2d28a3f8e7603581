// The presence map in the deformed frame: whether anything can be seen in a brick, for any lattice.
// What the ray caster evaluates is trilinear between nodes, so over a brick the offset lies between
// the least and the greatest of the nodes its cells touch. The brick, moved by these, is asked of
// the rest volume's summed visibility: that never misses a visible sample. See
// ARCHITECTURE.md, "Skipping".

uniform sampler3D summed;        // visible bricks with lower indices; one more a side than bricks
uniform ivec3 restBricks;        // bricks a side of the rest volume
uniform float brickSide;         // voxels, deformed frame
uniform float restBrickSide;     // voxels, rest volume
uniform ivec3 firstBrick;        // the target's first brick; below 0 beyond the volume
uniform float margin;            // voxels, how much more than the brick is looked at to every side
uniform vec3 lowestVoxel;        // the volume's box, voxels
uniform vec3 highestVoxel;

#ifdef DEFORMED
uniform sampler3D offsets;       // the volume's texture coordinates; unfiltered
uniform ivec3 offsetCount;
uniform vec3 voxelsFromOffset;   // voxels for one unit of an offset
uniform vec3 nodesFromVoxel;     // node = voxel * nodesFromVoxel + nodesFromVoxelShift
uniform vec3 nodesFromVoxelShift;

// One node. A software driver reads a texture whose filter is off in a third of texelFetch's time.
vec3 offsetOf(ivec3 node)
{
  return textureLod(offsets, (vec3(node) + 0.5) / vec3(offsetCount), 0.0).xyz;
}

// Widens a box by the offsets of all nodes that touch it.
void widenByOffsets(inout vec3 low, inout vec3 high)
{
  ivec3 end = offsetCount - 1;
  ivec3 first = clamp(ivec3(floor(low * nodesFromVoxel + nodesFromVoxelShift)), ivec3(0), end);
  ivec3 last = clamp(ivec3(ceil(high * nodesFromVoxel + nodesFromVoxelShift)), ivec3(0), end);
  vec3 least = vec3(1e30);
  vec3 greatest = vec3(-1e30);
  ivec3 node = first;
  while (node.z <= last.z)
  {
    vec3 offset = offsetOf(node);
    least = min(least, offset);
    greatest = max(greatest, offset);
    // One loop that carries over: nested ones are miscompiled by old software drivers.
    node.x += 1;
    bool rowDone = node.x > last.x;
    node.x = rowDone ? first.x : node.x;
    node.y += rowDone ? 1 : 0;
    bool layerDone = node.y > last.y;
    node.y = layerDone ? first.y : node.y;
    node.z += layerDone ? 1 : 0;
  }
  low += least * voxelsFromOffset;
  high += greatest * voxelsFromOffset;
}
#endif

float sumAt(int x, int y, int z)
{
  return textureLod(summed, (vec3(x, y, z) + 0.5) / vec3(restBricks + 1), 0.0).r;
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

bool present(ivec3 brick)
{
  vec3 low = vec3(brick) * brickSide - margin;
  vec3 high = low + brickSide + 2.0 * margin;
#ifdef DEFORMED
  widenByOffsets(low, high);
#endif
  low = max(low, lowestVoxel);
  high = min(high, highestVoxel);
  if (any(greaterThan(low, high + 1.0))) // one voxel for rounding
  {
    return false;
  }
  ivec3 last = restBricks - 1;
  // A rest brick knows of `margin` around it.
  ivec3 from = clamp(ivec3(floor((low + margin) / restBrickSide)), ivec3(0), last);
  ivec3 to = clamp(ivec3(ceil((high - margin) / restBrickSide)) - 1, from, last);
  return visibleBricks(from, to) > 0.5;
}

void main()
{
  gl_FragData[0] = vec4(present(firstBrick + targetTexel()) ? 1.0 : 0.0);
}
