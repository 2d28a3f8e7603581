// Averages the occlusion of 16 neighbours, which looked into different directions, where they lie
// on the same surface.

uniform sampler2D occlusion; // occlusion, and the first hit: fraction of the way to the far plane
uniform vec2 occlusionTexel; // one pixel, texture coordinates
// a difference of first hits, times this, is 1 on different surfaces
uniform float sameFromFraction;

void main()
{
  vec2 middle = textureLod(occlusion, gl_FragCoord.xy * occlusionTexel, 0.0).rg;
  vec2 sum = vec2(0.0);
  for (float y = -2.0; y < 2.0; y += 1.0)
  {
    for (float x = -2.0; x < 2.0; x += 1.0)
    {
      vec2 place = (gl_FragCoord.xy + vec2(x, y)) * occlusionTexel;
      vec2 other = textureLod(occlusion, place, 0.0).rg;
      float weight = max(1.0 - abs(other.g - middle.g) * sameFromFraction, 0.0);
      sum += weight * vec2(other.r, 1.0);
    }
  }
  gl_FragData[0] = vec4(sum.x / sum.y);
}
