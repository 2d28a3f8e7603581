// The refined displacement field: trilinear between nodes, from the nodes themselves, because a
// texture unit's own filter has too few bits for the solver. Outside the value of the nearest node
// holds. The same as NodeField in C++.

uniform sampler3D refined; // displacement on the nodes, lattice cells
uniform ivec3 refinedCount;
uniform int perCell;       // nodes for each lattice cell

struct NodeCell
{
  ivec3 low;
  ivec3 high;
  vec3 within;
  vec3 inside; // 1 along an axis on which the position lies within the nodes, else 0
};

NodeCell nodeCell(vec3 lattice)
{
  vec3 anywhere = lattice * float(perCell);
  vec3 node = clamp(anywhere, vec3(0.0), vec3(refinedCount - 1));
  NodeCell cell;
  cell.inside = vec3(equal(anywhere, node));
  cell.low = min(ivec3(node), max(refinedCount - 2, ivec3(0)));
  cell.high = min(cell.low + 1, refinedCount - 1);
  cell.within = node - vec3(cell.low);
  return cell;
}

vec3 corner(NodeCell cell, int x, int y, int z)
{
  ivec3 texel = ivec3(x == 1 ? cell.high.x : cell.low.x, y == 1 ? cell.high.y : cell.low.y,
    z == 1 ? cell.high.z : cell.low.z);
  return texelFetch(refined, texel, 0).xyz;
}

void forwardMap(vec3 rest, out vec3 displacement, out mat3 jacobian)
{
  NodeCell cell = nodeCell(rest);
  vec3 w = cell.within;
  vec3 c[8];
  for (int i = 0; i < 8; ++i)
  {
    c[i] = corner(cell, i & 1, (i >> 1) & 1, i >> 2);
  }
  displacement = mix(mix(mix(c[0], c[1], w.x), mix(c[2], c[3], w.x), w.y),
    mix(mix(c[4], c[5], w.x), mix(c[6], c[7], w.x), w.y), w.z);
  vec3 alongX = mix(
    mix(c[1] - c[0], c[3] - c[2], w.y), mix(c[5] - c[4], c[7] - c[6], w.y), w.z);
  vec3 alongY = mix(
    mix(c[2] - c[0], c[3] - c[1], w.x), mix(c[6] - c[4], c[7] - c[5], w.x), w.z);
  vec3 alongZ = mix(
    mix(c[4] - c[0], c[5] - c[1], w.x), mix(c[6] - c[2], c[7] - c[3], w.x), w.y);
  vec3 scale = cell.inside * float(perCell);
  jacobian = mat3(1.0) + mat3(alongX * scale.x, alongY * scale.y, alongZ * scale.z);
}

// One filtered fetch: exact where all eight nodes are zero, which is all it is asked for.
bool staysAt(vec3 rest)
{
  vec3 position = (rest * float(perCell) + 0.5) / vec3(refinedCount);
  return textureLod(refined, position, 0.0).xyz == vec3(0.0);
}
