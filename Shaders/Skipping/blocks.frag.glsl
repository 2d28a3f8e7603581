// Least and greatest offset in blocks of bricks. Most bricks are so far from what is visible, or so
// deep in it, that they need no closer look (presence.frag.glsl).

void main()
{
  vec3 block = targetTexel() - blockShift;
  vec3 low = (vec3(firstBrick) + block * float(BRICKS_IN_BLOCK)) * brickSide - margin;
  vec3 high = low + brickSide * float(BRICKS_IN_BLOCK) + 2.0 * margin;
  vec3 least;
  vec3 greatest;
  offsetRange(low, high, least, greatest);
  gl_FragData[0] = vec4(least, 0.0);
  gl_FragData[1] = vec4(greatest, 0.0);
}
