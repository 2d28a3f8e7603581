// How much the tissue around a first hit hides it from light, 0 to 1. Two neighbours on opposite
// sides of the hit make a pair. On a plane they lie on one line with the hit, and in a groove both
// lie nearer to the eye than that line. So a pair shows the depth of the hit, without a normal.
// First hits are on the visible surface of bent tissue, so occlusion follows the deformation.
// Screen-space ambient occlusion: Mittring, "Finding next gen: CryEngine 2", SIGGRAPH 2007 courses.
// Pixels sample in turn, and are averaged: Keller and Heidrich, "Interleaved sampling", 2001.

uniform sampler2D hits;  // first hit, fraction of the way from near to far plane; below 0: none
uniform vec2 hitsTexel;  // one pixel, texture coordinates
uniform vec2 pictureLow; // the whole picture, pixels of the images
uniform vec2 pictureHigh;
uniform vec2 nearPixel;    // mm: sides of a pixel on the near plane
uniform vec2 pixelGrowth;  // mm by which they are longer on the far plane
uniform vec3 acrossAtZero; // mm right, up and ahead, from near to far plane, at pixel (0,0)
uniform float radius;      // mm
uniform float tolerance;   // mm: hits are known no better

const float Gain = 3.0;              // where pairs lean by a third, half of the light is hidden
const float NearestNeighbour = 0.15; // fraction of the radius; nearer ones show how samples lie
const vec4 Nothing = vec4(0.0, 1.0, 0.0, 0.0);

float hitOf(vec2 pixel)
{
  return textureLod(hits, pixel * hitsTexel, 0.0).r;
}

// How far a neighbour leans towards the eye, -1 to 1, and whether it is near, 1 to 0.
vec2 leaningOf(vec2 aside, float hit, vec3 across, vec3 towardsEye)
{
  float other = hitOf(gl_FragCoord.xy + aside);
  vec3 way = vec3(aside * (nearPixel + other * pixelGrowth), 0.0) + (other - hit) * across;
  float distance = max(length(way), 1e-6 * radius);
  vec2 leaning =
    vec2((dot(way, towardsEye) - tolerance) / distance, clamp(2.0 - distance / radius, 0.0, 1.0));
  return other < 0.0 ? vec2(-1.0, 0.0) : leaning;
}

// The fraction of light that two neighbours hide. A surface far in front of the hit on one side
// only hides nothing: it would have a dark rim. If both sides are far in front, the hit is in a
// pit.
float hiddenBy(vec2 one, vec2 two)
{
  float near = one.y * two.y;
  float pit = clamp(2.0 * min(one.x, two.x) - 1.0, 0.0, 1.0);
  return mix(pit, max(0.5 * (one.x + two.x), 0.0), near);
}

void main()
{
  float hit = hitOf(gl_FragCoord.xy);
  if (hit < 0.0)
  {
    gl_FragData[0] = Nothing;
    return;
  }
  vec3 across = vec3(acrossAtZero.xy + gl_FragCoord.xy * pixelGrowth, acrossAtZero.z);
  vec3 towardsEye = -normalize(across);
  vec2 most = min(radius / (nearPixel + hit * pixelGrowth), vec2(MOST_PIXELS));
  // 16 pixels look into different directions, and at different distances. The next pass averages.
  vec2 cell = mod(floor(gl_FragCoord.xy), 4.0);
  float rank = 4.0 * cell.y + cell.x;
  vec2 direction = normalize(vec2(1.0, (rank + 0.5) / 16.0));
  float within = fract(rank * 5.0 / 16.0) + 0.5 / 16.0;
  // What lies outside the picture is not known: pairs keep within it.
  vec2 room = min(gl_FragCoord.xy - pictureLow, pictureHigh - gl_FragCoord.xy) - 0.5;
  float hidden = 0.0;
  for (float pair = 0.0; pair < 4.0; pair += 1.0)
  {
    float fraction = 0.25 * (mod(pair + rank, 4.0) + within);
    vec2 aside = floor(mix(NearestNeighbour, 1.0, fraction) * direction * most + 0.5);
    aside = clamp(aside, -room, room);
    hidden += 0.25 *
      hiddenBy(
        leaningOf(aside, hit, across, towardsEye), leaningOf(-aside, hit, across, towardsEye));
    direction = sqrt(0.5) * vec2(direction.x - direction.y, direction.x + direction.y);
  }
  gl_FragData[0] = vec4(Gain * hidden / (1.0 + Gain * hidden), hit, 0.0, 0.0);
}
