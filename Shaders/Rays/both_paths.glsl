// A bent volume and a reference along one ray: where each may be, and what a sample of both adds.

const float Negligible = 1.0 / 1024.0; // light is not seen behind so little transparency

// A ray's way through the space that either can reach.
struct Path
{
  vec2 span;    // first and last t, mm
  vec2 samples; // first, and one past the last, that may be visible
  vec2 own;     // first, and one past the last, of the bent volume alone
  vec2 other;   // first, and one past the last, of the reference alone
  vec2 moved;   // first, and one past the last, where tissue may have moved
  Track deformed;
  Track field;
  Track reference;
  BrickTrack bricks;
  BrickTrack referenceBricks;
  vec3 towardsEye; // world axes
};

// The shortest span that holds both; last < first: an empty one.
vec2 joined(vec2 one, vec2 two)
{
  return one.y < one.x ? two : two.y < two.x ? one : vec2(min(one.x, two.x), max(one.y, two.y));
}

// Samples, numbered from t = span.x, in a part of the span: first, and one past the last.
vec2 samplesIn(vec2 part, vec2 span)
{
  part = vec2(max(part.x, span.x), min(part.y, span.y));
  vec2 numbers = (part - span.x) / stepMm;
  return part.y < part.x ? vec2(0.0) : vec2(ceil(numbers.x), floor(numbers.y) + 1.0);
}

Path pathOf(Ray ray)
{
  Path path;
  vec2 own = boxSpan(ray, spaceLow, spaceHigh);
  vec2 other = referenceSpan(ray);
  vec2 span = joined(own, other);
  span.y = min(span.y, sceneDistance(ray, 0.5 * ndc + 0.5));
  span = clippedSpan(ray, span, stepMm);
  span.x += (BehindFace + jitter * startFraction(ivec2(gl_FragCoord.xy))) * stepMm;
  path.span = span;
  path.samples = presentSamples(ray, span, stepMm);
  path.own = samplesIn(own, span);
  path.other = samplesIn(other, span);
  path.moved = movedSamples(ray, span, stepMm);
  path.deformed = Track(ray.start + span.x * ray.direction, stepMm * ray.direction);
  path.field = fieldTrack(path.deformed);
  path.reference = referenceTrack(path.deformed);
  path.bricks = deformedBricks(path.deformed);
  path.referenceBricks =
    brickTrack(Track(path.reference.first * brickFromReference + brickOfReferenceZero,
      path.reference.stride * brickFromReference));
  path.towardsEye = -normalize(worldFromTexture * ray.direction);
  return path;
}

struct Seen
{
  vec3 light; // times opacity
  Layer own;
  Layer other;
};

bool isAmong(float number, vec2 numbers)
{
  return number >= numbers.x && number < numbers.y;
}

// Opacities of the samples `i` and `i` + 1 of the bent volume, at their rest positions.
vec2 ownOpacities(TissueTable table, vec3 one, vec3 two, vec2 numbers, float i)
{
  vec2 scalars = vec2(scalarAt(one), scalarAt(two));
  if (!mayBeVisible(table, scalars.x) && !mayBeVisible(table, scalars.y))
  {
    return vec2(0.0);
  }
  return vec2(isAmong(i, numbers) ? tissueAt(table, one, scalars.x).a : 0.0,
    isAmong(i + 1.0, numbers) ? tissueAt(table, two, scalars.y).a : 0.0);
}

// Opacities of the samples `i` and `i` + 1 of the reference, at its own positions.
vec2 referenceOpacities(TissueTable table, vec3 one, vec3 two, vec2 numbers, float i)
{
  vec2 scalars = vec2(referenceScalarAt(one), referenceScalarAt(two));
  if (!mayBeVisible(table, scalars.x) && !mayBeVisible(table, scalars.y))
  {
    return vec2(0.0);
  }
  return vec2(isAmong(i, numbers) ? referenceOpacityAt(table, one, scalars.x) : 0.0,
    isAmong(i + 1.0, numbers) ? referenceOpacityAt(table, two, scalars.y) : 0.0);
}

// Adds a sample of both. `opacities`: of the bent volume and of the reference.
void see(
  inout Seen seen, Path path, mat3 turn, mat3 slopes, float number, vec3 rest, vec2 opacities)
{
  vec3 deformed = positionOf(path.deformed, number);
  bool ignored = isRemoved(deformed);
  float behindBoth = (1.0 - seen.own.opacity) * (1.0 - seen.other.opacity);
  vec2 fractions = opacities *
    (ignored
        ? behindBoth * vec2(1.0, 1.0 - opacities.x) // nothing agrees there: each hides the other
        : vec2(seenFraction(seen.own, seen.other, number),
            seenFraction(seen.other, seen.own, number)));
  vec2 own = vec2(0.0);
  vec2 other = vec2(0.0);
  if (opacities.x > 0.0 && 1.0 - seen.own.opacity > Negligible)
  {
    vec3 gradient =
      atWall(turn * deformedGradientFromRest(slopes, litGradientAt(rest)), deformed, turn);
    own = lightOf(gradient, path.towardsEye, deformed);
  }
  if (opacities.y > 0.0 && 1.0 - seen.other.opacity > Negligible)
  {
    vec3 gradient =
      worldFromReferenceGradient * referenceGradientAt(positionOf(path.reference, number));
    other = lightOf(gradient, path.towardsEye, deformed);
  }
  vec2 light = fractions * vec2(own.x, other.x);
  seen.light += ignored ? vec3(0.5 * (light.x + light.y))
                        : light.x * evidentStripes(ownColor, rest) + light.y * referenceColor;
  join(seen.own, opacities.x, own.y, number);
  join(seen.other, opacities.y, other.y, number);
}
