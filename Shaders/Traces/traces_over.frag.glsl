// Gives the nearest faded balls to blending, which lays them over the window.

in vec2 ndc;

uniform sampler2D balls;  // colour times opacity, opacity
uniform sampler2D depths; // of the window; 1: no ball

void main()
{
  vec2 fraction = 0.5 * ndc + 0.5;
  float depth = textureLod(depths, fraction, 0.0).r;
  if (depth >= 1.0)
  {
    discard;
  }
  gl_FragDepth = depth;
  gl_FragData[0] = textureLod(balls, fraction, 0.0);
}
