// What two samples add, each with the opacity that the colour map has at it.

// Finds colour and opacity. Returns false if neither sample can be visible.
bool colorsOfTwo(Path path, TissueTable table, Pair pair, float i, inout Seen seen,
  inout vec4 one, inout vec4 two)
{
  if (!mayBeVisible(table, pair.oneScalar) && !mayBeVisible(table, pair.twoScalar))
  {
    return false;
  }
  one = tissueAt(table, pair.oneRest, pair.oneScalar);
  two = tissueAt(table, pair.twoRest, pair.twoScalar);
  one.a = inKeptRegion(pair.oneDeformed) ? one.a * remainingAt(pair.oneDeformed) : 0.0;
  two.a = i + 1.0 < path.samples.y && inKeptRegion(pair.twoDeformed)
    ? two.a * remainingAt(pair.twoDeformed)
    : 0.0;
  return true;
}

// Where a ray reaches HitOpacity within the step of a sample, in samples from the step's start.
// `before`: opacity in front of it. Else a first hit in translucent tissue would depend on where
// samples lie, and occlusion with it. Opaque tissue begins where its step begins.
float surfaceWithin(float before, float opacity)
{
  float wanted = clamp((HitOpacity - before) / max(1.0 - before, 1e-6), 0.0, 1.0);
  return clamp(wanted * (1.0 - opacity) / max(opacity * (1.0 - wanted), 1e-6), 0.0, 1.0);
}

// Adds both samples under light. `slopes`: of the offsets near them; `turn`: worldFromGradient.
void seeTwo(Path path, Pair pair, mat3 slopes, mat3 turn, float i, vec4 one, vec4 two,
  inout Seen seen)
{
#ifdef SHARED_LIGHT
  // Light is found once, at the middle of what the two show.
  float further = (1.0 - one.a) * two.a;
  float way = further / (one.a + further);
  Shine oneShine = shineBetween(path, pair, slopes, turn, way);
  Shine twoShine = oneShine;
#else
  Shine oneShine =
    shineOf(pair.oneDeformed, gradientOfOne(pair), slopes, turn, path.towardsEye);
  Shine twoShine =
    shineOf(pair.twoDeformed, gradientOfTwo(pair), slopes, turn, path.towardsEye);
#endif
  float before = seen.picture.a;
  see(seen, litTissue(one, pair.oneRest, oneShine));
  float between = seen.picture.a;
  see(seen, litTissue(two, pair.twoRest, twoShine));
  if (hasReached(seen))
  {
    float surface = between >= HitOpacity ? i - 0.5 + surfaceWithin(before, one.a)
                                          : i + 0.5 + surfaceWithin(between, two.a);
    seen.hit = max(surface, 0.0);
  }
}
