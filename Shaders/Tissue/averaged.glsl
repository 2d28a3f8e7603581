// What samples add where the colour map rises to opaque within less than scalars change in a step.
// A sample then stands for the way from the one before it, with what the map holds on average
// between the two scalars: the map at the sample alone would show how deep the first one lies, as
// rings. Two samples share one light, at the middle of what they show.

uniform sampler2D transferSums; // before each entry of the map: sums of colour times opacity and
                                // of opacity; of the latter 1 more, negative if it is invisible

const float Entries = float(TRANSFER_ENTRIES);

struct Entry
{
  float number;
  vec4 sums;
  bool visible;
};

Entry entryOf(TissueTable table, float scalar)
{
  float coordinate = scalar * table.transferFromScalar.x + table.transferFromScalar.y;
  float number = clamp(floor(Entries * coordinate), 0.0, Entries - 1.0);
  vec4 sums = textureLod(transferSums, vec2((number + 0.5) / Entries, transferRow), 0.0);
  return Entry(number, vec4(sums.rgb, abs(sums.a)), sums.a > 0.0 && !isnan(scalar));
}

// Colour and opacity between two scalars, of which one is visible.
vec4 averageOf(TissueTable table, Entry from, Entry to, float scalar)
{
  float entries = to.number - from.number;
  if (entries == 0.0)
  {
    return tissueOf(table, scalar);
  }
  vec4 average = (to.sums - from.sums) / entries;
  return vec4(average.rgb / max(average.a, 1e-6), average.a);
}

// How much of what the colour map has there is drawn: cropping, the volume's box, a segment.
float shownShare(TissueTable table, vec3 deformed, vec3 rest, float scalar)
{
  bool shown = inShownRegion(deformed) && insideVolume(table, rest) && !isnan(scalar);
  return shown ? segmentOpacityAt(rest) : 0.0;
}

float scalarOfSample(Path path, float i)
{
  vec3 rest = positionOf(path.deformed, i);
  if (i >= path.moved.x && i < path.moved.y)
  {
    rest += offsetAt(positionOf(path.field, i));
  }
  return scalarAt(rest);
}

// Takes the samples i and i + 1: their reads do not wait for each other, and one Jacobian does for
// both. Whether something is seen.
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
  bool follows = seen.lastNumber == i - 1.0;
  bool zeroVisible = follows && seen.lastVisible; // what was not taken is not visible
  float zeroScalar = seen.lastScalar;
  seen.lastNumber = i + 1.0;
  seen.lastScalar = twoScalar;
  seen.lastVisible = false;
  if (!mayBeVisible(table, oneScalar) && !mayBeVisible(table, twoScalar) && !zeroVisible)
  {
    return false;
  }
  if (!follows)
  {
    zeroScalar = scalarOfSample(path, i - 1.0);
  }
  Entry zero = entryOf(table, isnan(zeroScalar) ? oneScalar : zeroScalar);
  Entry one = entryOf(table, oneScalar);
  Entry two = entryOf(table, twoScalar);
  float oneShare = shownShare(table, oneDeformed, oneRest, oneScalar);
  float twoShare =
    i + 1.0 < path.samples.y ? shownShare(table, twoDeformed, twoRest, twoScalar) : 0.0;
  bool oneVisible = one.visible && oneShare > 0.0;
  seen.lastVisible = two.visible && twoShare > 0.0;
  vec4 first = averageOf(table, zero, one, oneScalar);
  vec4 second = averageOf(table, isnan(oneScalar) ? two : one, two, twoScalar);
  first.a *= zeroVisible || oneVisible ? oneShare : 0.0;
  second.a *= oneVisible || seen.lastVisible ? twoShare : 0.0;
  bool visible = max(first.a, second.a) > 0.0;
  if (visible)
  {
    mat3 slopes = mat3(0.0);
    if (oneRest != oneDeformed) // where nothing moves there is nothing to turn
    {
      slopes = offsetSlopes(positionOf(path.field, i) + 0.5 * path.field.stride);
    }
    // The middle of the way that a sample stands for lies half a step before it.
    float further = (1.0 - first.a) * second.a;
    float way = further / (first.a + further) - 0.5;
    Shine shine = shineAt(mix(oneDeformed, twoDeformed, way), mix(oneRest, twoRest, way), slopes,
      turn, path.towardsEye);
    // As if all from the surface on were opaque: opacities are then parts of a step behind it.
    see(seen, shown(first, oneRest, shine), i - seen.picture.a - first.a);
    see(seen, shown(second, twoRest, shine), i + 1.0 - seen.picture.a - second.a);
  }
  return visible;
}
