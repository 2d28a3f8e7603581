// Gradients for light where a segment is drawn alone.

#ifdef SEGMENTED
uniform vec3 segmentVoxel; // one voxel, texture coordinates
uniform vec2 cutGradient;  // scale and shift: stored scalar to how much the edge counts beside it

// From the four corners of a tetrahedron, a voxel away on each axis.
vec3 segmentSlope(vec3 rest)
{
  vec3 step = segmentVoxel;
  float a = segmentShareAt(rest + vec3(step.x, -step.y, -step.z));
  float b = segmentShareAt(rest + vec3(-step.x, -step.y, step.z));
  float c = segmentShareAt(rest + vec3(-step.x, step.y, -step.z));
  float d = segmentShareAt(rest + step);
  return vec3(a - b - c + d, c + d - a - b, b + d - a - c) / (4.0 * step);
}

// Where the edge cuts through tissue, the scalars' gradient has nothing to do with the surface that
// is seen. So light takes the gradient of scalars that fall across the edge to the least that is
// visible. Where the tissue's own leads the other way, only what lies in the cut counts of it: else
// the two would cancel out.
vec3 shownGradientAt(vec3 rest)
{
  vec3 gradient = gradientAt(rest);
  if (segmentShareAt(rest) > 0.999)
  {
    return gradient;
  }
  vec3 fall = segmentSlope(rest) * max(scalarAt(rest) * cutGradient.x + cutGradient.y, 0.0);
  vec3 fallForMm = fall / mmFromTexture;
  float along = dot(gradient / mmFromTexture, fallForMm) / max(dot(fallForMm, fallForMm), 1e-30);
  return gradient + (1.0 - min(along, 0.0)) * fall;
}
#else
vec3 shownGradientAt(vec3 rest)
{
  return gradientAt(rest);
}
#endif
