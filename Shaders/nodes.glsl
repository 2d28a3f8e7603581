// The refined displacement field: trilinear between nodes, from the nodes themselves, because a
// texture unit's own filter has too few bits for the solver. Outside the value of the nearest node
// holds. The same as NodeField in C++. Node numbers are floats: software drivers turn what becomes
// an integer lane by lane.

uniform sampler3D refined; // displacement on the nodes, lattice cells; unfiltered
uniform ivec3 refinedCount;
uniform int perCell;       // nodes for each lattice cell

struct NodeCell
{
  vec3 low;
  vec3 high;
  vec3 within;
  vec3 inside; // 1 along an axis on which the position lies within the nodes, else 0
};

NodeCell nodeCell(vec3 lattice)
{
  vec3 anywhere = lattice * float(perCell);
  vec3 node = clamp(anywhere, vec3(0.0), vec3(refinedCount - 1));
  NodeCell cell;
  cell.inside = vec3(equal(anywhere, node));
  cell.low = min(floor(node), vec3(max(refinedCount - 2, ivec3(0))));
  cell.high = min(cell.low + 1.0, vec3(refinedCount - 1));
  cell.within = node - cell.low;
  return cell;
}

vec3 valueAtNode(vec3 node)
{
  return textureLod(refined, (node + 0.5) / vec3(refinedCount), 0.0).xyz;
}

// The displacement at the nearest node: one read.
vec3 displacementNear(vec3 rest)
{
  return valueAtNode(rest * float(perCell));
}

// The corners of the cell asked for last: the solver's last steps mostly stay in one.
vec3 heldLow = vec3(-1.0);
vec3 held[8];

void hold(NodeCell cell)
{
  if (cell.low == heldLow)
  {
    return;
  }
  heldLow = cell.low;
  for (int i = 0; i < 8; ++i)
  {
    held[i] = valueAtNode(vec3((i & 1) == 1 ? cell.high.x : cell.low.x,
      (i >> 1 & 1) == 1 ? cell.high.y : cell.low.y, i >> 2 == 1 ? cell.high.z : cell.low.z));
  }
}

void forwardMap(vec3 rest, out vec3 displacement, out mat3 jacobian)
{
  NodeCell cell = nodeCell(rest);
  hold(cell);
  vec3 w = cell.within;
  // Edges along x, then faces along y.
  vec3 edge[4];
  vec3 alongEdge[4];
  for (int i = 0; i < 4; ++i)
  {
    alongEdge[i] = held[2 * i + 1] - held[2 * i];
    edge[i] = held[2 * i] + w.x * alongEdge[i];
  }
  vec3 near = mix(edge[0], edge[1], w.y);
  vec3 far = mix(edge[2], edge[3], w.y);
  displacement = mix(near, far, w.z);
  vec3 alongX =
    mix(mix(alongEdge[0], alongEdge[1], w.y), mix(alongEdge[2], alongEdge[3], w.y), w.z);
  vec3 alongY = mix(edge[1] - edge[0], edge[3] - edge[2], w.z);
  vec3 scale = cell.inside * float(perCell);
  jacobian = mat3(1.0) + mat3(alongX * scale.x, alongY * scale.y, (far - near) * scale.z);
}
