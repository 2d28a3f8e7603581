// Inverts the forward map at one point: which rest position is seen at a deformed position.
// One source for GLSL and C++ (Filters/Inversion.h). The includer provides, in lattice coordinates
// (cells from the first control point):
//   vec3 forwardDisplacement(vec3 rest)   deformed - rest
//   mat3 forwardJacobian(vec3 rest)       its columns are the derivatives of the deformed position
// Newton's steps, halved while they do not bring the point closer: the plain fixed-point iteration
// diverges where tissue is stretched more than twofold although nothing folds there.

const int InversionSteps = 16;             // 3 or 4 are used; strong bends near folding take more
const float InversionTolerance = 2e-5f;    // lattice cells; 0.0003 mm on the default lattice
const float SmallestDeterminant = 0.02f;   // below it the step of the fixed-point iteration is taken

SHARED vec3 inversionStep(mat3 jacobian, vec3 miss)
{
  if (determinant(jacobian) < SmallestDeterminant)
  {
    return miss;
  }
  return inverse(jacobian) * miss;
}

SHARED vec3 restFromDeformed(vec3 deformed)
{
  vec3 displacement = forwardDisplacement(deformed);
  if (displacement == vec3(0.0f))
  {
    return deformed; // most of space: nothing moves here
  }
  vec3 rest = deformed - displacement;
  vec3 miss = rest + forwardDisplacement(rest) - deformed;
  float share = 1.0f;
  for (int i = 0; i < InversionSteps; ++i)
  {
    float missSquared = dot(miss, miss);
    if (missSquared < InversionTolerance * InversionTolerance)
    {
      break;
    }
    vec3 trial = rest - share * inversionStep(forwardJacobian(rest), miss);
    vec3 trialMiss = trial + forwardDisplacement(trial) - deformed;
    if (dot(trialMiss, trialMiss) < missSquared)
    {
      rest = trial;
      miss = trialMiss;
      share = min(1.0f, 2.0f * share);
    }
    else
    {
      share *= 0.5f;
    }
  }
  return rest;
}
