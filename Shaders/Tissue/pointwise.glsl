// What samples add, each with the opacity that the colour map has at it.

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
    see(seen, shown(one, oneRest, oneShine), i - 0.5);
    see(seen, shown(two, twoRest, twoShine), i + 0.5);
  }
  return visible;
}
