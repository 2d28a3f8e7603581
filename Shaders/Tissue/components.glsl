// Colour of arrays with several numbers for each voxel. The last one gives the opacity.

#if defined(DIRECT_COLORS)
uniform sampler3D colors; // red, green, blue of the voxel

vec3 ownColorOf(vec4 tissue, vec3 rest)
{
  return textureLod(colors, rest, 0.0).rgb;
}
#elif defined(COLOR_SCALARS)
uniform sampler3D colorScalars;       // red: the first number, as stored
uniform vec2 transferFromColorScalar; // scale and shift: stored scalar to texture coordinate

vec3 ownColorOf(vec4 tissue, vec3 rest)
{
  float stored = textureLod(colorScalars, rest, 0.0).r;
  float entry = stored * transferFromColorScalar.x + transferFromColorScalar.y;
  return textureLod(transfer, vec2(entry, transferRow), 0.0).rgb;
}
#else
vec3 ownColorOf(vec4 tissue, vec3 rest)
{
  return tissue.rgb;
}
#endif

// As drawn in 3D.
vec3 colorOf(vec4 tissue, vec3 rest)
{
  return marked(ownColorOf(tissue, rest), rest);
}
