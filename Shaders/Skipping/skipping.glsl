// Which samples of a ray can be visible. The faces of the occupied bricks (proxy.frag.glsl) say
// where to start and end. The distance to occupied bricks tells how far to leap in between
// (Cohen and Sheffer, "Proximity clouds", The Visual Computer 11, 1994).

uniform int skipping; // 0: all samples, for comparison
// Red: fraction of the ray before the first face of an occupied brick. Green: fraction of the ray
// behind the last face. 16 bits each.
uniform sampler2D spans;
uniform vec2 spansTexel; // one pixel, texture coordinates of `spans`
// For each brick of the deformed frame: distance to the nearest brick in which something may be
// seen, in bricks, of 255.
uniform sampler3D leaps;
uniform vec3 brickFromTexture;
uniform vec3 brickOfTextureZero; // minus the first brick
uniform vec3 leapsTexel;         // one brick, texture coordinates of `leaps`
#ifdef COMPARED
uniform sampler3D referenceLeaps; // the leaps of the reference: bricks of its own voxels, unbent
uniform vec3 brickFromReference;
uniform vec3 brickOfReferenceZero;
uniform vec3 referenceLeapsTexel;

vec3 referenceFromDeformed(vec3 deformed); // reference.glsl
#endif

const float SpanRounding = 1.0 / 65535.0; // of a fraction, at most
// So many samples, at the start and after a visible one, do not ask whether their brick is empty.
const float Trust = 8.0;

bool isOccupied(sampler3D map, vec3 place)
{
  bool among = all(greaterThanEqual(place, vec3(0.0))) && all(lessThan(place, vec3(1.0)));
  return among && textureLod(map, place, 0.0).r == 0.0;
}

// The eye may be inside an occupied brick: its front faces are then behind the eye.
bool startsInside(vec3 position)
{
  vec3 bricks = position * brickFromTexture + brickOfTextureZero;
#ifdef COMPARED
  vec3 place = referenceFromDeformed(position);
  vec3 referenceBricks = place * brickFromReference + brickOfReferenceZero;
  return isOccupied(leaps, bricks * leapsTexel) ||
    isOccupied(referenceLeaps, referenceBricks * referenceLeapsTexel);
#else
  return isOccupied(leaps, bricks * leapsTexel);
#endif
}

// Fraction of the ray before the first face, and behind the last one; 1 if the ray meets none.
vec2 spanOfPixel()
{
  return textureLod(spans, gl_FragCoord.xy * spansTexel, 0.0).rg;
}

// Whether the ray meets no occupied brick for certain. From inside a brick it would leave one.
bool meetsNothing()
{
  return skipping == 1 && spanOfPixel().y == 1.0;
}

// First sample, and one past the last. Samples are numbered from t = span.x.
vec2 presentSamples(Ray ray, vec2 span, float stepMm)
{
  vec2 all = vec2(0.0, ceil((span.y - span.x) / stepMm));
  if (skipping == 0)
  {
    return all;
  }
  vec2 found = spanOfPixel();
  if (found.y == 1.0)
  {
    return vec2(0.0);
  }
  found = (found - SpanRounding) * ray.lengthMm;
  float nearest = startsInside(ray.start) ? 0.0 : found.x;
  // One more sample on either side, for rounding.
  vec2 present = vec2(floor((nearest - span.x) / stepMm) - 1.0,
    ceil((ray.lengthMm - found.y - span.x) / stepMm) + 2.0);
  return vec2(max(present.x, all.x), min(present.y, all.y));
}

// A ray in units of bricks, with what all its samples need: a ray leaves the brick whose lower
// corner is at `corner` at sample corner * samplesPerBrick + samplesToFace.
struct BrickTrack
{
  Track at;
  vec3 samplesPerBrick; // 1 / stride
  vec3 samplesToFace;
};

BrickTrack brickTrack(Track inBricks)
{
  BrickTrack bricks;
  bricks.at = inBricks;
  vec3 forward = step(0.0, bricks.at.stride);
  bricks.samplesPerBrick = (2.0 * forward - 1.0) / max(abs(bricks.at.stride), vec3(1e-9));
  bricks.samplesToFace = (forward - bricks.at.first) * bricks.samplesPerBrick;
  return bricks;
}

BrickTrack deformedBricks(Track deformed)
{
  return brickTrack(Track(
    deformed.first * brickFromTexture + brickOfTextureZero, deformed.stride * brickFromTexture));
}

// Finds whether something may be seen in the brick of sample `i`. Returns the first sample beyond
// that brick, or, if nothing may be seen, beyond all bricks around it that are known to be empty.
// `map`: the leaps.
float sampleBeyond(sampler3D map, vec3 mapTexel, BrickTrack bricks, float i, out bool present)
{
  vec3 position = positionOf(bricks.at, i);
  float away = floor(textureLod(map, position * mapTexel, 0.0).r * 255.0 + 0.5);
  present = away == 0.0;
  // The block of empty bricks: their distance less one to either side.
  float margin = max(away - 1.0, 0.0);
  vec3 samples = floor(position) * bricks.samplesPerBrick + bricks.samplesToFace +
    margin * abs(bricks.samplesPerBrick);
  return max(i, floor(min(samples.x, min(samples.y, samples.z)))) + 1.0;
}
