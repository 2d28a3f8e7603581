// Composite blending of a bent volume and a reference, each in its colour, along one ray.

// Takes the samples i and i + 1. Returns whether one of them is visible.
bool takeTwo(
  Path path, TissueTable table, TissueTable referenceTable, mat3 turn, float i, inout Seen seen)
{
  vec3 oneDeformed = positionOf(path.deformed, i);
  vec3 twoDeformed = positionOf(path.deformed, i + 1.0);
  vec3 oneRest = oneDeformed;
  vec3 twoRest = twoDeformed;
  bool moved = mayMove(path.moved, i);
  vec2 own = vec2(0.0);
  vec2 other = vec2(0.0);
  // A volume adds nothing behind its own opaque tissue.
  if (seen.own.opacity <= OpaqueEnough && i + 1.0 >= path.own.x && i < path.own.y)
  {
    if (moved)
    {
      oneRest += offsetAt(positionOf(path.field, i));
      twoRest += offsetAt(positionOf(path.field, i + 1.0));
    }
    own = ownOpacities(table, oneRest, twoRest, path.own, i);
  }
  if (seen.other.opacity <= OpaqueEnough && i + 1.0 >= path.other.x && i < path.other.y)
  {
    other = referenceOpacities(referenceTable, positionOf(path.reference, i),
      positionOf(path.reference, i + 1.0), path.other, i);
  }
  vec2 regions = vec2(inKeptRegion(oneDeformed), inKeptRegion(twoDeformed));
  own *= regions * vec2(remainingAt(oneDeformed), remainingAt(twoDeformed));
  other *= regions;
  bool visible = max(max(own.x, own.y), max(other.x, other.y)) > 0.0;
  if (visible)
  {
    mat3 slopes = mat3(0.0);
    if (moved) // else there is nothing to turn
    {
      slopes = offsetSlopes(positionOf(path.field, i) + 0.5 * path.field.stride);
    }
    see(seen, path, turn, slopes, i, oneRest, vec2(own.x, other.x));
    see(seen, path, turn, slopes, i + 1.0, twoRest, vec2(own.y, other.y));
  }
  return visible;
}

// Whether nothing that follows would be seen. The first hit of the bent volume is wanted even
// behind the reference: a tool takes hold of it.
bool isDone(Seen seen, Path path, float number)
{
  float left =
    max(seenFraction(seen.own, seen.other, number), seenFraction(seen.other, seen.own, number));
  return left < 1.0 - OpaqueEnough && (seen.own.hit >= 0.0 || number >= path.own.y);
}

// Finds whether either volume may be seen at sample `i`. Returns the first sample beyond, where
// that is unknown again.
float sampleBeyondBoth(Path path, float i, out bool present)
{
  float own = sampleBeyond(leaps, leapsTexel, path.bricks, i, present);
  if (present)
  {
    return own;
  }
  float other = sampleBeyond(referenceLeaps, referenceLeapsTexel, path.referenceBricks, i, present);
  return present ? other : min(own, other);
}

void main()
{
  Path path = pathOf(rayOfPixel(ndc));
  TissueTable table = tissueTable();
  TissueTable tableOfReference = referenceTable();
  mat3 turn = worldFromGradient;
  Seen seen = Seen(vec3(0.0), NothingMet, NothingMet);
  float end = path.samples.y;
  float i = evenBelow(path.samples.x);
  float ask = skipping == 0 ? end : i + Trust; // the first sample whose brick is asked
  float taken = 0.0;
  while (i < end && !isDone(seen, path, i))
  {
    bool present = true;
    if (i >= ask)
    {
      ask = evenBelow(sampleBeyondBoth(path, i, present));
      present = present || ask <= i;
    }
    float next = ask;
    if (present)
    {
      bool visible = takeTwo(path, table, tableOfReference, turn, i, seen);
      ask = visible ? max(ask, i + Trust) : ask;
      taken += min(2.0, end - i);
      next = i + 2.0;
    }
    i = next;
  }
  float all = ceil((path.span.y - path.span.x) / stepMm);
  countSamples(taken, max(min(i, all) - taken, 0.0));
  gl_FragData[0] = vec4(seen.light, max(seen.own.opacity, seen.other.opacity));
  float hit = seen.own.hit;
  gl_FragData[1] = hit < 0.0 ? NoHit : hitAt(path.span.x + hit * stepMm);
}
