// Which texel of the 3D target a fragment of a volume pass writes.

flat in int layerGSOut;

ivec3 targetTexel()
{
  return ivec3(gl_FragCoord.xy, layerGSOut);
}
