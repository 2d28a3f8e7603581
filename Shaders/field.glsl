// The backward map, in the volume's texture coordinates: one fetch and one addition.

#ifdef DEFORMED
uniform sampler3D offsets;          // restFromDeformed minus identity, the volume's texture units
uniform vec3 fieldFromTexture;      // the offset field's texture coordinates: scale ...
uniform vec3 fieldFromTextureShift; // ... and shift
uniform vec3 fieldTexel;            // one texel of the offset field, in its coordinates

vec3 offsetAt(vec3 fieldPosition)
{
  return textureLod(offsets, fieldPosition, 0.0).xyz;
}

vec3 restFromDeformed(vec3 deformed)
{
  return deformed + offsetAt(deformed * fieldFromTexture + fieldFromTextureShift);
}

// Turns a gradient found in the rest frame into the deformed frame: times the transposed Jacobian
// of restFromDeformed, else light would not follow the bent surface.
vec3 deformedGradientFromRest(vec3 deformed, vec3 gradient)
{
  vec3 middle = deformed * fieldFromTexture + fieldFromTextureShift;
  vec3 alongX = offsetAt(middle + vec3(fieldTexel.x, 0.0, 0.0)) -
    offsetAt(middle - vec3(fieldTexel.x, 0.0, 0.0));
  vec3 alongY = offsetAt(middle + vec3(0.0, fieldTexel.y, 0.0)) -
    offsetAt(middle - vec3(0.0, fieldTexel.y, 0.0));
  vec3 alongZ = offsetAt(middle + vec3(0.0, 0.0, fieldTexel.z)) -
    offsetAt(middle - vec3(0.0, 0.0, fieldTexel.z));
  vec3 slope = vec3(dot(alongX, gradient), dot(alongY, gradient), dot(alongZ, gradient));
  return gradient + slope * fieldFromTexture / (2.0 * fieldTexel);
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
