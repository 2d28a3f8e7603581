// Which samples of a ray can be visible, from the faces of the occupied bricks (proxy.frag.glsl).

uniform int skipping;         // 0: all samples, for comparison
uniform sampler2D spans;      // red: least t on an occupied brick's face; green: minus the greatest
uniform sampler3D presence;   // 1 where a brick of the deformed frame may show something
uniform vec3 brickFromTexture;
uniform vec3 brickOfTextureZero; // minus the first brick

const float Nothing = 1e29; // what `spans` holds where no face is

// The eye may be inside an occupied brick: its front faces are then behind the eye.
bool startsInside(vec3 position)
{
  ivec3 brick = ivec3(floor(position * brickFromTexture + brickOfTextureZero));
  ivec3 nearest = clamp(brick, ivec3(0), textureSize(presence, 0) - 1);
  return brick == nearest && texelFetch(presence, nearest, 0).r > 0.5;
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
  float nearest = startsInside(ray.start) ? 0.0 : found.x;
  // One sample more to either side for rounding.
  ivec2 present = ivec2(int(floor((nearest - span.x) / stepMm)) - 1,
    int(ceil((-found.y - span.x) / stepMm)) + 2);
  return ivec2(max(present.x, all.x), min(present.y, all.y));
}
