// First and last t of a ray within occupied bricks, through MIN blending: red keeps the least t,
// green the least of minus t.

in vec3 surface;

uniform vec2 pixelSize; // of one pixel, ndc

void main()
{
  Ray ray = rayOfPixel(gl_FragCoord.xy * pixelSize - 1.0);
  vec3 along = mmFromTexture * (surface - ray.start);
  float t = dot(along, normalize(mmFromTexture * ray.direction));
  gl_FragData[0] = vec4(t, -t, 0.0, 0.0);
}
