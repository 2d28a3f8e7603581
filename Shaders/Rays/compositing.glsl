// Composite blending from front to back with early ray termination (paper, section 2; Levoy, ACM
// Transactions on Graphics 9(3), 1990): the path of a ray, and the colour that it has gathered.

// Colour times opacity, and opacity, of a sample.
vec4 litTissue(vec4 tissue, vec3 rest, Shine shine)
{
  vec3 color = shone(shine, evident(colorOf(tissue, rest), rest));
  return tissue.a > 0.0 ? vec4(color * tissue.a, tissue.a) : vec4(0.0);
}

// A ray's way through the space that tissue can reach.
struct Path
{
  vec2 span;    // first and last t, mm
  vec2 samples; // first, and one past the last, that may be visible
  vec2 moved;   // first, and one past the last, where tissue may have moved
  Track deformed;
  Track field;
  BrickTrack bricks;
  vec3 towardsEye; // world axes
};

Path pathOf(Ray ray)
{
  Path path;
  vec2 span = boxSpan(ray, spaceLow, spaceHigh);
  span.y = min(span.y, sceneDistance(ray, 0.5 * ndc + 0.5));
  span = clippedSpan(ray, span, stepMm);
  span.x += (BehindFace + jitter * startFraction(ivec2(gl_FragCoord.xy))) * stepMm;
  path.span = span;
  path.samples = samplesInPart(ray, span.x, presentSamples(ray, span, stepMm));
  path.moved = vec2(0.0);
  path.deformed = Track(ray.start + span.x * ray.direction, stepMm * ray.direction);
  path.field = path.deformed;
  path.bricks = BrickTrack(path.deformed, vec3(0.0), vec3(0.0));
  path.towardsEye = vec3(0.0);
  if (path.samples.x < path.samples.y) // else the rest is not asked for
  {
    path.moved = movedSamples(ray, span, stepMm);
    path.field = fieldTrack(path.deformed);
    path.bricks = deformedBricks(path.deformed);
    path.towardsEye = -normalize(worldFromTexture * ray.direction);
  }
  return path;
}

// Two neighbouring samples: positions in both frames, and stored scalars.
struct Pair
{
  vec3 oneDeformed;
  vec3 twoDeformed;
  vec3 oneRest;
  vec3 twoRest;
  float oneScalar;
  float twoScalar;
#ifdef STEEPNESS
  vec3 oneGradient; // rest frame; zero for an invisible sample
  vec3 twoGradient;
#endif
};

// Makes opacities depend on gradients, too. Returns whether a sample is left to see. Light uses the
// same gradients.
#ifdef STEEPNESS
bool steepen(inout Pair pair, mat3 slopes, inout vec4 one, inout vec4 two)
{
  pair.oneGradient = one.a > 0.0 ? steepGradientAt(pair.oneRest) : vec3(0.0);
  pair.twoGradient = two.a > 0.0 ? steepGradientAt(pair.twoRest) : vec3(0.0);
  one = steepened(one, pair.oneScalar, deformedGradientFromRest(slopes, pair.oneGradient));
  two = steepened(two, pair.twoScalar, deformedGradientFromRest(slopes, pair.twoGradient));
  return max(one.a, two.a) > 0.0;
}

vec3 gradientOfOne(Pair pair)
{
  return litGradient(pair.oneRest, pair.oneGradient);
}

vec3 gradientOfTwo(Pair pair)
{
  return litGradient(pair.twoRest, pair.twoGradient);
}

vec3 gradientBetween(Pair pair, float way)
{
  return litGradient(
    mix(pair.oneRest, pair.twoRest, way), mix(pair.oneGradient, pair.twoGradient, way));
}
#else
bool steepen(Pair pair, mat3 slopes, vec4 one, vec4 two)
{
  return true;
}

vec3 gradientOfOne(Pair pair)
{
  return litGradientAt(pair.oneRest);
}

vec3 gradientOfTwo(Pair pair)
{
  return litGradientAt(pair.twoRest);
}

vec3 gradientBetween(Pair pair, float way)
{
  return litGradientAt(mix(pair.oneRest, pair.twoRest, way));
}
#endif

// Light at a fraction of the way from the first to the second sample.
Shine shineBetween(Path path, Pair pair, mat3 slopes, mat3 turn, float way)
{
  return shineOf(mix(pair.oneDeformed, pair.twoDeformed, way), gradientBetween(pair, way), slopes,
    turn, path.towardsEye);
}

struct Seen
{
  vec4 picture; // colour times opacity, opacity
  float hit;    // number of the sample where HitOpacity was reached; below 0: not yet
  // The last sample that was taken, for averaged.glsl.
  float lastNumber;
  float lastScalar;
  bool lastVisible;
};

Seen nothingYet()
{
  return Seen(vec4(0.0), -1.0, -2.0, 0.0, false);
}

// Adds a sample's colour times opacity, and opacity.
void see(inout Seen seen, vec4 added)
{
  seen.picture += seen.picture.a > OpaqueEnough ? vec4(0.0) : (1.0 - seen.picture.a) * added;
}

// Whether the last samples made the ray reach HitOpacity. Once a ray: where is found in a branch.
bool hasReached(Seen seen)
{
  return seen.hit < 0.0 && seen.picture.a >= HitOpacity;
}
