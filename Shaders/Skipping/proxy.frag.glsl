// First and last fraction of a ray within occupied bricks (polygon assisted ray casting:
// Sobierajski and Avila, IEEE Visualization 1995). MIN blending keeps the least fraction in red and
// the least fraction of the ray behind a face in green. The image clamps both to 0 to 1.

in float fraction; // of the way from the near plane to the far plane

uniform float backDrawn; // 0: only front faces are drawn; a ray that meets one may go on

void main()
{
  gl_FragData[0] = vec4(fraction, backDrawn * (1.0 - fraction), 0.0, 0.0);
}
