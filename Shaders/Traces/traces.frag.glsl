// The ball of a traced point. For its depth among other balls and surfaces it is a disc.

flat in vec4 ballColor;
flat in vec3 ballPlace;

const float RimShade = 0.5; // brightness where the ball turns away from the eye

void main()
{
  // gl_PointCoord would say it, too, but software drivers would take a quarter longer.
  vec2 aside = (gl_FragCoord.xy - ballPlace.xy) * ballPlace.z;
  float rim = dot(aside, aside);
  if (rim > 1.0)
  {
    discard;
  }
  gl_FragData[0] = vec4(ballColor.rgb * mix(1.0, RimShade, rim), ballColor.a);
}
