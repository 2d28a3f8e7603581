// A plane through the deformed frame. Each fragment looks its tissue up at the rest position it
// came from, so that a slice is as smooth at any zoom as what it shows. Nothing outside the tissue.

in vec3 deformed; // texture coordinates

uniform vec3 voxels;     // of the scalars, a side
uniform float opacity;   // of all
uniform int mapsOpacity; // 1: times the opacity map's
uniform int selecting;   // 1: only depth, and to a selection the background

void main()
{
  vec3 rest = restFromDeformed(deformed);
  float scalar = filteredAt(scalars, rest, voxels);
  bool hasTissue = insideVolume(rest) && !isnan(scalar);
  vec4 tissue = tissueOf(scalar);
  vec4 seen = vec4(colorOf(tissue, rest), tissue.a);
  if (!compare(hasTissue, scalar, deformed, seen))
  {
    discard;
  }
  float shown = opacity * (mapsOpacity == 1 ? seen.a : 1.0);
  vec4 picture = vec4(seen.rgb * shown, shown);
  gl_FragData[0] = selecting == 1 ? vec4(0.0) : picture;
}
