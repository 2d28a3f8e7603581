// Which samples of a ray can be visible: from the faces of the occupied bricks (proxy.frag.glsl)
// where to start and end, from the distance to occupied bricks where to leap in between.

uniform int skipping;         // 0: all samples, for comparison
uniform sampler2D spans;      // red: least share of the ray on an occupied brick's face; green: minus
                              // the greatest
uniform sampler3D leaps;      // bricks of the deformed frame: 0 where something may be seen, else how
                              // many bricks away, of 255, the nearest such brick is
uniform vec3 brickFromTexture;
uniform vec3 brickOfTextureZero; // minus the first brick
uniform vec3 leapsTexel;         // one brick, texture coordinates of `leaps`

const float Nothing = 1e29; // what `spans` holds where no face is
const int Trust = 8;        // so many samples after a visible one are not asked about

// The eye may be inside an occupied brick: its front faces are then behind the eye.
bool startsInside(vec3 position)
{
  ivec3 brick = ivec3(floor(position * brickFromTexture + brickOfTextureZero));
  ivec3 nearest = clamp(brick, ivec3(0), textureSize(leaps, 0) - 1);
  return brick == nearest && texelFetch(leaps, nearest, 0).r == 0.0;
}

// First sample and one past the last; samples are numbered from t = span.x.
ivec2 presentSamples(Ray ray, vec2 span, float stepMm)
{
  ivec2 all = ivec2(0, int(ceil((span.y - span.x) / stepMm)));
  if (skipping == 0)
  {
    return all;
  }
  vec2 found = texelFetch(spans, ivec2(gl_FragCoord.xy), 0).rg;
  if (found.y > Nothing)
  {
    return ivec2(0); // the ray meets no occupied brick: even from inside it would leave one
  }
  found *= ray.lengthMm;
  float nearest = startsInside(ray.start) ? 0.0 : found.x;
  // One sample more to either side for rounding.
  ivec2 present = ivec2(int(floor((nearest - span.x) / stepMm)) - 1,
    int(ceil((-found.y - span.x) / stepMm)) + 2);
  return ivec2(max(present.x, all.x), min(present.y, all.y));
}

// A ray among the bricks, counted in them.
struct BrickTrack
{
  Track at;
  vec3 samplesPerBrick; // 1 / stride
};

BrickTrack brickTrack(Track deformed)
{
  BrickTrack bricks;
  bricks.at = Track(deformed.first * brickFromTexture + brickOfTextureZero,
    deformed.stride * brickFromTexture);
  vec3 direction = mix(vec3(-1.0), vec3(1.0), greaterThanEqual(bricks.at.stride, vec3(0.0)));
  bricks.samplesPerBrick = direction / max(abs(bricks.at.stride), vec3(1e-9));
  return bricks;
}

// Whether something may be seen in the brick that sample `i` is in, and the first sample beyond it;
// if nothing may, beyond all bricks around it that are as empty.
int sampleBeyond(BrickTrack bricks, int i, out bool present)
{
  vec3 position = positionOf(bricks.at, i);
  float away = floor(textureLod(leaps, position * leapsTexel, 0.0).r * 255.0 + 0.5);
  present = away == 0.0;
  // The block of empty bricks: so many to either side, less one.
  float margin = max(away - 1.0, 0.0);
  vec3 forward = step(0.0, bricks.at.stride);
  vec3 beyond = floor(position) + forward + (2.0 * forward - 1.0) * margin;
  vec3 samples = (beyond - bricks.at.first) * bricks.samplesPerBrick;
  return max(i, int(floor(min(samples.x, min(samples.y, samples.z))))) + 1;
}
