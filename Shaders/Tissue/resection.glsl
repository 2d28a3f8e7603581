// What a resection removed, and the tumour that it was for.

#ifdef REMOVED
uniform sampler3D removed;       // red: how much of a place was removed; 0.5: the wall
uniform mat4 removedFromTexture; // its texture coordinates from the volume's
uniform vec3 removedTexel;       // one of its voxels, its texture coordinates

const vec2 WallFractions = vec2(0.02, 0.25); // between them light turns into the wall's

vec3 removedPlace(vec3 deformed)
{
  return (removedFromTexture * vec4(deformed, 1.0)).xyz;
}

float removedFractionAt(vec3 place)
{
  return textureLod(removed, place, 0.0).r;
}

// Factor on opacity: 0 in the cavity, 1 beyond it. It rises across the wall, so that the wall shows
// no steps.
float remainingAt(vec3 deformed)
{
  float fraction = removedFractionAt(removedPlace(deformed));
  return clamp((1.0 - LEAST_FRACTION - fraction) / (1.0 - 2.0 * LEAST_FRACTION), 0.0, 1.0);
}

bool remains(vec3 deformed)
{
  return removedFractionAt(removedPlace(deformed)) < 0.5;
}

// A gradient for light, world axes. At the wall the tissue's own gradient has nothing to do with
// the surface that is seen, so light uses that of the wall there. `turn`: worldFromGradient.
vec3 atWall(vec3 gradient, vec3 deformed, mat3 turn)
{
  vec3 place = removedPlace(deformed);
  float whole = smoothstep(WallFractions.x, WallFractions.y, removedFractionAt(place));
  if (whole == 0.0)
  {
    return gradient;
  }
  // From the four corners of a tetrahedron, a voxel away on each axis.
  vec3 step = removedTexel;
  float a = removedFractionAt(place + vec3(step.x, -step.y, -step.z));
  float b = removedFractionAt(place + vec3(-step.x, -step.y, step.z));
  float c = removedFractionAt(place + vec3(-step.x, step.y, -step.z));
  float d = removedFractionAt(place + step);
  vec3 slope = vec3(a - b - c + d, c + d - a - b, b + d - a - c) / step;
  vec3 wall = -(turn * (transpose(mat3(removedFromTexture)) * slope)); // into the tissue
  return mix(gradient / max(length(gradient), 1e-30), wall / max(length(wall), 1e-30), whole);
}
#else
float remainingAt(vec3 deformed)
{
  return 1.0;
}

bool remains(vec3 deformed)
{
  return true;
}

vec3 atWall(vec3 gradient, vec3 deformed, mat3 turn)
{
  return gradient;
}
#endif

#ifdef TUMOUR
uniform sampler3D tumour;       // red: how much of a place at rest is tumour; 0.5: the edge
uniform mat4 tumourFromTexture; // its texture coordinates from the volume's
uniform vec3 leftTint;          // of tumour that is left
uniform vec3 removedTint;       // of tumour that was removed

const vec3 MarkLuminance = vec3(0.2126, 0.7152, 0.0722);
const float MarkFraction = 0.75; // of a tint in the colour; the rest is the tissue's own
const float MarkOfBlack = 0.3;   // of a tint's light, where tissue is black

// How much of a place at rest is marked as tumour: sharp, but without steps.
float tumourAt(vec3 rest)
{
  vec3 place = (tumourFromTexture * vec4(rest, 1.0)).xyz;
  return smoothstep(0.4, 0.6, textureLod(tumour, place, 0.0).r);
}

// A colour in a tint; its lightness stays to be seen.
vec3 tinted(vec3 color, vec3 tint, float fraction)
{
  float light = mix(MarkOfBlack, 1.0, dot(color, MarkLuminance));
  return mix(color, light * tint, MarkFraction * fraction);
}

// The colour of tissue in 3D, where removed tissue is not drawn: tumour that is left has its tint.
vec3 marked(vec3 color, vec3 rest)
{
  float fraction = tumourAt(rest);
  return fraction > 0.0 ? tinted(color, leftTint, fraction) : color;
}
#else
vec3 marked(vec3 color, vec3 rest)
{
  return color;
}
#endif

const float RemovedLight = 0.25; // of removed tissue in slices

// The colour of tissue in slices: removed tissue is dark, and removed tumour has a tint of its own.
vec3 markedInSlice(vec3 color, vec3 deformed, vec3 rest)
{
  float remaining = remainingAt(deformed);
  vec3 gone = RemovedLight * color;
#ifdef TUMOUR
  gone = tinted(gone, removedTint, tumourAt(rest));
#endif
  return mix(gone, marked(color, rest), remaining);
}
