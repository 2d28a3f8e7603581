// Inverts the forward map at one point: which rest position is seen at a deformed position.
// One source for GLSL and C++ (Filters/Deformation/Inversion.h). The includer provides, in lattice
// coordinates (cells from the first control point):
//   vec3 displacementAt(vec3 rest)   // deformed - rest
//   mat3 jacobianThere()             // of the position asked last: its columns are the derivatives
//                                    // of the deformed position
// Newton's steps, halved while they do not bring the point closer: the plain fixed-point iteration
// diverges where tissue is stretched more than twofold although nothing folds there.

const int InversionSteps = 16;           // 1 to 3 are used; more near folding
const float InversionTolerance = 2e-5f;  // lattice cells; 0.0003 mm on the default lattice
const float SmallestDeterminant = 0.02f; // below it: the step of the fixed-point iteration

// Cramer's rule.
SHARED vec3 inversionStep(mat3 jacobian, vec3 miss)
{
  vec3 across = cross(jacobian[1], jacobian[2]);
  float volume = dot(jacobian[0], across); // the determinant
  if (volume < SmallestDeterminant)
  {
    return miss;
  }
  return vec3(dot(across, miss), dot(cross(jacobian[2], jacobian[0]), miss),
           dot(cross(jacobian[0], jacobian[1]), miss)) /
    volume;
}

// restFromDeformed minus identity at a deformed position; `start`: a guess at it.
SHARED vec3 inverseOffset(vec3 deformed, vec3 start)
{
  const float enough = InversionTolerance * InversionTolerance;
  vec3 offset = start;
  vec3 miss = start + displacementAt(deformed + start); // where tissue at deformed + offset goes,
  float missSquared = dot(miss, miss);                  // seen from deformed
  if (missSquared < enough)
  {
    return offset;
  }
  vec3 step = inversionStep(jacobianThere(), miss);
  float fraction = 1.0f;
  for (int i = 0; i < InversionSteps; ++i)
  {
    vec3 trial = offset - fraction * step;
    miss = trial + displacementAt(deformed + trial);
    float trialSquared = dot(miss, miss);
    if (trialSquared < missSquared)
    {
      offset = trial;
      if (trialSquared < enough)
      {
        break;
      }
      missSquared = trialSquared;
      step = inversionStep(jacobianThere(), miss);
      fraction = min(1.0f, 2.0f * fraction);
    }
    else
    {
      fraction *= 0.5f;
    }
  }
  return offset;
}
