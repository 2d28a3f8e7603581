// Bricks of the deformed frame, and the offsets found in them.

uniform float brickSide;         // voxels
uniform ivec3 firstBrick;        // the map's first brick; below 0 beyond the volume
uniform float margin;            // voxels around a brick that are looked at, too

#ifdef DEFORMED
uniform sampler3D offsets;       // the volume's texture coordinates; unfiltered
uniform ivec3 offsetCount;
uniform vec3 voxelsFromOffset;   // voxels for one unit of an offset
uniform vec3 voxelsFromLattice;  // voxels for one lattice cell
uniform vec3 nodesFromVoxel;     // node = voxel * nodesFromVoxel + nodesFromVoxelShift
uniform vec3 nodesFromVoxelShift;
uniform vec3 blockShift;         // texel of block 0 0 0 among the blocks

// The offset of one node; its number is whole. The fourth number: how far corrections around it
// reach, lattice cells. A software driver needs a third of texelFetch's time to read a texture
// without a filter, and it converts floats to integers lane by lane.
vec4 offsetOf(vec3 node)
{
  return textureLod(offsets, (node + 0.5) / vec3(offsetCount), 0.0);
}

// Least and greatest offset, voxels, in all cells of nodes that touch a box of voxels.
void offsetRange(vec3 low, vec3 high, out vec3 least, out vec3 greatest)
{
  vec3 end = vec3(offsetCount - 1);
  vec3 first = clamp(floor(low * nodesFromVoxel + nodesFromVoxelShift), vec3(0.0), end);
  vec3 last = clamp(ceil(high * nodesFromVoxel + nodesFromVoxelShift), vec3(0.0), end);
  least = vec3(1e30);
  greatest = vec3(-1e30);
  float reach = 0.0;
  vec3 node = first;
  while (node.z <= last.z)
  {
    vec4 offset = offsetOf(node);
    least = min(least, offset.xyz);
    greatest = max(greatest, offset.xyz);
    reach = max(reach, offset.w);
    // One loop with carries, because old software drivers miscompile nested loops.
    node.x += 1.0;
    bool rowDone = node.x > last.x;
    node.x = rowDone ? first.x : node.x;
    node.y += rowDone ? 1.0 : 0.0;
    bool layerDone = node.y > last.y;
    node.y = layerDone ? first.y : node.y;
    node.z += layerDone ? 1.0 : 0.0;
  }
  least = least * voxelsFromOffset - reach * voxelsFromLattice;
  greatest = greatest * voxelsFromOffset + reach * voxelsFromLattice;
}
#endif
