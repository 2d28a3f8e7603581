// The backward map, in the volume's texture coordinates: one fetch and one addition.

#ifdef DEFORMED
uniform sampler3D offsets;          // restFromDeformed minus identity, the volume's texture units
uniform vec3 fieldFromTexture;      // the offset field's texture coordinates: scale ...
uniform vec3 fieldFromTextureShift; // ... and shift
uniform vec3 fieldTexel;            // step for derivatives: half a node, in its coordinates

uniform vec3 movedLow;              // where tissue may have moved, the volume's texture coordinates
uniform vec3 movedHigh;

vec3 offsetAt(vec3 fieldPosition)
{
  return textureLod(offsets, fieldPosition, 0.0).xyz;
}

// Samples, numbered from t = span.x, where tissue may have moved: first, and one past the last.
// Elsewhere the offset is zero and need not be fetched.
ivec2 movedSamples(Ray ray, vec2 span, float stepMm)
{
  vec2 moved = boxSpan(ray, movedLow, movedHigh);
  return moved.y < moved.x ? ivec2(0)
                           : ivec2(floor((moved.x - span.x) / stepMm) - 1.0,
                               ceil((moved.y - span.x) / stepMm) + 2.0);
}

vec3 restFromDeformed(vec3 deformed)
{
  return deformed + offsetAt(deformed * fieldFromTexture + fieldFromTextureShift);
}

// Turns a gradient found in the rest frame into the deformed frame: times the transposed Jacobian
// of restFromDeformed, else light would not follow the bent surface. The four corners of a
// tetrahedron give all derivatives, symmetric about the position.
vec3 deformedGradientFromRest(vec3 deformed, vec3 gradient)
{
  vec3 middle = deformed * fieldFromTexture + fieldFromTextureShift;
  vec3 a = offsetAt(middle + vec3(fieldTexel.x, -fieldTexel.y, -fieldTexel.z));
  vec3 b = offsetAt(middle + vec3(-fieldTexel.x, -fieldTexel.y, fieldTexel.z));
  vec3 c = offsetAt(middle + vec3(-fieldTexel.x, fieldTexel.y, -fieldTexel.z));
  vec3 d = offsetAt(middle + fieldTexel);
  vec3 slope = vec3(dot(a - b - c + d, gradient), dot(c + d - a - b, gradient),
    dot(b + d - a - c, gradient));
  return gradient + slope * fieldFromTexture / (4.0 * fieldTexel);
}
#else
ivec2 movedSamples(Ray ray, vec2 span, float stepMm)
{
  return ivec2(0);
}

vec3 restFromDeformed(vec3 deformed)
{
  return deformed;
}

vec3 deformedGradientFromRest(vec3 deformed, vec3 gradient)
{
  return gradient;
}
#endif
