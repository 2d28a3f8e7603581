// A plane through the deformed frame. Each fragment looks its tissue up at the rest position it
// came from, so that a slice is as smooth at any zoom as what it shows. Nothing outside the tissue.

in vec3 deformed; // texture coordinates

uniform vec3 voxels;     // of the scalars, a side
uniform int cubic;       // 1: cubic filter
uniform float opacity;   // of all
uniform int mapsOpacity; // 1: times the opacity map's
uniform int selecting;   // 1: only depth, and to a selection the background

float filteredScalarAt(vec3 rest)
{
  return cubic == 1 ? cubicAt(scalars, rest, voxels) : scalarAt(rest);
}

void main()
{
  vec3 rest = restFromDeformed(deformed);
  float scalar = filteredScalarAt(rest);
  if (!insideVolume(rest) || isnan(scalar))
  {
    discard;
  }
  vec4 tissue = tissueOf(scalar);
  float shown = opacity * (mapsOpacity == 1 ? tissue.a : 1.0);
  vec3 color = compared(colorOf(tissue, rest), scalar, deformed);
  vec4 picture = vec4(color * shown, shown);
  gl_FragData[0] = selecting == 1 ? vec4(0.0) : picture;
}
