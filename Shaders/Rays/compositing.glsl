// Composite blending, front to back (paper, section 2): a ray's way, and what it has seen.

// Colour times opacity, and opacity, of a sample.
vec4 shown(vec4 tissue, vec3 rest, Shine shine)
{
  vec3 color = shone(shine, colorOf(tissue, rest));
  return tissue.a > 0.0 ? vec4(color * tissue.a, tissue.a) : vec4(0.0);
}

// A ray's way through the space that tissue can reach.
struct Path
{
  vec2 span;       // first and last t, mm
  vec2 samples;    // first, and one past the last, that may be visible
  vec2 moved;      // likewise where tissue may have moved
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
  span.x += jitter * startShare(ivec2(gl_FragCoord.xy)) * stepMm;
  path.span = span;
  path.samples = presentSamples(ray, span, stepMm);
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

struct Seen
{
  vec4 picture; // colour times opacity, opacity
  float hit;    // number of the sample where HitOpacity was reached; below 0: not yet
  // The last sample that was taken; averaged.glsl asks for it.
  float lastNumber;
  float lastScalar;
  bool lastVisible;
};

Seen nothingYet()
{
  return Seen(vec4(0.0), -1.0, -2.0, 0.0, false);
}

// A sample's colour times opacity, and opacity; `surface`: number of the sample where a surface
// lies if this one hides enough to make one.
void see(inout Seen seen, vec4 shown, float surface)
{
  seen.picture += seen.picture.a > OpaqueEnough ? vec4(0.0) : (1.0 - seen.picture.a) * shown;
  bool hit = seen.hit < 0.0 && seen.picture.a >= HitOpacity;
  seen.hit = hit ? max(surface, 0.0) : seen.hit;
}
