// A plane through the deformed frame. Each fragment reads its tissue at the rest position that it
// came from, so that a slice is smooth at any zoom. Outside the tissue only the crosshair is drawn.

in vec3 deformed; // texture coordinates

uniform vec3 voxels;     // of the scalars, a side
uniform int cubic;       // 1: cubic filter of the scalars; else the texture's own
uniform float opacity;   // of everything
uniform int mapsOpacity; // 1: the opacity map counts, too
uniform int selecting;   // 1: only depth is drawn; colours are the background of a selection

#ifdef STREAMED
// A brick's slot has all voxels that the cubic filter reads.
float finerAt(vec3 rest)
{
  vec3 fine = fineAt(rest);
  holdBrickOf(fine);
  return heldIsThere ? filteredAt(atlas, positionInAtlas(fine), vec3(textureSize(atlas, 0)), cubic)
                     : filteredAt(scalars, rest, voxels, cubic);
}
#endif

void main()
{
  vec3 rest = restFromDeformed(deformed);
  vec3 held = heldFromRest(rest);
#ifdef STREAMED
  float scalar = finerAt(rest);
#else
  float scalar = filteredAt(scalars, held, voxels, cubic);
#endif
  bool hasTissue = insideVolume(rest) && isNumber(scalar);
  vec4 tissue = tissueOf(scalar);
  vec4 seen = vec4(markedInSlice(ownColorOf(tissue, held), deformed, rest), tissue.a);
  bool drawn = compare(hasTissue, scalar, Place(deformed, rest), seen);
  vec3 lineColor;
  bool isLine = onCrosshair(deformed, lineColor);
  if (!inPart(deformed) || !(drawn || isLine))
  {
    discard;
  }
  if (isLine)
  {
    gl_FragData[0] = vec4(lineColor, 1.0);
    return;
  }
  float fraction = opacity * (mapsOpacity == 1 ? seen.a : 1.0);
  vec4 picture = vec4(seen.rgb * fraction, fraction);
  gl_FragData[0] = selecting == 1 ? vec4(0.0) : picture;
}
