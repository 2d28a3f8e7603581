// Composite blending, front to back (paper, section 2); a loop of its own, for it is drawn most.

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
};

// A sample's colour times opacity, and opacity; the surface is taken to lie half a step before it.
void see(inout Seen seen, vec4 shown, float number)
{
  seen.picture += seen.picture.a > OpaqueEnough ? vec4(0.0) : (1.0 - seen.picture.a) * shown;
  bool hit = seen.hit < 0.0 && seen.picture.a >= HitOpacity;
  seen.hit = hit ? max(number - 0.5, 0.0) : seen.hit;
}

// Takes the samples i and i + 1: their reads do not wait for each other, and one Jacobian does for
// both. Whether one of them is visible.
bool takeTwo(Path path, TissueTable table, mat3 turn, float i, inout Seen seen)
{
  vec3 oneDeformed = positionOf(path.deformed, i);
  vec3 twoDeformed = positionOf(path.deformed, i + 1.0);
  vec3 oneRest = oneDeformed;
  vec3 twoRest = twoDeformed;
  if (i + 1.0 >= path.moved.x && i < path.moved.y)
  {
    oneRest += offsetAt(positionOf(path.field, i));
    twoRest += offsetAt(positionOf(path.field, i + 1.0));
  }
  float oneScalar = scalarAt(oneRest);
  float twoScalar = scalarAt(twoRest);
  if (!mayBeVisible(table, oneScalar) && !mayBeVisible(table, twoScalar))
  {
    return false;
  }
  vec4 one = tissueAt(table, oneRest, oneScalar);
  vec4 two = tissueAt(table, twoRest, twoScalar);
  one.a = inShownRegion(oneDeformed) ? one.a : 0.0;
  two.a = i + 1.0 < path.samples.y && inShownRegion(twoDeformed) ? two.a : 0.0;
  bool visible = max(one.a, two.a) > 0.0;
  if (visible)
  {
    mat3 slopes = mat3(0.0);
    if (oneRest != oneDeformed) // where nothing moves there is nothing to turn
    {
      slopes = offsetSlopes(positionOf(path.field, i) + 0.5 * path.field.stride);
    }
#ifdef SHARED_LIGHT
    // Light is found once, at the middle of what the two show.
    float further = (1.0 - one.a) * two.a;
    float way = further / (one.a + further);
    Shine oneShine = shineAt(mix(oneDeformed, twoDeformed, way), mix(oneRest, twoRest, way), slopes,
      turn, path.towardsEye);
    Shine twoShine = oneShine;
#else
    Shine oneShine = shineAt(oneDeformed, oneRest, slopes, turn, path.towardsEye);
    Shine twoShine = shineAt(twoDeformed, twoRest, slopes, turn, path.towardsEye);
#endif
    see(seen, shown(one, oneRest, oneShine), i);
    see(seen, shown(two, twoRest, twoShine), i + 1.0);
  }
  return visible;
}

void main()
{
  if (!CountsSamples && meetsNothing())
  {
    gl_FragData[0] = vec4(0.0);
    gl_FragData[1] = NoHit;
    return;
  }
  Path path = pathOf(rayOfPixel(ndc));
  TissueTable table = tissueTable();
  mat3 turn = worldFromGradient;
  Seen seen = Seen(vec4(0.0), -1.0);
  // Samples are numbered from the box's edge or a cut, whether empty space is skipped or not.
  float end = path.samples.y;
  float i = evenBelow(path.samples.x);
  float ask = skipping == 0 ? end : i + Trust; // from this sample on, whether there is anything
  float taken = 0.0;
  while (i < end && seen.picture.a <= OpaqueEnough)
  {
    bool present = true;
    if (i >= ask)
    {
      ask = evenBelow(sampleBeyond(leaps, leapsTexel, path.bricks, i, present));
      present = present || ask <= i;
    }
    float next = ask;
    if (present)
    {
      bool visible = takeTwo(path, table, turn, i, seen);
      ask = visible ? max(ask, i + Trust) : ask;
      taken += min(2.0, end - i);
      next = i + 2.0;
    }
    i = next;
  }
  float all = ceil((path.span.y - path.span.x) / stepMm);
  countSamples(taken, max((seen.picture.a > OpaqueEnough ? i : all) - taken, 0.0));
  gl_FragData[0] = seen.picture;
  gl_FragData[1] = seen.hit < 0.0 ? NoHit : hitAt(path.span.x + seen.hit * stepMm);
}
