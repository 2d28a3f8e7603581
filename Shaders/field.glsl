// The backward map, in the volume's texture coordinates: one fetch and one addition.

#ifdef DEFORMED
uniform sampler3D offsets;          // restFromDeformed minus identity, the volume's texture units
uniform vec3 fieldFromTexture;      // the offset field's texture coordinates: scale ...
uniform vec3 fieldFromTextureShift; // ... and shift
uniform vec3 fieldTexel;            // step for derivatives: half a node, in its coordinates

vec3 offsetAt(vec3 fieldPosition)
{
  return textureLod(offsets, fieldPosition, 0.0).xyz;
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
vec3 restFromDeformed(vec3 deformed)
{
  return deformed;
}

vec3 deformedGradientFromRest(vec3 deformed, vec3 gradient)
{
  return gradient;
}
#endif
