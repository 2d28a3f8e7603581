// First and last share of a ray within occupied bricks. MIN blending keeps the least share in red
// and the least share of the ray behind a face in green. The image clamps both to 0 to 1.

in float share; // of the way from the near plane to the far plane

uniform float backDrawn; // 0: only front faces are drawn; a ray that meets one may go on

void main()
{
  gl_FragData[0] = vec4(share, backDrawn * (1.0 - share), 0.0, 0.0);
}
