// The backward map, in the volume's texture coordinates: one fetch and one addition.

#ifdef DEFORMED
uniform sampler3D offsets;          // restFromDeformed minus identity, the volume's texture units
uniform vec3 fieldFromTexture;      // the offset field's texture coordinates: scale ...
uniform vec3 fieldFromTextureShift; // ... and shift
uniform vec3 fieldTexel;            // step for derivatives: half a node, in its coordinates

uniform int moves;                         // 0: nothing does
uniform vec3 movedNormals[SLAB_DIRECTIONS]; // where tissue may have moved: dot(normal, deformed)
uniform vec2 movedSpans[SLAB_DIRECTIONS];   // lies in all these spans

vec3 offsetAt(vec3 fieldPosition)
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
  vec3 a = offsetAt(middle + vec3(fieldTexel.x, -fieldTexel.y, -fieldTexel.z));
  vec3 b = offsetAt(middle + vec3(-fieldTexel.x, -fieldTexel.y, fieldTexel.z));
  vec3 c = offsetAt(middle + vec3(-fieldTexel.x, fieldTexel.y, -fieldTexel.z));
  vec3 d = offsetAt(middle + fieldTexel);
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

// Turns a gradient found in the rest frame into the deformed frame: times the transposed Jacobian
// of restFromDeformed, else light would not follow the bent surface.
vec3 deformedGradientFromRest(mat3 slopes, vec3 gradient)
{
  return gradient + gradient * slopes;
}
