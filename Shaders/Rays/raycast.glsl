// Draws the deformed volume: the paper's ray caster (section 2). A ray runs straight through the
// deformed frame. Every sample reads its tissue at the rest position that it came from. The first
// target is the picture, the second one says where the first hit lies on the ray.

uniform vec2 firstPixel;   // first pixel of the picture that the images hold
uniform vec2 ndcFromPixel; // of the picture

// From pixels of the whole picture: a ray is identical to the bit whatever part the images hold.
vec2 ndc = (gl_FragCoord.xy + firstPixel) * ndcFromPixel - 1.0;

uniform vec3 spaceLow; // the part of the deformed frame that is drawn, texture coordinates
uniform vec3 spaceHigh;
uniform float stepMm;
uniform float jitter; // 1: neighbouring rays start at different fractions of a step, against rings
uniform mat3 worldFromGradient;  // world axes from a gradient for texture units (inverse transpose)
uniform vec3 worldOfTextureZero; // mm

const float OpaqueEnough = 254.0 / 255.0; // more would change less than one 8-bit level
const float HitOpacity = 0.5;             // the eye sees a surface where a ray reaches this
const vec4 NoHit = vec4(-1.0);

// The fraction of a step after which the first sample lies. On the volume's face itself, rounding
// would say whether a sample is inside: a face across the view would have holes.
const float BehindFace = 1.0 / 256.0;

// The fraction of the first step after which a pixel's ray starts: one of 16, ordered so that
// neighbours differ most (Bayer, 1973).
float startFraction(ivec2 pixel)
{
  int mixed = pixel.x ^ pixel.y;
  int rank = (mixed & 1) * 8 + (pixel.y & 1) * 4 + (mixed >> 1 & 1) * 2 + (pixel.y >> 1 & 1);
  return (float(rank) + 0.5) / 16.0;
}

// The composite mode takes two samples at a time.
float evenBelow(float number)
{
  return 2.0 * floor(0.5 * number);
}

// The part of the deformed frame that this MPI rank draws: planes as in clipping.glsl. Rays enter
// and leave it at even samples, as they do in the parts of the other ranks, so each sample is taken
// once.
uniform int partCount;
uniform vec4 partPlanes[6];

// Of samples numbered from t = `first`, those in the part: first, and one past the last. The planes
// 2 n and 2 n + 1 are the lower and the upper side of the part along an axis.
vec2 samplesInPart(Ray ray, float first, vec2 samples)
{
  if (partCount == 0)
  {
    return samples;
  }
  mat3 axes = mat3(partPlanes[0].xyz, partPlanes[2].xyz, partPlanes[4].xyz);
  vec3 at = ray.start * axes;
  vec3 slope = ray.direction * axes;
  vec3 low = at + vec3(partPlanes[0].w, partPlanes[2].w, partPlanes[4].w); // heights above a side
  vec3 high = vec3(partPlanes[1].w, partPlanes[3].w, partPlanes[5].w) - at;
  vec3 lowest = 2.0 * floor(0.5 * ceil((-low / slope - first) / stepMm)); // as evenBelow
  vec3 highest = 2.0 * floor(0.5 * ceil((high / slope - first) / stepMm));
  bvec3 rises = greaterThan(slope, vec3(0.0));
  vec3 enter = mix(highest, lowest, rises);
  vec3 leave = mix(lowest, highest, rises);
  // A ray along a side is in the part or not. A border belongs to one part.
  bvec3 along = equal(slope, vec3(0.0));
  bvec3 outside = bvec3(
    low.x < 0.0 || high.x <= 0.0, low.y < 0.0 || high.y <= 0.0, low.z < 0.0 || high.z <= 0.0);
  enter = mix(enter, vec3(samples.x), along);
  leave = mix(leave, mix(vec3(samples.y), vec3(0.0), outside), along);
  return vec2(max(samples.x, max(enter.x, max(enter.y, enter.z))),
    min(samples.y, min(leave.x, min(leave.y, leave.z))));
}

// The picture of a part. IceT adds bytes without a limit: where light is brighter than its opacity,
// a sum beyond 255 would begin at 0 again, as black.
vec4 pictureOfPart(vec4 picture)
{
  return partCount > 0 ? vec4(min(picture.rgb, picture.a), picture.a) : picture;
}

vec3 worldFromDeformed(vec3 deformed)
{
  return worldFromTexture * deformed + worldOfTextureZero;
}

uniform vec2 hitFromFraction; // scale and shift

// The second target for a hit at t: its fraction of the distance from the near to the far plane. A
// part of a picture uses the planes of the whole picture.
vec4 hitAt(float t)
{
  return vec4(t / rayOfPixel(ndc).lengthMm * hitFromFraction.x + hitFromFraction.y);
}

// What light does at a position with a gradient in the rest frame. `slopes`: of the offsets near
// it; `turn`: worldFromGradient.
Shine shineOf(vec3 deformed, vec3 restGradient, mat3 slopes, mat3 turn, vec3 towardsEye)
{
#ifdef SHADED
  vec3 gradient = atWall(turn * deformedGradientFromRest(slopes, restGradient), deformed, turn);
  float steepness = length(gradient);
  vec3 normal = steepness > 0.0 ? gradient / steepness : vec3(0.0);
  return shineOn(normal, towardsEye, worldFromDeformed(deformed));
#else
  return Shine(vec3(1.0), vec3(0.0));
#endif
}

Shine shineAt(vec3 deformed, vec3 rest, mat3 slopes, mat3 turn, vec3 towardsEye)
{
  return shineOf(deformed, litGradientAt(rest), slopes, turn, towardsEye);
}
