// Tissue that was removed; comparisons ignore it. Its edge lies where interpolation passes 0.5.

#ifdef CAVITY
uniform sampler3D cavity;       // red: 0 or 1, as stored; linear in between
uniform mat4 cavityFromTexture; // its texture coordinates from the volume's
uniform float leastCavity;      // the stored number for 0.5

bool isRemoved(vec3 deformed)
{
  vec3 place = (cavityFromTexture * vec4(deformed, 1.0)).xyz;
  return all(greaterThanEqual(place, vec3(0.0))) && all(lessThan(place, vec3(1.0))) &&
    textureLod(cavity, place, 0.0).r > leastCavity;
}
#else
bool isRemoved(vec3 deformed)
{
  return false;
}
#endif
