// Gradients for light if a segment is drawn alone.

#ifdef SEGMENTED
uniform vec3 segmentVoxel; // one voxel, texture coordinates
uniform vec2 cutGradient;  // stored scalar to the weight of the edge: scale and shift

// From the four corners of a tetrahedron, a voxel away on each axis.
vec3 segmentSlope(vec3 rest)
{
  vec3 step = segmentVoxel;
  float a = segmentFractionAt(rest + vec3(step.x, -step.y, -step.z));
  float b = segmentFractionAt(rest + vec3(-step.x, -step.y, step.z));
  float c = segmentFractionAt(rest + vec3(-step.x, step.y, -step.z));
  float d = segmentFractionAt(rest + step);
  return vec3(a - b - c + d, c + d - a - b, b + d - a - c) / (4.0 * step);
}

// The gradient that light uses, from the gradient of the scalars at a position.
//
// Where the edge cuts through tissue, the gradient of the scalars has nothing to do with the
// surface that is seen. So light uses the gradient of scalars that fall across the edge to the
// least visible one. If the tissue's own gradient points the other way, only its part within the
// cut counts: else the two would cancel out.
vec3 litGradient(vec3 rest, vec3 gradient)
{
  if (segmentFractionAt(rest) > 0.999)
  {
    return gradient;
  }
  vec3 fall = segmentSlope(rest) * max(scalarAt(rest) * cutGradient.x + cutGradient.y, 0.0);
  vec3 fallForMm = fall / mmFromTexture;
  float along = dot(gradient / mmFromTexture, fallForMm) / max(dot(fallForMm, fallForMm), 1e-30);
  return gradient + (1.0 - min(along, 0.0)) * fall;
}
#else
vec3 litGradient(vec3 rest, vec3 gradient)
{
  return gradient;
}
#endif

vec3 litGradientAt(vec3 rest)
{
#ifdef SHADED
  return litGradient(rest, gradientAt(rest));
#else
  return vec3(0.0);
#endif
}
