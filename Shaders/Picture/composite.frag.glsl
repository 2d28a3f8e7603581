// Gives the ray caster's image to blending, which lays it over the window.

uniform sampler2D image;       // colour times opacity, opacity
uniform vec2 origin;           // the picture's lower left pixel in the window
uniform vec2 textureFromPixel; // the image's coordinates from pixels of the picture: scale, shift
uniform vec2 textureOfOrigin;

void main()
{
  vec2 place = (gl_FragCoord.xy - origin) * textureFromPixel + textureOfOrigin;
  gl_FragData[0] = textureLod(image, place, 0.0);
}
