// Which samples of a ray can be visible: from the faces of the occupied bricks (proxy.frag.glsl)
// where to start and end, from the distance to occupied bricks where to leap in between.

uniform int skipping;         // 0: all samples, for comparison
uniform sampler2D spans;      // red: least share of the ray on an occupied brick's face; green: what
                              // is left of the ray behind the last one; 16 bits each
uniform vec2 spansTexel;      // one pixel, texture coordinates of `spans`
uniform sampler3D leaps;      // bricks of the deformed frame: 0 where something may be seen, else how
                              // many bricks away, of 255, the nearest such brick is
uniform vec3 brickFromTexture;
uniform vec3 brickOfTextureZero; // minus the first brick
uniform vec3 leapsTexel;         // one brick, texture coordinates of `leaps`
#ifdef COMPARED
uniform sampler3D referenceLeaps; // the same of the reference: bricks of its own voxels, unbent
uniform vec3 brickFromReference;
uniform vec3 brickOfReferenceZero;
uniform vec3 referenceLeapsTexel;

vec3 referenceFromDeformed(vec3 deformed); // reference.glsl
#endif

const float SpanRounding = 1.0 / 65535.0; // of a share, at most
const float Trust = 8.0; // so many samples, first ones and after a visible one, are not asked about

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

// Share of the ray before the first face, and behind the last; 1 where the ray meets none.
vec2 spanOfPixel()
{
  return textureLod(spans, gl_FragCoord.xy * spansTexel, 0.0).rg;
}

// Whether the ray is known to meet no occupied brick: even from inside it would leave one.
bool meetsNothing()
{
  return skipping == 1 && spanOfPixel().y == 1.0;
}

// First sample and one past the last; samples are numbered from t = span.x.
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
  // One sample more to either side for rounding.
  vec2 present = vec2(floor((nearest - span.x) / stepMm) - 1.0,
    ceil((ray.lengthMm - found.y - span.x) / stepMm) + 2.0);
  return vec2(max(present.x, all.x), min(present.y, all.y));
}

// A ray among the bricks, counted in them. What holds for all its samples is made ready: a brick
// with its lower corner at `corner` is left at sample corner * samplesPerBrick + samplesToFace.
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
  return brickTrack(Track(deformed.first * brickFromTexture + brickOfTextureZero,
    deformed.stride * brickFromTexture));
}

// Whether something may be seen in the brick that sample `i` is in, and the first sample beyond it;
// if nothing may, beyond all bricks around it that are as empty. `map`: their leaps.
float sampleBeyond(sampler3D map, vec3 mapTexel, BrickTrack bricks, float i, out bool present)
{
  vec3 position = positionOf(bricks.at, i);
  float away = floor(textureLod(map, position * mapTexel, 0.0).r * 255.0 + 0.5);
  present = away == 0.0;
  // The block of empty bricks: so many to either side, less one.
  float margin = max(away - 1.0, 0.0);
  vec3 samples = floor(position) * bricks.samplesPerBrick + bricks.samplesToFace +
    margin * abs(bricks.samplesPerBrick);
  return max(i, floor(min(samples.x, min(samples.y, samples.z)))) + 1.0;
}
