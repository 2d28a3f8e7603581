// Surfaces of equal scalars. If two neighbouring samples lie on different sides of an isovalue, the
// crossing is refined and drawn with the colour and opacity of the isovalue and the light there.

uniform int isovalueCount;
uniform float isovalues[MAX_ISOVALUES]; // stored scalars, ascending

const int Halvings = 5; // 1/32 of a step, before the last, linear guess

// The sample number, with a fraction, at which the scalar crosses `value` between the samples
// `number` - 1 and `number`. Below 0 if there is no tissue in between, or no scalar.
float crossingBefore(March march, float number, float before, float after, float value)
{
  vec2 ends = vec2(number - 1.0, number);
  vec2 scalars = vec2(before, after);
  for (int i = 0; i < Halvings; ++i)
  {
    float middle = 0.5 * (ends.x + ends.y);
    vec3 rest = restAt(march, middle);
    float scalar = scalarAt(rest);
    if (!isNumber(scalar) || !inKeptTissue(deformedAt(march, middle), rest))
    {
      return -1.0;
    }
    bool nearer = (scalar >= value) != (before >= value);
    ends = nearer ? vec2(ends.x, middle) : vec2(middle, ends.y);
    scalars = nearer ? vec2(scalars.x, scalar) : vec2(scalar, scalars.y);
  }
  return mix(ends.x, ends.y, clamp((value - scalars.x) / (scalars.y - scalars.x), 0.0, 1.0));
}

void main()
{
  March march = marchOf(ndc, 1.0);
  vec4 picture = vec4(0.0); // colour times opacity, opacity
  float hit = -1.0;
  bool known = false; // of the sample before
  float before = 0.0;
  for (float i = march.samples.x; i < march.samples.y && picture.a <= OpaqueEnough; i += 1.0)
  {
    vec3 rest = restAt(march, i);
    float scalar = scalarAt(rest);
    bool inside = inKeptTissue(deformedAt(march, i), rest) && isNumber(scalar);
    for (int k = 0; k < isovalueCount && known && inside; ++k)
    {
      float value = isovalues[scalar > before ? k : isovalueCount - 1 - k];
      vec4 tissue = tissueOf(value);
      if ((scalar >= value) == (before >= value) || tissue.a <= 0.0)
      {
        continue;
      }
      float at = crossingBefore(march, i, before, scalar, value);
      if (at >= 0.0)
      {
        vec3 place = restAt(march, at);
        vec3 color = shadeAlone(march, colorOf(tissue, place), deformedAt(march, at), place);
        picture += (1.0 - picture.a) * vec4(color * tissue.a, tissue.a);
        hit = hit < 0.0 && picture.a >= HitOpacity ? at : hit;
      }
    }
    known = inside;
    before = scalar;
  }
  gl_FragData[0] = pictureOfPart(picture);
  gl_FragData[1] = hitAt(march, hit);
}
