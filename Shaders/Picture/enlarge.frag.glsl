// A part of a picture from another picture, which may be smaller. Colours are blended, hits are
// not.

in vec2 ndc; // of the picture

uniform sampler2D image; // of the other picture: colour times opacity, opacity
uniform sampler2D hits;
// their coordinates from the fraction of the picture: scale, shift
uniform vec2 textureFromFraction;
uniform vec2 textureOfFractionZero;

void main()
{
  vec2 place = (0.5 * ndc + 0.5) * textureFromFraction + textureOfFractionZero;
  gl_FragData[0] = textureLod(image, place, 0.0);
  gl_FragData[1] = textureLod(hits, place, 0.0);
}
