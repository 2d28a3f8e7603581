// A gradient of zero as a texture holds it: whole numbers of ten bits, so that it is exact.
const float ZeroGradient = 512.0 / 1023.0;

const float LargestNumber = 3.402823466e+38;

// Neither NaN nor infinite. Drivers filter and map an infinite scalar in different ways, so both
// count as unknown.
bool isNumber(float scalar)
{
  return abs(scalar) <= LargestNumber;
}

bvec3 areNumbers(vec3 scalars)
{
  return lessThanEqual(abs(scalars), vec3(LargestNumber));
}

// Gradient of the scalar per texture unit, from scalars one voxel to either side. Beside values
// that are no numbers, differences to the known side only. Where the position itself has none, the
// mean of the known sides takes its place.
vec3 differences(vec3 low, vec3 high, float scalar, vec3 voxel)
{
  bvec3 knowsLow = areNumbers(low);
  bvec3 knowsHigh = areNumbers(high);
  if (all(knowsLow) && all(knowsHigh))
  {
    return (high - low) / (2.0 * voxel);
  }
  vec3 sides = vec3(knowsLow) + vec3(knowsHigh);
  float known = dot(sides, vec3(1.0));
  if (known == 0.0)
  {
    return vec3(0.0);
  }
  vec3 sums = mix(vec3(0.0), low, knowsLow) + mix(vec3(0.0), high, knowsHigh);
  vec3 here = vec3(isNumber(scalar) ? scalar : dot(sums, vec3(1.0)) / known);
  return (mix(here, high, knowsHigh) - mix(here, low, knowsLow)) / (max(sides, 1.0) * voxel);
}

// `texel`: a voxel in the texture; `voxel`: the same in what the gradient is of.
vec3 centralDifferences(sampler3D field, vec3 position, vec3 texel, vec3 voxel)
{
  vec3 alongX = vec3(texel.x, 0.0, 0.0);
  vec3 alongY = vec3(0.0, texel.y, 0.0);
  vec3 alongZ = vec3(0.0, 0.0, texel.z);
  vec3 low = vec3(textureLod(field, position - alongX, 0.0).r,
    textureLod(field, position - alongY, 0.0).r, textureLod(field, position - alongZ, 0.0).r);
  vec3 high = vec3(textureLod(field, position + alongX, 0.0).r,
    textureLod(field, position + alongY, 0.0).r, textureLod(field, position + alongZ, 0.0).r);
  return differences(low, high, textureLod(field, position, 0.0).r, voxel);
}

vec3 centralDifferences(sampler3D field, vec3 position, vec3 voxel)
{
  return centralDifferences(field, position, voxel, voxel);
}
