// Inverts the forward map at one point: which rest position is seen at a deformed position.
// One source for GLSL and C++ (Filters/Inversion.h). The includer provides, in lattice coordinates
// (cells from the first control point):
//   void forwardMap(vec3 rest, OUT(vec3) displacement, OUT(mat3) jacobian)
//     displacement: deformed - rest; jacobian: its columns are the derivatives of the deformed
//     position
// Newton's steps, halved while they do not bring the point closer: the plain fixed-point iteration
// diverges where tissue is stretched more than twofold although nothing folds there.

const int InversionSteps = 16;             // 2 to 4 are used; more near folding
const float InversionTolerance = 2e-5f;    // lattice cells; 0.0003 mm on the default lattice
const float SmallestDeterminant = 0.02f;   // below it: the step of the fixed-point iteration

SHARED vec3 inversionStep(mat3 jacobian, vec3 miss)
{
  if (determinant(jacobian) < SmallestDeterminant)
  {
    return miss;
  }
  return inverse(jacobian) * miss;
}

// restFromDeformed minus identity at a deformed position; `start`: a guess at it.
SHARED vec3 inverseOffset(vec3 deformed, vec3 start)
{
  vec3 displacement;
  mat3 jacobian;
  forwardMap(deformed + start, displacement, jacobian);
  vec3 offset = start;
  vec3 miss = start + displacement; // where tissue at deformed + offset goes, seen from deformed
  float share = 1.0f;
  for (int i = 0; i < InversionSteps; ++i)
  {
    float missSquared = dot(miss, miss);
    if (missSquared < InversionTolerance * InversionTolerance)
    {
      break;
    }
    vec3 trial = offset - share * inversionStep(jacobian, miss);
    vec3 trialDisplacement;
    mat3 trialJacobian;
    forwardMap(deformed + trial, trialDisplacement, trialJacobian);
    vec3 trialMiss = trial + trialDisplacement;
    if (dot(trialMiss, trialMiss) < missSquared)
    {
      offset = trial;
      miss = trialMiss;
      jacobian = trialJacobian;
      share = min(1.0f, 2.0f * share);
    }
    else
    {
      share *= 0.5f;
    }
  }
  return offset;
}
