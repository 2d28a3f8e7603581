// What two samples add if the colour map rises to opaque while scalars change by less than they do
// in one step. A sample then stands for the way from the sample before it, with the average of the
// map between the two scalars. The map at the sample alone would show rings, which tell how deep in
// the tissue the first sample is. Pre-integration without the attenuation within a step: Engel,
// Kraus and Ertl, Graphics Hardware 2001. Two samples share one light, at the middle of what they
// show.

// For each entry of the map: the sums, over all entries before it, of colour times opacity, and of
// opacity plus 1. The latter is negative if the entry itself is invisible.
uniform sampler2D transferSums;

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
  return Entry(number, vec4(sums.rgb, abs(sums.a)), sums.a > 0.0 && isNumber(scalar));
}

// Colour and opacity between two scalars. At least one of them is visible.
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

// The fraction of the map's opacity that is drawn, after cropping, the volume's box, a segment
// and a resection.
float drawnFraction(TissueTable table, vec3 deformed, vec3 rest, float scalar)
{
  bool drawn = inKeptRegion(deformed) && insideVolume(table, rest) && isNumber(scalar);
  return drawn ? segmentOpacityAt(rest) * remainingAt(deformed) : 0.0;
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

// Finds colour and opacity. Returns false if neither sample nor the one before can be visible.
bool colorsOfTwo(Path path, TissueTable table, Pair pair, float i, inout Seen seen,
  inout vec4 first, inout vec4 second)
{
  bool follows = seen.lastNumber == i - 1.0;
  bool zeroVisible = follows && seen.lastVisible; // a sample that was not taken is not visible
  float zeroScalar = seen.lastScalar;
  seen.lastNumber = i + 1.0;
  seen.lastScalar = pair.twoScalar;
  seen.lastVisible = false;
  if (!mayBeVisible(table, pair.oneScalar) && !mayBeVisible(table, pair.twoScalar) && !zeroVisible)
  {
    return false;
  }
  if (!follows)
  {
    zeroScalar = scalarOfSample(path, i - 1.0);
  }
  Entry zero = entryOf(table, isNumber(zeroScalar) ? zeroScalar : pair.oneScalar);
  Entry one = entryOf(table, pair.oneScalar);
  Entry two = entryOf(table, pair.twoScalar);
  float oneFraction = drawnFraction(table, pair.oneDeformed, pair.oneRest, pair.oneScalar);
  float twoFraction = i + 1.0 < path.samples.y
    ? drawnFraction(table, pair.twoDeformed, pair.twoRest, pair.twoScalar)
    : 0.0;
  bool oneVisible = one.visible && oneFraction > 0.0;
  seen.lastVisible = two.visible && twoFraction > 0.0;
  first = averageOf(table, zero, one, pair.oneScalar);
  second = averageOf(table, isNumber(pair.oneScalar) ? one : two, two, pair.twoScalar);
  first.a *= zeroVisible || oneVisible ? oneFraction : 0.0;
  second.a *= oneVisible || seen.lastVisible ? twoFraction : 0.0;
  return true;
}

// Adds both samples under light. `slopes`: of the offsets near them; `turn`: worldFromGradient.
void seeTwo(
  Path path, Pair pair, mat3 slopes, mat3 turn, float i, vec4 first, vec4 second, inout Seen seen)
{
  // The middle of the way that a sample stands for lies half a step before it.
  float further = (1.0 - first.a) * second.a;
  float way = further / (first.a + further) - 0.5;
  Shine shine = shineBetween(path, pair, slopes, turn, way);
  float before = seen.picture.a;
  see(seen, litTissue(first, pair.oneRest, shine));
  float between = seen.picture.a;
  see(seen, litTissue(second, pair.twoRest, shine));
  if (hasReached(seen))
  {
    // As if all from the surface on were opaque: opacities are then parts of a step behind it.
    float surface =
      between >= HitOpacity ? i - before - first.a : i + 1.0 - between - second.a;
    seen.hit = max(surface, 0.0);
  }
}
