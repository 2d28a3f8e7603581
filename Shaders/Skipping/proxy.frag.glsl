// First and last share of a ray within occupied bricks, through MIN blending: red keeps the least
// share, green the least of what is left of the ray behind a face. The image cuts both at 0 and 1.

in float share; // of the way from the near plane to the far plane

uniform float backDrawn; // 0: front faces alone are drawn; a ray that meets one may go on

void main()
{
  gl_FragData[0] = vec4(share, backDrawn * (1.0 - share), 0.0, 0.0);
}
