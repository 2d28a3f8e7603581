// The backward map, in the volume's texture coordinates: one fetch and one addition. Where
// the field bends much there are corrections of it (Representations/Field/FineCells.h).

#ifdef DEFORMED
// restFromDeformed minus identity, the volume's texture units. The fourth number is above 0 around
// cells with corrections.
uniform sampler3D offsets;
uniform float correctedAbove;       // 0; a huge number if there are no corrections
uniform sampler3D correctionCodes;  // of each cell of nodes: FineCells::code; unfiltered
uniform sampler3D corrections;      // lattice cells
uniform vec3 fieldNodes;            // of the offset field, a side
uniform vec3 correctionTexel;       // one texel of corrections
uniform vec3 textureFromLattice;    // the volume's texture units for one lattice cell
uniform vec3 fieldFromTexture;      // the offset field's texture coordinates: scale ...
uniform vec3 fieldFromTextureShift; // ... and shift
uniform vec3 fieldTexel;            // step for derivatives: half a node, in its coordinates

uniform int moves;                         // 0: nothing does
uniform vec3 movedNormals[SLAB_DIRECTIONS]; // where tissue may have moved: dot(normal, deformed)
uniform vec2 movedSpans[SLAB_DIRECTIONS];   // lies in all these spans

vec3 correctionAt(vec3 fieldPosition)
{
  vec3 node = fieldPosition * fieldNodes - 0.5;
  vec3 cell = clamp(floor(node), vec3(0.0), fieldNodes - 2.0);
  float code = textureLod(correctionCodes, (cell + 0.5) / fieldNodes, 0.0).r;
  if (code == 0.0)
  {
    return vec3(0.0);
  }
  float slot = floor(code / CODE_OF_SLOT);
  float side = code - CODE_OF_SLOT * slot; // slots a side
  vec3 place = clamp(node - cell, 0.0, 1.0) * side;
  vec3 within = min(floor(place), side - 1.0);
  slot += within.x + side * (within.y + side * within.z);
  float row = floor(slot / SLOTS_IN_ROW);
  float layer = floor(row / ROWS_IN_LAYER);
  vec3 corner = vec3(slot - SLOTS_IN_ROW * row, row - ROWS_IN_LAYER * layer, layer);
  vec3 texel = SLOT_SIDE * corner + 0.5 + (SLOT_SIDE - 1.0) * (place - within);
  return textureLod(corrections, texel * correctionTexel, 0.0).xyz * textureFromLattice;
}

vec3 offsetAt(vec3 fieldPosition)
{
  vec4 offset = textureLod(offsets, fieldPosition, 0.0);
  return offset.w > correctedAbove ? offset.xyz + correctionAt(fieldPosition) : offset.xyz;
}

// Light needs slopes over half a node, which corrections hardly change.
vec3 uncorrectedOffsetAt(vec3 fieldPosition)
{
  return textureLod(offsets, fieldPosition, 0.0).xyz;
}

// A ray in the field's texture coordinates.
Track fieldTrack(Track deformed)
{
  return Track(deformed.first * fieldFromTexture + fieldFromTextureShift,
    deformed.stride * fieldFromTexture);
}

// Samples, numbered from t = span.x, where tissue may have moved: first, and one past the last.
// Elsewhere the offset is zero and need not be fetched.
vec2 movedSamples(Ray ray, vec2 span, float stepMm)
{
  vec2 moved = span;
  for (int i = 0; i < SLAB_DIRECTIONS; ++i)
  {
    float slope = dot(movedNormals[i], ray.direction);
    slope = abs(slope) < 1e-12 ? 1e-12 : slope;
    vec2 t = (movedSpans[i] - dot(movedNormals[i], ray.start)) / slope;
    moved = vec2(max(moved.x, min(t.x, t.y)), min(moved.y, max(t.x, t.y)));
  }
  return moves == 0 || moved.y < moved.x ? vec2(0.0)
                                         : vec2(floor((moved.x - span.x) / stepMm) - 1.0,
                                             ceil((moved.y - span.x) / stepMm) + 2.0);
}

vec3 restFromDeformed(vec3 deformed)
{
  return deformed + offsetAt(deformed * fieldFromTexture + fieldFromTextureShift);
}

// Derivatives of the offsets, columns along the axes, at a position in the field's texture
// coordinates; from the four corners of a tetrahedron: symmetric, and each corner serves all three.
mat3 offsetSlopes(vec3 middle)
{
  vec3 a = uncorrectedOffsetAt(middle + vec3(fieldTexel.x, -fieldTexel.y, -fieldTexel.z));
  vec3 b = uncorrectedOffsetAt(middle + vec3(-fieldTexel.x, -fieldTexel.y, fieldTexel.z));
  vec3 c = uncorrectedOffsetAt(middle + vec3(-fieldTexel.x, fieldTexel.y, -fieldTexel.z));
  vec3 d = uncorrectedOffsetAt(middle + fieldTexel);
  vec3 scale = fieldFromTexture / (4.0 * fieldTexel);
  return mat3((a - b - c + d) * scale.x, (c + d - a - b) * scale.y, (b + d - a - c) * scale.z);
}

mat3 offsetSlopesAt(vec3 deformed)
{
  return offsetSlopes(deformed * fieldFromTexture + fieldFromTextureShift);
}
#else
vec2 movedSamples(Ray ray, vec2 span, float stepMm)
{
  return vec2(0.0);
}

Track fieldTrack(Track deformed)
{
  return deformed;
}

vec3 offsetAt(vec3 fieldPosition)
{
  return vec3(0.0);
}

vec3 restFromDeformed(vec3 deformed)
{
  return deformed;
}

mat3 offsetSlopes(vec3 middle)
{
  return mat3(0.0);
}

mat3 offsetSlopesAt(vec3 deformed)
{
  return mat3(0.0);
}
#endif

// Whether tissue may have moved at the sample `number` or the next one. `moved`: movedSamples. An
// offset of zero does not tell: where it changes its sign, its slopes are not zero.
bool mayMove(vec2 moved, float number)
{
  return number + 1.0 >= moved.x && number < moved.y;
}

// Turns a gradient found in the rest frame into the deformed frame: times the transposed Jacobian
// of restFromDeformed, else light would not follow the bent surface.
vec3 deformedGradientFromRest(mat3 slopes, vec3 gradient)
{
  return gradient + gradient * slopes;
}
