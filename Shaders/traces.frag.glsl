// A traced point's ball: what of it lies behind the tissue that volumes show is faded. Beside other
// balls and surfaces it is a disc, so that a fragment's depth is known before it is computed.

flat in vec4 ballColor;
flat in float ballDepth;
flat in float ballRadius;

uniform vec3 ahead;          // unit vector the way the camera looks, world axes
uniform float hiddenOpacity; // of what lies behind tissue, as a share
uniform vec2 origin;         // the picture's lower left pixel in the window
uniform vec2 shareOfPixel;   // of the picture's sides

const float RimShade = 0.45; // brightness where the ball turns away from the eye

bool isBehind(sampler2D hits, vec2 share, float depth)
{
  vec4 hit = textureLod(hits, share, 0.0); // first hit, mm (world); below 0: none
  return hit.w >= 0.0 && dot(ahead, hit.xyz) < depth;
}

#if TISSUES > 0
uniform sampler2D hits0;
#endif
#if TISSUES > 1
uniform sampler2D hits1;
#endif
#if TISSUES > 2
uniform sampler2D hits2;
#endif
#if TISSUES > 3
uniform sampler2D hits3;
#endif

bool isHidden(vec2 share, float depth)
{
  bool hidden = false;
#if TISSUES > 0
  hidden = isBehind(hits0, share, depth);
#endif
#if TISSUES > 1
  hidden = hidden || isBehind(hits1, share, depth);
#endif
#if TISSUES > 2
  hidden = hidden || isBehind(hits2, share, depth);
#endif
#if TISSUES > 3
  hidden = hidden || isBehind(hits3, share, depth);
#endif
  return hidden;
}

void main()
{
  vec2 aside = 2.0 * gl_PointCoord - 1.0;
  float rise = 1.0 - dot(aside, aside);
  if (rise < 0.0)
  {
    discard;
  }
  rise = sqrt(rise);
  vec2 share = (gl_FragCoord.xy - origin) * shareOfPixel;
  bool hidden = isHidden(share, ballDepth - rise * ballRadius);
  float opacity = ballColor.a * (hidden ? hiddenOpacity : 1.0);
  if (opacity <= 0.0)
  {
    discard;
  }
  gl_FragData[0] = vec4(ballColor.rgb * (mix(RimShade, 1.0, rise) * opacity), opacity);
}
