// Draws the deformed volume: the paper's ray caster (section 2). A ray runs straight through the
// deformed frame; every sample looks its tissue up at the rest position it came from. Targets:
// picture, and position of the first hit (mm, world) with its distance from the near plane (mm).

in vec2 ndc;

uniform vec3 spaceLow;  // the part of the deformed frame that tissue can reach, texture coordinates
uniform vec3 spaceHigh;
uniform float stepMm;
uniform mat3 worldFromGradient;  // world axes from a gradient for texture units (inverse transpose)
uniform vec3 worldOfTextureZero; // mm

const float OpaqueEnough = 254.0 / 255.0; // what is behind would change less than one 8-bit level
const float HitOpacity = 0.5;             // where this much is reached, the eye sees a surface

vec3 worldFromDeformed(vec3 deformed)
{
  return worldFromTexture * deformed + worldOfTextureZero;
}

vec3 shade(vec3 color, vec4 probe, vec3 deformed, vec3 rest, vec3 towardsEye)
{
#ifdef SHADED
  vec3 gradient = gradientOf(probe, rest);
  if (rest != deformed) // where nothing moves there is nothing to turn
  {
    gradient = deformedGradientFromRest(deformed, gradient);
  }
  gradient = worldFromGradient * gradient;
  float steepness = length(gradient);
  vec3 normal = steepness > 0.0 ? gradient / steepness : vec3(0.0);
  return lit(color, normal, towardsEye, worldFromDeformed(deformed));
#else
  return color;
#endif
}

#ifdef COMPOSITE
void main()
{
  Ray ray = rayOfPixel(ndc);
  vec2 span = boxSpan(ray, spaceLow, spaceHigh);
  span.y = min(span.y, sceneDistance(ray, 0.5 * ndc + 0.5));
  span = clippedSpan(ray, span, stepMm);
  // Samples are numbered from the box's edge or a cut, whether empty space is skipped or not.
  ivec2 samples = presentSamples(ray, span, stepMm);
  ivec2 moved = movedSamples(ray, span, stepMm);
  vec3 first = ray.start + span.x * ray.direction;
  vec3 stride = stepMm * ray.direction;
  vec3 towardsEye = -normalize(worldFromTexture * ray.direction);

  vec4 picture = vec4(0.0); // colour times opacity, opacity
  float hit = -1.0;         // where HitOpacity was reached: half a step before the sample past it
  for (int i = samples.x; i < samples.y; ++i)
  {
    vec3 deformed = first + float(i) * stride;
    vec3 rest = deformed;
    if (i >= moved.x && i < moved.y)
    {
      rest = restFromDeformed(deformed);
    }
    if (insideVolume(rest) && inShownRegion(deformed))
    {
      vec4 probe = probeAt(rest);
      vec4 tissue = tissueOf(probe.a);
      if (tissue.a > 0.0)
      {
        vec3 color = shade(colorOf(tissue, rest), probe, deformed, rest, towardsEye);
        picture += (1.0 - picture.a) * vec4(color * tissue.a, tissue.a);
        hit = hit < 0.0 && picture.a >= HitOpacity ? max(float(i) - 0.5, 0.0) : hit;
        if (picture.a > OpaqueEnough)
        {
          break;
        }
      }
    }
  }
  gl_FragData[0] = picture;
  gl_FragData[1] = hit < 0.0
    ? vec4(0.0, 0.0, 0.0, -1.0)
    : vec4(worldFromDeformed(first + hit * stride), span.x + hit * stepMm);
}
#endif
