// Where the bent volume and the reference disagree: 1 minus the squared correlation of both in a
// round window in the plane of the slice. No linear change of contrast alters that, nor does an
// inversion (Cachier et al., Computer Vision and Image Understanding 89, 2003).

#ifdef COMPARED
uniform vec3 windowRadius; // texture units

// Samples lie on a spiral, so that their places within voxels differ. On a raster they would all
// lie on voxels or all between them, where interpolation smooths, and the map would show a grid.
const int WindowSamples = 24;
const mat2 GoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

const float LeastKnown = 0.5;     // fraction of the weight below which nothing is said ...
const float FullyKnown = 0.75;    // ... and from which all is; between them the tint fades
const float FlatSpread = 0.03;    // standard deviation of noise, fraction of the range of greys ...
const float SureSpread = 0.08;    // ... and of structures that noise cannot be
const float LeastVariance = 1e-6; // so far below noise that only flat volumes feel it

// Weighted sums over a window.
struct Moments
{
  float whole;    // weight of all samples
  float known;    // of those that count
  vec2 fractions; // of the volume and of the reference
  vec3 products;  // volume squared, reference squared, both
};

vec3 alongAxis(int axis)
{
  return vec3(equal(ivec3(0, 1, 2), ivec3(axis % 3)));
}

// Adds what both volumes show at a place, unless one of them is unknown there.
void addSample(vec3 deformed, float weight, inout Moments window)
{
  vec3 rest = restFromDeformed(deformed);
  float scalar = scalarAt(heldFromRest(rest));
  vec3 place = (referenceFromTexture * vec4(deformed, 1.0)).xyz;
  Referenced other = referenced(place, textureLod(reference, place, 0.0).r);
  if (insideVolume(rest) && isNumber(scalar) && other.known && !isRemoved(deformed))
  {
    vec2 fractions = vec2(ownFraction(scalar), other.fraction);
    window.known += weight;
    window.fractions += weight * fractions;
    window.products += weight * vec3(fractions * fractions, fractions.x * fractions.y);
  }
}

// A sample at a distance r of the radius weighs 1 - r^2, and samples are as dense as that, too.
// Together they weigh tissue by the square of it.
Moments momentsAround(vec3 deformed)
{
  vec3 right = windowRadius * alongAxis(quadAxis + 1);
  vec3 up = windowRadius * alongAxis(quadAxis + 2);
  Moments window = Moments(0.0, 0.0, vec2(0.0), vec3(0.0));
  vec2 direction = vec2(1.0, 0.0);
  for (int i = 0; i < WindowSamples; ++i)
  {
    float weight = sqrt(1.0 - (float(i) + 0.5) / float(WindowSamples));
    vec2 place = sqrt(1.0 - weight) * direction;
    addSample(deformed + place.x * right + place.y * up, weight, window);
    window.whole += weight;
    direction = GoldenTurn * direction;
  }
  return window;
}

// 0: they agree, or there is nothing to say; 1: nothing of one is seen in the other. Read with the
// textures' own filter: the window smooths more than a cubic filter does.
float disagreementAt(vec3 deformed)
{
  Moments window = momentsAround(deformed);
  float known = max(window.known, 1e-6); // nothing at all is known: the tint is 0 below
  vec2 means = window.fractions / known;
  vec3 spread = window.products / known - vec3(means * means, means.x * means.y);
  vec2 variances = max(spread.xy, 0.0);
  float correlation =
    spread.z * spread.z / ((variances.x + LeastVariance) * (variances.y + LeastVariance));
  float deviation = sqrt(max(variances.x, variances.y));
  return smoothstep(LeastKnown, FullyKnown, window.known / window.whole) *
    smoothstep(FlatSpread, SureSpread, deviation) * (1.0 - min(correlation, 1.0));
}
#endif
