// Draws the deformed volume: the paper's ray caster (section 2). A ray runs straight through the
// deformed frame; every sample looks its tissue up at the rest position it came from. Targets:
// picture, and position of the first hit (mm, world) with its distance from the near plane (mm).

in vec2 ndc;

uniform vec3 spaceLow;  // the part of the deformed frame that tissue can reach, texture coordinates
uniform vec3 spaceHigh;
uniform float stepMm;
uniform int stepDoublings; // opacities hold for a step this often halved; at most 2
uniform float jitter; // 1: neighbouring rays start at different shares of a step, against rings
uniform mat3 worldFromGradient;  // world axes from a gradient for texture units (inverse transpose)
uniform vec3 worldOfTextureZero; // mm

const float OpaqueEnough = 254.0 / 255.0; // what is behind would change less than one 8-bit level
const float HitOpacity = 0.5;             // where this much is reached, the eye sees a surface

vec3 worldFromDeformed(vec3 deformed)
{
  return worldFromTexture * deformed + worldOfTextureZero;
}

// A sample's colour under light. `slopes`: of the offsets near it; `turn`: worldFromGradient.
vec3 shade(vec3 color, vec3 deformed, vec3 rest, mat3 slopes, mat3 turn, vec3 towardsEye)
{
#ifdef SHADED
  vec3 gradient = turn * deformedGradientFromRest(slopes, gradientAt(rest));
  float steepness = length(gradient);
  vec3 normal = steepness > 0.0 ? gradient / steepness : vec3(0.0);
  return lit(color, normal, towardsEye, worldFromDeformed(deformed));
#else
  return color;
#endif
}

#ifdef COMPOSITE
// Where in its first step a pixel's ray starts: 16 shares, ordered so that neighbours differ most
// (Bayer, 1973).
float startShare(ivec2 pixel)
{
  int mixed = pixel.x ^ pixel.y;
  int rank = (mixed & 1) * 8 + (pixel.y & 1) * 4 + (mixed >> 1 & 1) * 2 + (pixel.y >> 1 & 1);
  return (float(rank) + 0.5) / 16.0;
}

// Opacity of the present step.
float opacityOf(float ofHalvedStep)
{
  float once = ofHalvedStep * (2.0 - ofHalvedStep);
  float twice = once * (2.0 - once);
  return stepDoublings == 0 ? ofHalvedStep : stepDoublings == 1 ? once : twice;
}

// Colour times opacity, and opacity, of a sample.
vec4 shown(vec4 tissue, vec3 deformed, vec3 rest, mat3 slopes, mat3 turn, vec3 towardsEye)
{
  vec3 color = shade(colorOf(tissue, rest), deformed, rest, slopes, turn, towardsEye);
  return tissue.a > 0.0 ? vec4(color * tissue.a, tissue.a) : vec4(0.0);
}

void main()
{
  Ray ray = rayOfPixel(ndc);
  vec2 span = boxSpan(ray, spaceLow, spaceHigh);
  span.y = min(span.y, sceneDistance(ray, 0.5 * ndc + 0.5));
  span = clippedSpan(ray, span, stepMm);
  span.x += jitter * startShare(ivec2(gl_FragCoord.xy)) * stepMm;
  // Samples are numbered from the box's edge or a cut, whether empty space is skipped or not, and
  // taken by twos: independent reads overlap, and one Jacobian does for both.
  ivec2 samples = presentSamples(ray, span, stepMm);
  ivec2 moved = movedSamples(ray, span, stepMm);
  Track deformed = Track(ray.start + span.x * ray.direction, stepMm * ray.direction);
  Track field = fieldTrack(deformed);
  BrickTrack bricks = brickTrack(deformed);
  TissueTable table = tissueTable();
  mat3 turn = worldFromGradient;
  vec3 towardsEye = -normalize(worldFromTexture * ray.direction);

  vec4 picture = vec4(0.0); // colour times opacity, opacity
  float hit = -1.0;         // where HitOpacity was reached: half a step before the sample past it
  int taken = 0; // for countSamples
  int i = samples.x & ~1;
  int ask = skipping == 0 ? samples.y : i; // from this sample on, whether there is anything
  while (i < samples.y)
  {
    bool present = true;
    if (i >= ask)
    {
      ask = sampleBeyond(bricks, i, present) & ~1;
      present = present || ask <= i;
    }
    if (present)
    {
      taken += min(2, samples.y - i);
      vec3 oneDeformed = positionOf(deformed, i);
      vec3 twoDeformed = positionOf(deformed, i + 1);
      vec3 oneRest = oneDeformed;
      vec3 twoRest = twoDeformed;
      if (i + 1 >= moved.x && i < moved.y)
      {
        oneRest += offsetAt(positionOf(field, i));
        twoRest += offsetAt(positionOf(field, i + 1));
      }
      vec4 one = tissueAt(table, oneRest);
      vec4 two = tissueAt(table, twoRest);
      one.a = inShownRegion(oneDeformed) ? one.a : 0.0;
      two.a = i + 1 < samples.y && inShownRegion(twoDeformed) ? two.a : 0.0;
      if (max(one.a, two.a) > 0.0)
      {
        ask = max(ask, i + Trust);
        mat3 slopes = mat3(0.0);
        if (oneRest != oneDeformed) // where nothing moves there is nothing to turn
        {
          slopes = offsetSlopes(positionOf(field, i) + 0.5 * field.stride);
        }
        one.a = opacityOf(one.a);
        two.a = opacityOf(two.a);
        picture += (1.0 - picture.a) * shown(one, oneDeformed, oneRest, slopes, turn, towardsEye);
        hit = hit < 0.0 && picture.a >= HitOpacity ? max(float(i) - 0.5, 0.0) : hit;
        vec4 further = shown(two, twoDeformed, twoRest, slopes, turn, towardsEye);
        picture += picture.a > OpaqueEnough ? vec4(0.0) : (1.0 - picture.a) * further;
        hit = hit < 0.0 && picture.a >= HitOpacity ? float(i) + 0.5 : hit;
        if (picture.a > OpaqueEnough)
        {
          break;
        }
      }
    }
    i = present ? i + 2 : ask;
  }
  int end = picture.a > OpaqueEnough ? i + 2 : int(ceil((span.y - span.x) / stepMm));
  countSamples(taken, max(end - taken, 0));
  gl_FragData[0] = picture;
  gl_FragData[1] = hit < 0.0
    ? vec4(0.0, 0.0, 0.0, -1.0)
    : vec4(worldFromDeformed(deformed.first + hit * deformed.stride), span.x + hit * stepMm);
}
#endif
