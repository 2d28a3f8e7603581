// A gradient of zero as a texture holds it: whole numbers of ten bits, so that it is exact.
const float ZeroGradient = 512.0 / 1023.0;

// Gradient of the scalar per texture unit: central differences over one voxel to either side.

vec3 centralDifferences(sampler3D field, vec3 position, vec3 voxel)
{
  vec3 alongX = vec3(voxel.x, 0.0, 0.0);
  vec3 alongY = vec3(0.0, voxel.y, 0.0);
  vec3 alongZ = vec3(0.0, 0.0, voxel.z);
  vec3 low = vec3(textureLod(field, position - alongX, 0.0).r,
    textureLod(field, position - alongY, 0.0).r, textureLod(field, position - alongZ, 0.0).r);
  vec3 high = vec3(textureLod(field, position + alongX, 0.0).r,
    textureLod(field, position + alongY, 0.0).r, textureLod(field, position + alongZ, 0.0).r);
  return (high - low) / (2.0 * voxel);
}

bool isFinite(float scalar)
{
  return !isnan(scalar) && !isinf(scalar);
}

// The same; beside values that are no numbers, differences to the known side only.
vec3 knownDifferences(sampler3D field, vec3 position, vec3 voxel)
{
  vec3 gradient = centralDifferences(field, position, voxel);
  if (isFinite(gradient.x) && isFinite(gradient.y) && isFinite(gradient.z))
  {
    return gradient;
  }
  float here = textureLod(field, position, 0.0).r;
  for (int axis = 0; axis < 3; ++axis)
  {
    vec3 along = vec3(0.0);
    along[axis] = voxel[axis];
    float low = textureLod(field, position - along, 0.0).r;
    float high = textureLod(field, position + along, 0.0).r;
    float sides = float(isFinite(low)) + float(isFinite(high));
    float change = (isFinite(high) ? high : here) - (isFinite(low) ? low : here);
    gradient[axis] = change / (max(sides, 1.0) * voxel[axis]);
  }
  return gradient;
}
