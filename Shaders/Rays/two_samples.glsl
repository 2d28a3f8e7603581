// Takes two samples of a ray at a time: their reads do not wait for each other, and one Jacobian
// serves both. pointwise.glsl and averaged.glsl come before and say what two samples add:
// colorsOfTwo finds colour and opacity, seeTwo adds them under light.

Pair pairAt(Path path, float i)
{
  Pair pair;
  pair.oneDeformed = positionOf(path.deformed, i);
  pair.twoDeformed = positionOf(path.deformed, i + 1.0);
  pair.oneRest = pair.oneDeformed;
  pair.twoRest = pair.twoDeformed;
  if (mayMove(path.moved, i))
  {
    pair.oneRest += offsetAt(positionOf(path.field, i));
    pair.twoRest += offsetAt(positionOf(path.field, i + 1.0));
  }
  pair.oneScalar = scalarAt(pair.oneRest);
  pair.twoScalar = scalarAt(pair.twoRest);
  return pair;
}

// Takes the samples i and i + 1. Returns whether one of them is visible.
bool takeTwo(Path path, TissueTable table, mat3 turn, float i, inout Seen seen)
{
  Pair pair = pairAt(path, i);
  vec4 one = vec4(0.0);
  vec4 two = vec4(0.0);
  if (!colorsOfTwo(path, table, pair, i, seen, one, two))
  {
    return false;
  }
  bool visible = max(one.a, two.a) > 0.0;
  if (visible)
  {
#ifdef WISHES
    askForBrick(pair.oneRest);
    askForBrick(pair.twoRest);
#endif
    mat3 slopes = mat3(0.0);
    if (mayMove(path.moved, i)) // else there is nothing to turn
    {
      slopes = offsetSlopes(positionOf(path.field, i) + 0.5 * path.field.stride);
    }
    if (steepen(pair, slopes, one, two))
    {
      seeTwo(path, pair, slopes, turn, i, one, two, seen);
    }
  }
  return visible;
}
