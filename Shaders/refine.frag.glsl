// Refines the lattice along one axis: cubic weights over four control points (paper, section 2).
// Three runs, one an axis, give the tensor product with 12 fetches a node instead of 64.

uniform sampler3D coarse; // displacements, lattice cells; refined already along lower axes
uniform int axis;         // 0, 1 or 2
uniform int points;       // control points along the axis
uniform int perCell;      // nodes for each lattice cell
uniform int kernel;

void main()
{
  ivec3 texel = targetTexel();
  int cell = texel[axis] / perCell;
  vec4 weights = kernelWeights(kernel, float(texel[axis] - cell * perCell) / float(perCell));
  vec3 sum = vec3(0.0);
  for (int tap = 0; tap < 4; ++tap)
  {
    texel[axis] = clamp(cell - 1 + tap, 0, points - 1);
    sum += weights[tap] * texelFetch(coarse, texel, 0).xyz;
  }
  gl_FragData[0] = vec4(sum, 0.0);
}
