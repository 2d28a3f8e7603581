// Refines the lattice along one axis: cubic weights over four control points (paper, section 2).
// Three runs, one an axis, give the tensor product with 12 fetches a node instead of 64.

uniform sampler3D coarse; // displacements, lattice cells; refined already along lower axes
uniform ivec3 axis;       // unit vector
uniform int points;       // control points along the axis
uniform int perCell;      // nodes for each lattice cell
uniform vec4 weights[MAX_PER_CELL]; // of the four control points at each node of a cell, from C++

#ifdef MASKED
uniform sampler3D maskWeights; // share of the displacement that holds at each node
#endif

// The control point, or node, of number `along` on the axis; the last ones repeat.
vec3 coarseAt(vec3 across, float along)
{
  vec3 texel = across + clamp(along, 0.0, float(points - 1)) * vec3(axis);
  return textureLod(coarse, (texel + 0.5) / vec3(textureSize(coarse, 0)), 0.0).xyz;
}

void main()
{
  vec3 texel = targetTexel();
  vec3 across = texel * vec3(1 - axis);
  float node = dot(texel, vec3(axis));
  float cell = floor((node + 0.5) / float(perCell));
  vec4 weight = weights[int(node - cell * float(perCell) + 0.5)];
  vec3 sum = weight.x * coarseAt(across, cell - 1.0) + weight.y * coarseAt(across, cell) +
    weight.z * coarseAt(across, cell + 1.0) + weight.w * coarseAt(across, cell + 2.0);
#ifdef MASKED
  sum *= textureLod(maskWeights, (texel + 0.5) / vec3(textureSize(maskWeights, 0)), 0.0).x;
#endif
  gl_FragData[0] = vec4(sum, 0.0);
}
