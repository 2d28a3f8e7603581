// Projections along the ray, as VTK defines them. The greatest or the least scalar has its colour
// and opacity. Averages and sums of scalars times opacity are grey.

#if defined(MAXIMUM) || defined(MINIMUM)
#ifdef MAXIMUM
bool beats(float scalar, float other)
{
  return scalar > other;
}
#else
bool beats(float scalar, float other)
{
  return scalar < other;
}
#endif

void main()
{
  March march = marchOf(ndc, 0.0);
  float extreme = 0.0;
  float at = -1.0; // sample of the extreme
  for (float i = march.samples.x; i < march.samples.y; i += 1.0)
  {
    vec3 rest = restAt(march, i);
    if (inKeptTissue(deformedAt(march, i), rest))
    {
      float scalar = scalarAt(rest);
      if (isNumber(scalar) && (at < 0.0 || beats(scalar, extreme)))
      {
        extreme = scalar;
        at = i;
      }
    }
  }
  vec4 tissue = at < 0.0 ? vec4(0.0) : tissueOf(extreme);
  vec3 color = tissue.a > 0.0 ? colorOf(tissue, restAt(march, at)) : vec3(0.0);
  gl_FragData[0] = vec4(color * tissue.a, tissue.a);
  gl_FragData[1] = hitAt(march, tissue.a >= HitOpacity ? at : -1.0);
}
#else
// scale and shift: stored scalar to its fraction of the array's range
uniform vec2 fractionFromScalar;
uniform vec2 averagedScalars; // least and greatest stored scalar that the average takes

void main()
{
  March march = marchOf(ndc, 0.0);
  float sum = 0.0;
  float count = 0.0;
  for (float i = march.samples.x; i < march.samples.y; i += 1.0)
  {
    vec3 rest = restAt(march, i);
    if (inKeptTissue(deformedAt(march, i), rest))
    {
      float scalar = scalarAt(rest);
      bool known = isNumber(scalar);
#ifdef AVERAGE
      known = known && scalar >= averagedScalars.x && scalar <= averagedScalars.y;
#endif
      if (known)
      {
        sum += tissueOf(scalar).a * (scalar * fractionFromScalar.x + fractionFromScalar.y);
        count += 1.0;
      }
    }
  }
#ifdef AVERAGE
  sum /= max(count, 1.0);
#endif
  gl_FragData[0] = count > 0.0 ? vec4(vec3(clamp(sum, 0.0, 1.0)), 1.0) : vec4(0.0);
  gl_FragData[1] = hitAt(march, -1.0);
}
#endif
