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

void main()
{
  ivec3 texel = targetTexel();
  ivec3 across = texel * (1 - axis);
  int node = texel.x * axis.x + texel.y * axis.y + texel.z * axis.z;
  int cell = node / perCell;
  vec4 weight = weights[node - cell * perCell];
  vec3 sum = weight.x * texelFetch(coarse, across + axis * max(cell - 1, 0), 0).xyz +
    weight.y * texelFetch(coarse, across + axis * cell, 0).xyz +
    weight.z * texelFetch(coarse, across + axis * min(cell + 1, points - 1), 0).xyz +
    weight.w * texelFetch(coarse, across + axis * min(cell + 2, points - 1), 0).xyz;
#ifdef MASKED
  sum *= texelFetch(maskWeights, texel, 0).x;
#endif
  gl_FragData[0] = vec4(sum, 0.0);
}
