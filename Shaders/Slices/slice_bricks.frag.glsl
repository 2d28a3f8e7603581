// Which brick of a finer level a slice reads at a pixel: red is its number if it is not there,
// green if it is. Else -1.

in vec3 deformed; // texture coordinates

void main()
{
  vec3 rest = restFromDeformed(deformed);
  if (!insideVolume(rest))
  {
    discard;
  }
  vec3 fine = fineAt(rest);
  vec3 brick = brickOf(fine);
  vec4 page = pageOf(brick);
  bool isThere = page.a >= 0.5;
  if (isThere && !isNumber(textureLod(atlas, positionInAtlas(page, fine, brick), 0.0).r))
  {
    discard; // what is behind is seen
  }
  float number = numberOf(brick);
  gl_FragData[0] = isThere ? vec4(-1.0, number, 0.0, 0.0) : vec4(number, -1.0, 0.0, 0.0);
}
