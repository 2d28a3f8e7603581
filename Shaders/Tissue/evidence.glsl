// Uncertainty of the position of tissue in four classes: one standard deviation at its rest
// position.

#ifdef EVIDENCE
uniform sampler3D deviations;           // red: one standard deviation, mm, at each control point
uniform vec3 deviationFromTexture;      // its texture coordinates from the volume's: scale
uniform vec3 deviationFromTextureShift; // and shift
uniform vec3 evidenceLimits;            // mm: where the classes 1, 2 and 3 begin
uniform mat3 evidenceTints;             // a column for each of these classes
uniform vec3 stripesFromTexture;        // stripes for a texture unit
uniform float stripesOfTextureZero;     // and where the texture begins

const vec3 EvidenceLuminance = vec3(0.2126, 0.7152, 0.0722);
const float TintFraction = 0.45;
const float TintOfBlack = 0.08; // of a tint's light, where tissue is black: air stays dark
const float UnknownLight = 0.55;
const float UnknownStripe = 0.3; // of the width
const float BrightStripe = 0.25; // light of tissue from which a stripe has its whole colour
const vec4 ComparedStripes = vec4(0.0, 0.12, 0.35, 0.65); // of the width, for each class
const float ComparedLight = 0.3;

// 0: the position is certain; 3: it is unknown.
int evidenceClassAt(vec3 rest)
{
  vec3 place = rest * deviationFromTexture + deviationFromTextureShift;
  float mm = textureLod(deviations, place, 0.0).r;
  return int(mm >= evidenceLimits.x) + int(mm >= evidenceLimits.y) + int(mm >= evidenceLimits.z);
}

bool onStripe(vec3 rest, float width)
{
  return fract(dot(rest, stripesFromTexture) + stripesOfTextureZero) < width;
}

// A tissue's colour with the tint of its class; its lightness stays to be seen.
vec3 evident(vec3 color, vec3 rest)
{
  int known = evidenceClassAt(rest);
  if (known == 0)
  {
    return color;
  }
  float light = dot(color, EvidenceLuminance);
  vec3 tint = evidenceTints[known - 1];
  if (known == 3)
  {
    vec3 dark = vec3(UnknownLight * light);
    float whole = mix(TintOfBlack, 1.0, min(light / BrightStripe, 1.0));
    return onStripe(rest, UnknownStripe) ? mix(dark, whole * tint, TintFraction) : dark;
  }
  return mix(color, tint * mix(TintOfBlack, 1.0 / max(dot(tint, EvidenceLuminance), 0.01), light),
    TintFraction);
}

// The same where colours distinguish volumes: stripes, wider for greater uncertainty.
vec3 evidentStripes(vec3 color, vec3 rest)
{
  return onStripe(rest, ComparedStripes[evidenceClassAt(rest)]) ? ComparedLight * color : color;
}
#else
vec3 evident(vec3 color, vec3 rest)
{
  return color;
}

vec3 evidentStripes(vec3 color, vec3 rest)
{
  return color;
}
#endif
