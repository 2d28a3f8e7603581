// The samples of a ray for all blend modes but composite, which has a loop of its own in
// compositing.frag.glsl.

struct March
{
  Ray ray;
  vec2 span;       // first and last t in the space that tissue can reach, mm
  vec2 samples;    // first, and one past the last
  vec2 moved;      // first, and one past the last, where tissue may have moved
  vec3 first;      // position of sample 0
  vec3 stride;     // from a sample to the next
  vec3 towardsEye; // world axes
};

// `before`: samples wanted before the first that may be visible.
March marchOf(vec2 ndc, float before)
{
  March march;
  march.ray = rayOfPixel(ndc);
  march.span = boxSpan(march.ray, spaceLow, spaceHigh);
  march.span.y = min(march.span.y, sceneDistance(march.ray, 0.5 * ndc + 0.5));
  march.span = clippedSpan(march.ray, march.span, stepMm);
  march.span.x += BehindFace * stepMm;
  march.samples = samplesInPart(
    march.ray, march.span.x, presentSamples(march.ray, march.span, stepMm));
  march.samples.x = max(march.samples.x - before, 0.0);
  march.moved = movedSamples(march.ray, march.span, stepMm);
  march.first = march.ray.start + march.span.x * march.ray.direction;
  march.stride = stepMm * march.ray.direction;
  march.towardsEye = -normalize(worldFromTexture * march.ray.direction);
  return march;
}

// Position of a sample. A fraction of a number lies between two samples.
vec3 deformedAt(March march, float number)
{
  return march.first + number * march.stride;
}

vec3 restAt(March march, float number)
{
  vec3 deformed = deformedAt(march, number);
  bool moved = number >= march.moved.x && number < march.moved.y;
  return moved ? restFromDeformed(deformed) : deformed;
}

bool inKeptTissue(vec3 deformed, vec3 rest)
{
  return insideVolume(rest) && inKeptRegion(deformed) && inSegment(rest) &&
    remains(deformed);
}

// A sample's colour under light, with a Jacobian of its own.
vec3 shadeAlone(March march, vec3 color, vec3 deformed, vec3 rest)
{
  Shine shine =
    shineAt(deformed, rest, offsetSlopesAt(deformed), worldFromGradient, march.towardsEye);
  return shone(shine, evident(color, rest));
}

// The second target: where a surface was hit. `number` below 0: no surface was hit.
vec4 hitAt(March march, float number)
{
  return number < 0.0 ? NoHit : hitAt(march.span.x + number * stepMm);
}
