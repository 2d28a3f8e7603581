// Lays the ray caster's image over the scene; blending does the rest.

in vec2 ndc;

uniform sampler2D image; // colour times opacity, opacity

void main()
{
  gl_FragData[0] = textureLod(image, 0.5 * ndc + 0.5, 0.0);
}
