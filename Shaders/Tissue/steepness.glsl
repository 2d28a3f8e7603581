// Opacity that depends on how steep the scalar is, too, as in VTK's volume mapper. Steepness is the
// length of the gradient in the deformed frame: 1 if the scalar changes by a quarter of the array's
// range, or more, over a mean voxel side.

#ifdef STEEPNESS
// With STEEPNESS_TABLE colour and opacity over scalar and steepness, else a factor over steepness.
uniform sampler2D steepness;
uniform vec3 steepStep;          // one voxel as VTK counts it, texture coordinates
uniform vec3 steepFromGradient;  // factors on a gradient for texture units
uniform vec2 entryFromSteepness; // texture coordinate y: scale and shift
uniform float opacitySteps;      // a sample is as long as so many that the opacities hold for

vec3 steepGradientAt(vec3 rest)
{
  return centralDifferences(scalars, rest, steepStep);
}

// A gradient that is not a number counts as none. `gradient`: deformed frame.
float steepnessOf(vec3 gradient)
{
  float steep = length(gradient * steepFromGradient);
  return isNumber(steep) ? min(steep, 1.0) : 0.0;
}

#ifdef STEEPNESS_TABLE
uniform vec2 entryFromScalar; // texture coordinate x: scale and shift

vec4 steepTissue(vec4 tissue, float scalar, float entry)
{
  float column = scalar * entryFromScalar.x + entryFromScalar.y;
  vec4 found = textureLod(steepness, vec2(column, entry), 0.0);
  return vec4(found.rgb, found.a * tissue.a);
}
#else
vec4 steepTissue(vec4 tissue, float scalar, float entry)
{
  return vec4(tissue.rgb, tissue.a * textureLod(steepness, vec2(0.5, entry), 0.0).r);
}
#endif

// Colour and opacity of a sample. `tissue`: the colour map's colour, and opacity or, for a table,
// the fraction of opacity that is drawn. `gradient`: deformed frame.
vec4 steepened(vec4 tissue, float scalar, vec3 gradient)
{
  if (tissue.a <= 0.0)
  {
    return vec4(0.0);
  }
  float entry = steepnessOf(gradient) * entryFromSteepness.x + entryFromSteepness.y;
  vec4 steep = steepTissue(tissue, scalar, entry);
  float behind = 1.0 - steep.a; // what one such step lets through
  steep.a = opacitySteps == 1.0 ? steep.a : 1.0 - (behind > 0.0 ? pow(behind, opacitySteps) : 0.0);
  return steep;
}
#endif
