// First and last share of a ray within occupied bricks, through MIN blending: red keeps the least
// share, green the least of minus the share.

in float share; // of the way from the near plane to the far plane

void main()
{
  gl_FragData[0] = vec4(share, -share, 0.0, 0.0);
}
