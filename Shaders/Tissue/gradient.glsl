// A gradient of zero as a texture holds it: whole numbers of ten bits, so that it is exact.
const float ZeroGradient = 512.0 / 1023.0;

bvec3 areFinite(vec3 scalars)
{
  return not(bvec3(uvec3(isnan(scalars)) | uvec3(isinf(scalars))));
}

// Gradient of the scalar per texture unit: central differences over one voxel to either side.
// Beside values that are no numbers, differences to the known side only.
vec3 centralDifferences(sampler3D field, vec3 position, vec3 voxel)
{
  vec3 alongX = vec3(voxel.x, 0.0, 0.0);
  vec3 alongY = vec3(0.0, voxel.y, 0.0);
  vec3 alongZ = vec3(0.0, 0.0, voxel.z);
  vec3 low = vec3(textureLod(field, position - alongX, 0.0).r,
    textureLod(field, position - alongY, 0.0).r, textureLod(field, position - alongZ, 0.0).r);
  vec3 high = vec3(textureLod(field, position + alongX, 0.0).r,
    textureLod(field, position + alongY, 0.0).r, textureLod(field, position + alongZ, 0.0).r);
  bvec3 knowsLow = areFinite(low);
  bvec3 knowsHigh = areFinite(high);
  if (all(knowsLow) && all(knowsHigh))
  {
    return (high - low) / (2.0 * voxel);
  }
  vec3 here = vec3(textureLod(field, position, 0.0).r);
  vec3 sides = max(vec3(knowsLow) + vec3(knowsHigh), 1.0);
  return (mix(here, high, knowsHigh) - mix(here, low, knowsLow)) / (sides * voxel);
}
