// A reference volume beside the bent one, in one picture. The reference is not bent: it is read at
// the place of the fragment, and not at the rest position.

struct Place
{
  vec3 deformed;
  vec3 rest;
};

#ifdef COMPARED
uniform sampler3D reference;       // red: the scalar, as stored
uniform mat4 referenceFromTexture; // its texture coordinates from the volume's
uniform vec3 referenceVoxels;      // voxels of the reference, a side
uniform int referenceCubic;        // 1: cubic filter of it; else the texture's own
uniform vec3 referenceLow;         // its box, in its texture coordinates
uniform vec3 referenceHigh;
// stored scalar to its fraction of the range of greys: scale, shift
uniform vec2 fractionFromReference;
uniform vec2 fractionFromScalar;   // the volume's stored scalar to that fraction: scale, shift
uniform vec2 transferFromFraction; // fraction to the colour map's coordinate: scale, shift
uniform int comparison;           // as vtkDeformedSlicesMapper numbers them; 0: the reference alone
uniform vec3 checkersFromTexture; // checker fields for a texture unit
uniform vec3 fullFromGradient;    // stored scalar per texture unit to fraction of its full colour
uniform vec3 ownColor;            // of the volume
uniform vec3 referenceColor;      // of the reference; both add up to that of agreement
uniform vec3 wipeNormal;          // mm beyond the wipe's line, on the reference's side of it
uniform float wipeShift;

const int ReferenceAlone = 0;
const int TwoColors = 1;
const int Checkerboard = 2;
const int Difference = 3;
const int Gradient = 4;
const int Wipe = 5;
const int LocalSimilarity = 6;
const float DisagreementTint = 0.7; // of its colour at most: tissue stays to be seen
const float AloneBrightness = 0.5;  // of grey tissue where there is no reference
const vec3 WipeColor = vec3(0.91, 0.51, 0.12);
const float HalfLinePixels = 0.75;

// The reference at a position in its texture: fraction of the range of greys; 0 where unknown.
struct Referenced
{
  vec3 place;
  bool known;
  float fraction;
};

float disagreementAt(vec3 deformed); // similarity.glsl

float ownFraction(float scalar)
{
  return clamp(scalar * fractionFromScalar.x + fractionFromScalar.y, 0.0, 1.0);
}

Referenced referenced(vec3 place, float scalar)
{
  bool known = all(greaterThanEqual(place, referenceLow)) &&
    all(lessThanEqual(place, referenceHigh)) && isNumber(scalar);
  float fraction = clamp(scalar * fractionFromReference.x + fractionFromReference.y, 0.0, 1.0);
  return Referenced(place, known, known ? fraction : 0.0);
}

Referenced referenceAt(vec3 deformed)
{
  vec3 place = (referenceFromTexture * vec4(deformed, 1.0)).xyz;
  return referenced(place, filteredAt(reference, place, referenceVoxels, referenceCubic));
}

bool inEvenField(vec3 deformed)
{
  ivec3 field = ivec3(floor(deformed * checkersFromTexture));
  return ((field.x + field.y + field.z) & 1) == 0;
}

// How much of its colour the reference's gradient has.
float gradientFraction(Referenced other)
{
  vec3 gradient = centralDifferences(reference, other.place, 1.0 / referenceVoxels);
  float full = length(gradient * fullFromGradient);
  return other.known && isNumber(full) ? min(full, 1.0) : 0.0;
}

// Both volumes in one colour. The cavity does not count and is grey. `color`: of the volume, from
// its colour map. `own`: the volume's fraction of the range of greys.
vec3 compared(vec3 color, float own, Referenced other, vec3 alone, Place place)
{
  vec3 deformed = place.deformed;
  switch (comparison)
  {
    case TwoColors:
      return evidentStripes(
        isRemoved(deformed) ? vec3(own) : own * ownColor + other.fraction * referenceColor,
        place.rest);
    case Checkerboard:
      return other.known && !inEvenField(deformed) ? alone : evident(color, place.rest);
    case Difference:
      return evidentStripes(
        vec3(other.known && !isRemoved(deformed) ? 0.5 + 0.5 * (own - other.fraction) : 0.5),
        place.rest);
    case Gradient:
      return evidentStripes(
        mix(vec3(own), referenceColor, isRemoved(deformed) ? 0.0 : gradientFraction(other)),
        place.rest);
    case LocalSimilarity:
      return evidentStripes(
        mix(vec3(other.known ? own : AloneBrightness * own), ownColor,
          isRemoved(deformed) || !other.known ? 0.0 : DisagreementTint * disagreementAt(deformed)),
        place.rest);
    default:
      return evident(color, place.rest);
  }
}

// What is seen of the colour and opacity of tissue and reference. Returns false if nothing is.
bool compare(bool hasTissue, float scalar, Place place, inout vec4 seen)
{
  vec3 deformed = place.deformed;
  Referenced other = referenceAt(deformed);
  float entry = other.fraction * transferFromFraction.x + transferFromFraction.y;
  vec4 alone = textureLod(transfer, vec2(entry, transferRow), 0.0);
  float own = ownFraction(scalar);
  float beyondMm = dot(wipeNormal, deformed) + wipeShift;
  float pixelMm = fwidth(beyondMm);
  bool hasEither = hasTissue || other.known;
  if (comparison == ReferenceAlone || (comparison == Wipe && beyondMm > 0.0))
  {
    seen = alone;
    hasTissue = other.known;
  }
  else if (hasTissue)
  {
    seen.rgb = compared(seen.rgb, own, other, alone.rgb, place);
  }
  if (comparison == Wipe && abs(beyondMm) < HalfLinePixels * screenScale * pixelMm)
  {
    seen.rgb = WipeColor;
    hasTissue = hasEither; // whichever side the middle of the pixel is on
  }
  return hasTissue;
}
#else
bool compare(bool hasTissue, float scalar, Place place, inout vec4 seen)
{
  seen.rgb = evident(seen.rgb, place.rest);
  return hasTissue;
}
#endif
