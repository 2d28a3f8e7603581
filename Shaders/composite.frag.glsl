// Lays the ray caster's image over the scene; blending does the rest.

uniform sampler2D image;    // colour times opacity, opacity
uniform vec2 origin;        // the image's lower left pixel in the window
uniform vec2 shareOfPixel;  // of the image's sides

void main()
{
  gl_FragData[0] = textureLod(image, (gl_FragCoord.xy - origin) * shareOfPixel, 0.0);
}
