// Bricks of the deformed frame, and the offsets found in them.

uniform float brickSide;         // voxels
uniform ivec3 firstBrick;        // the map's first brick; below 0 beyond the volume
uniform float margin;            // voxels, how much more than a brick is looked at to every side

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

// Least and greatest offset, voxels, of all nodes that touch a box of voxels.
void offsetRange(vec3 low, vec3 high, out vec3 least, out vec3 greatest)
{
  ivec3 end = offsetCount - 1;
  ivec3 first = clamp(ivec3(floor(low * nodesFromVoxel + nodesFromVoxelShift)), ivec3(0), end);
  ivec3 last = clamp(ivec3(ceil(high * nodesFromVoxel + nodesFromVoxelShift)), ivec3(0), end);
  least = vec3(1e30);
  greatest = vec3(-1e30);
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
  least *= voxelsFromOffset;
  greatest *= voxelsFromOffset;
}
#endif
