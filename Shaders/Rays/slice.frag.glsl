// The plane of a slice through the deformed volume, with the scalars' colour and opacity.

uniform vec4 slicePlane; // texture coordinates: dot(xyz, p) + w is 0 on the plane

void main()
{
  March march = marchOf(ndc, 0.0);
  float height = dot(slicePlane.xyz, march.ray.start) + slicePlane.w;
  float t = -height / dot(slicePlane.xyz, march.ray.direction);
  float number = (t - march.span.x) / stepMm;
  vec3 deformed = deformedAt(march, number);
  vec3 rest = restAt(march, number);
  vec4 picture = vec4(0.0);
  vec2 space = boxSpan(march.ray, spaceLow, spaceHigh); // the first sample lies behind a cut
  bool reached = t >= space.x && t <= march.span.y && notClipped(deformed);
  if (reached && inKeptTissue(deformed, rest))
  {
    vec4 tissue = tissueOf(scalarAt(rest));
    vec3 color = shadeAlone(march, colorOf(tissue, rest), deformed, rest);
    picture = vec4(color * tissue.a, tissue.a);
  }
  gl_FragData[0] = picture;
  gl_FragData[1] = hitAt(march, picture.a >= HitOpacity ? number : -1.0);
}
