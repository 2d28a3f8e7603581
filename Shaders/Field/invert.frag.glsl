// The offset field: for each node of the deformed frame, where the tissue seen there comes from.

uniform vec3 firstNode;   // the target's first node among the lattice's; below 0 beyond the lattice
uniform vec3 offsetScale; // wanted unit (the volume's texture coordinates) for one lattice cell
uniform int negated;      // 1: the paper's form, minus the displacement at the drawn point

// Lattice cells. If tissue moves less, the negative displacement is within the solver's tolerance,
// unless tissue is stretched fivefold there. Most of space stays, and around a stamp a tenth moves
// less.
const float Small = 0.25 * InversionTolerance;

void main()
{
  vec3 node = firstNode + targetTexel();
  vec3 displacement = valueAtNode(clamp(node, vec3(0.0), lastNode));
  vec3 offset = -displacement;
  if (negated == 0 && dot(displacement, displacement) > Small * Small)
  {
    offset = inverseOffset(node / perCell, offset);
  }
  gl_FragData[0] = vec4(offset * offsetScale, 0.0);
}
