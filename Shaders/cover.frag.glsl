// What is seen is what is selected: where the last picture showed tissue, nothing behind it is.

in vec2 ndc;

uniform sampler2D hits;     // first hit, mm (world); distance from the near plane, mm; below 0: none
uniform mat4 clipFromWorld; // of the camera

void main()
{
  vec4 hit = textureLod(hits, 0.5 * ndc + 0.5, 0.0);
  if (hit.w < 0.0)
  {
    discard;
  }
  vec4 clip = clipFromWorld * vec4(hit.xyz, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
  gl_FragData[0] = vec4(0.0); // to a selection, the background
}
