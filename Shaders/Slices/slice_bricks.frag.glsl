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
  holdBrickOf(fine);
  if (heldIsThere && !isNumber(textureLod(atlas, positionInAtlas(fine), 0.0).r))
  {
    discard; // what is behind is seen
  }
  float number = numberOf(brickOf(fine));
  gl_FragData[0] = heldIsThere ? vec4(-1.0, number, 0.0, 0.0) : vec4(number, -1.0, 0.0, 0.0);
}
