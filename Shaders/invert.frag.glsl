// The offset field: for each node of the deformed frame, where the tissue seen there comes from.

uniform ivec3 firstCell;  // lattice cell of the target's first node; below 0 beyond the lattice
uniform vec3 offsetScale; // wanted unit (the volume's texture coordinates) for one lattice cell
uniform int negated;      // 1: the paper's form, minus the displacement at the drawn point

void main()
{
  vec3 deformed = vec3(firstCell) + vec3(targetTexel()) / float(perCell);
  vec3 offset;
  if (negated == 1)
  {
    mat3 unused;
    forwardMap(deformed, offset, unused);
    offset = -offset;
  }
  else
  {
    offset = inverseOffset(deformed);
  }
  gl_FragData[0] = vec4(offset * offsetScale, 0.0);
}
