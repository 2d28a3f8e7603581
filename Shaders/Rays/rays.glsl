// From a pixel to its ray, in the volume's texture coordinates. t counts mm from the near plane in
// the volume's own frame. So the scale of an actor changes neither the number of samples nor the
// opacity, as in VTK.

uniform vec3 nearOrigin; // the near plane: position of ndc (0,0) and what one unit of ndc adds
uniform vec3 nearRight;
uniform vec3 nearUp;
uniform vec3 farOrigin; // the far plane: as for the near plane
uniform vec3 farRight;
uniform vec3 farUp;
uniform vec2 clipW;            // homogeneous w on the near and on the far plane
uniform mat3 worldFromTexture; // directions: mm (world axes) for one texture unit
uniform vec3 mmFromTexture;    // mm for one texture unit, before an actor's scale
uniform sampler2D sceneDepth;  // window depth of what is drawn already
// its texture coordinates from the fraction of the image: scale, shift
uniform vec2 depthFromFraction;
uniform vec2 depthOfFractionZero;

struct Ray
{
  vec3 start;     // texture coordinates, on the near plane
  vec3 direction; // texture coordinates for each mm
  float lengthMm; // near to far plane
};

Ray rayOfPixel(vec2 ndc)
{
  Ray ray;
  ray.start = nearOrigin + ndc.x * nearRight + ndc.y * nearUp;
  vec3 across = farOrigin + ndc.x * farRight + ndc.y * farUp - ray.start;
  ray.lengthMm = length(mmFromTexture * across);
  ray.direction = across / ray.lengthMm;
  return ray;
}

// Samples along a ray, in any coordinates: position of number 0, and step to the next.
struct Track
{
  vec3 first;
  vec3 stride;
};

// Numbers are whole, but floats: a software driver converts floats to integers lane by lane.
vec3 positionOf(Track track, float number)
{
  return track.first + number * track.stride;
}

// First and last t inside a box; last < first if the ray misses it.
vec2 boxSpan(Ray ray, vec3 low, vec3 high)
{
  vec3 atLow = (low - ray.start) / ray.direction;
  vec3 atHigh = (high - ray.start) / ray.direction;
  vec3 enter = min(atLow, atHigh);
  vec3 leave = max(atLow, atHigh);
  return vec2(max(max(enter.x, enter.y), max(enter.z, 0.0)),
    min(min(leave.x, leave.y), min(leave.z, ray.lengthMm)));
}

// t of the surface that is drawn already at this pixel; of the far plane if there is none.
float sceneDistance(Ray ray, vec2 fraction)
{
  float depth = textureLod(sceneDepth, fraction * depthFromFraction + depthOfFractionZero, 0.0).r;
  float nearer = clipW.x * depth;
  return ray.lengthMm * nearer / (nearer + clipW.y * (1.0 - depth));
}
