// The offset field: for each node of the deformed frame, where the tissue seen there comes from.

const int GuessSteps = 2;

uniform ivec3 firstCell;  // lattice cell of the target's first node; below 0 beyond the lattice
uniform vec3 offsetScale; // wanted unit (the volume's texture coordinates) for one lattice cell
uniform int negated;      // 1: the paper's form, minus the displacement at the drawn point

// A guess, from nearest nodes: the fixed-point iteration, as long as it comes closer.
vec3 firstGuess(vec3 deformed, vec3 displacement)
{
  vec3 offset = vec3(0.0);
  vec3 miss = displacement;
  for (int i = 0; i < GuessSteps; ++i)
  {
    vec3 trial = offset - miss;
    vec3 trialMiss = trial + displacementNear(deformed + trial);
    bool nearer = dot(trialMiss, trialMiss) < dot(miss, miss);
    offset = nearer ? trial : offset;
    miss = nearer ? trialMiss : miss;
  }
  return offset;
}

void main()
{
  vec3 deformed = vec3(firstCell) + targetTexel() / float(perCell);
  vec3 displacement = displacementNear(deformed); // a node's own
  vec3 offset = vec3(0.0);
  if (negated == 1)
  {
    offset = -displacement;
  }
  else if (displacement != vec3(0.0)) // most of space stays
  {
    offset = inverseOffset(deformed, firstGuess(deformed, displacement));
  }
  gl_FragData[0] = vec4(offset * offsetScale, 0.0);
}
