// A traced point as a ball: where its middle is seen, how large it is, and whether tissue hides it.
// A ball that touches the tissue is not hidden, so that a trace on the cortex is no patchwork.

in vec3 position; // the points' own coordinates, mm
in vec4 color;    // not multiplied by opacity

uniform mat4 worldFromPoint;
uniform mat4 clipFromWorld;
uniform vec3 ahead;          // unit vector the way the camera looks, world axes
uniform float radius;        // mm
uniform float leastRadius;   // pixels
uniform float pixelsForMm;   // where the homogeneous w is 1
uniform float hiddenOpacity; // fraction of the opacity that points behind tissue keep
uniform vec2 origin;         // the picture's lower left pixel in the window
uniform vec2 size;           // of the picture, pixels

flat out vec4 ballColor; // multiplied by opacity
flat out vec3 ballPlace; // middle in the window, pixels; fraction of the radius for a pixel

#if TISSUES > 0
// Of each volume's picture: mm ahead on the near and on the far plane, from (1, ndc).
uniform vec3 nearAhead[TISSUES];
uniform vec3 farAhead[TISSUES];
// Texture coordinates of its first hits from the fraction of the picture: scale and shift.
uniform vec2 hitsFromFraction[TISSUES];
uniform vec2 hitsOfFractionZero[TISSUES];

// Whether a first hit (fraction from near to far plane; below 0: none) is nearer than `depth`.
bool isBehind(int tissue, sampler2D hits, vec2 fraction, float depth)
{
  vec2 place = fraction * hitsFromFraction[tissue] + hitsOfFractionZero[tissue];
  float hit = textureLod(hits, place, 0.0).r;
  vec3 onPlane = vec3(1.0, 2.0 * fraction - 1.0);
  float hitDepth = mix(dot(nearAhead[tissue], onPlane), dot(farAhead[tissue], onPlane), hit);
  return hit >= 0.0 && hitDepth < depth;
}

uniform sampler2D hits0; // first hits of each volume
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

// `fraction`: of the picture; `depth`: mm ahead.
bool isHidden(vec2 fraction, float depth)
{
  bool hidden = false;
#if TISSUES > 0
  hidden = isBehind(0, hits0, fraction, depth);
#endif
#if TISSUES > 1
  hidden = hidden || isBehind(1, hits1, fraction, depth);
#endif
#if TISSUES > 2
  hidden = hidden || isBehind(2, hits2, fraction, depth);
#endif
#if TISSUES > 3
  hidden = hidden || isBehind(3, hits3, fraction, depth);
#endif
  return hidden;
}

void main()
{
  vec4 world = worldFromPoint * vec4(position, 1.0);
  vec4 clip = clipFromWorld * world;
  float scale = pixelsForMm / clip.w;
  float pixels = max(radius * scale, leastRadius);
  vec2 fraction = 0.5 * clip.xy / clip.w + 0.5;
  bool hidden = isHidden(fraction, dot(ahead, world.xyz) - pixels / scale);
  float opacity = color.a * (hidden ? hiddenOpacity : 1.0);
  ballColor = vec4(color.rgb * opacity, opacity);
  ballPlace = vec3(origin + fraction * size, 1.0 / pixels);
  gl_PointSize = 2.0 * pixels;
  gl_Position = opacity > 0.0 ? clip : vec4(0.0, 0.0, -2.0, 1.0); // beyond the near plane
}
