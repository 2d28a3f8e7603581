// Refines the lattice along one axis: cubic weights over four control points (paper, section 2).
// Three runs, one for each axis, give the tensor product with 12 instead of 64 fetches per node.

uniform sampler3D coarse; // displacements, lattice cells; refined already along lower axes
uniform vec3 coarseTexel; // one control point, or node, texture coordinates
uniform vec3 axis;        // unit vector
uniform float points;     // control points along the axis
uniform float perCell;    // nodes for each lattice cell
uniform vec3 firstNode;   // the target's first node, counted from the lattice's first node
// Weights of the four control points, from the powers 0 to 3 of the place in a cell.
uniform mat4 weights;

#ifdef MASKED
uniform sampler3D maskWeights; // fraction of the displacement that holds at each node
uniform vec3 maskTexel;        // one node, texture coordinates
#endif

// The control point or node with number `along` on the axis. Beyond the ends, the last one repeats.
vec3 coarseAt(vec3 across, float along)
{
  vec3 place = across + (clamp(along, 0.0, points - 1.0) + 0.5) * (axis * coarseTexel);
  return textureLod(coarse, place, 0.0).xyz;
}

void main()
{
  vec3 texel = targetTexel();
  vec3 across = (texel + 0.5) * (1.0 - axis) * coarseTexel;
  float node = dot(texel + firstNode, axis);
  float cell = floor((node + 0.5) / perCell);
  float t = (node - cell * perCell) / perCell;
  vec4 weight = weights * vec4(1.0, t, t * t, t * t * t);
  vec3 sum = weight.x * coarseAt(across, cell - 1.0) + weight.y * coarseAt(across, cell) +
    weight.z * coarseAt(across, cell + 1.0) + weight.w * coarseAt(across, cell + 2.0);
#ifdef MASKED
  sum *= textureLod(maskWeights, (texel + firstNode + 0.5) * maskTexel, 0.0).x;
#endif
  gl_FragData[0] = vec4(sum, 0.0);
}
