// Nothing behind the tissue of the last picture is selected: only what is seen can be.

in vec2 ndc;

uniform sampler2D hits; // first hit, fraction of the way from near to far plane; below 0: none
// their texture coordinates from the fraction of the picture: scale, shift
uniform vec2 hitsFromFraction;
uniform vec2 hitsOfFractionZero;
uniform mat3 nearPlane; // of the picture: mm, world, from (1, ndc)
uniform mat3 farPlane;
uniform mat4 clipFromWorld; // of the camera

void main()
{
  float hit = textureLod(hits, (0.5 * ndc + 0.5) * hitsFromFraction + hitsOfFractionZero, 0.0).r;
  if (hit < 0.0)
  {
    discard;
  }
  vec3 place = vec3(1.0, ndc);
  vec4 clip = clipFromWorld * vec4(mix(nearPlane * place, farPlane * place, hit), 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
  gl_FragData[0] = vec4(0.0); // the background of a selection
}
