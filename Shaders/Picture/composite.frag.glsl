// Gives the ray caster's image to blending, which lays it over the window.

uniform sampler2D image;       // colour times opacity, opacity
uniform vec2 origin;           // the picture's lower left pixel in the window
uniform vec2 textureFromPixel; // the image's coordinates from pixels of the picture: scale, shift
uniform vec2 textureOfOrigin;
#ifdef OCCLUDED
uniform sampler2D occlusion; // of the first hits, 0 to 1
uniform float darkness;      // fraction of the light that the greatest occlusion takes away
#endif

void main()
{
  vec2 place = (gl_FragCoord.xy - origin) * textureFromPixel + textureOfOrigin;
  vec4 color = textureLod(image, place, 0.0);
#ifdef OCCLUDED
  // Half opaque tissue has no surface yet.
  float surface = clamp(2.0 * color.a - 1.0, 0.0, 1.0);
  color.rgb *= 1.0 - darkness * surface * textureLod(occlusion, place, 0.0).r;
#endif
  gl_FragData[0] = color;
}
