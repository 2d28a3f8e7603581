// Which texel of the 3D target a fragment of a volume pass writes.

flat in int layerGSOut;

// As whole floats: software drivers turn what becomes an integer lane by lane.
vec3 targetTexel()
{
  return vec3(floor(gl_FragCoord.xy), layerGSOut);
}
