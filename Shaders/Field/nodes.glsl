// The refined displacement field: trilinear between nodes, from the nodes themselves, because a
// texture unit's own filter has too few bits for the solver. Outside the value of the nearest node
// holds. The same as NodeField in C++. Node numbers are floats: software drivers turn what becomes
// an integer lane by lane.

uniform sampler3D refined;      // displacement on nodes around all that moves, cells; unfiltered
uniform vec3 refinedFromNode;   // its texture coordinates from a node's number: scale, shift
uniform vec3 refinedOfNodeZero;
uniform vec3 lastNode;          // of the lattice
uniform float perCell;          // nodes for each lattice cell

// Of whole number.
vec3 valueAtNode(vec3 node)
{
  return textureLod(refined, node * refinedFromNode + refinedOfNodeZero, 0.0).xyz;
}

// The cell of nodes asked last: the solver's steps mostly stay in one.
vec3 heldLow = vec3(-1.0);
vec3 held[8];    // its corners, x fastest
vec3 heldWithin; // of the position asked last
vec3 heldInside; // 1 along an axis on which that lies within the nodes, else 0

void hold(vec3 lattice)
{
  vec3 anywhere = lattice * perCell;
  vec3 node = clamp(anywhere, vec3(0.0), lastNode);
  vec3 low = min(floor(node), max(lastNode - 1.0, vec3(0.0)));
  heldInside = vec3(equal(anywhere, node));
  heldWithin = node - low;
  if (low == heldLow)
  {
    return;
  }
  heldLow = low;
  vec3 high = min(low + 1.0, lastNode);
  for (int i = 0; i < 8; ++i)
  {
    held[i] = valueAtNode(vec3((i & 1) == 1 ? high.x : low.x, (i >> 1 & 1) == 1 ? high.y : low.y,
      i >> 2 == 1 ? high.z : low.z));
  }
}

vec3 displacementAt(vec3 rest)
{
  hold(rest);
  vec3 near = mix(
    mix(held[0], held[1], heldWithin.x), mix(held[2], held[3], heldWithin.x), heldWithin.y);
  vec3 far = mix(
    mix(held[4], held[5], heldWithin.x), mix(held[6], held[7], heldWithin.x), heldWithin.y);
  return mix(near, far, heldWithin.z);
}

mat3 jacobianThere()
{
  vec3 w = heldWithin;
  // Edges along x, then faces along y.
  vec3 edge[4];
  vec3 alongEdge[4];
  for (int i = 0; i < 4; ++i)
  {
    alongEdge[i] = held[2 * i + 1] - held[2 * i];
    edge[i] = held[2 * i] + w.x * alongEdge[i];
  }
  vec3 alongX =
    mix(mix(alongEdge[0], alongEdge[1], w.y), mix(alongEdge[2], alongEdge[3], w.y), w.z);
  vec3 alongY = mix(edge[1] - edge[0], edge[3] - edge[2], w.z);
  vec3 alongZ = mix(edge[2], edge[3], w.y) - mix(edge[0], edge[1], w.y);
  vec3 scale = heldInside * perCell;
  return mat3(1.0) + mat3(alongX * scale.x, alongY * scale.y, alongZ * scale.z);
}
