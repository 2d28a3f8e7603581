// Cubic B-spline filter of a 3D texture from eight trilinear reads (Sigg and Hadwiger, GPU Gems 2,
// chapter 20): along an axis, two neighbours weigh as much as one read between them.

// Weight of the upper pair, and where between its voxels and those of the lower pair to read;
// voxels from the one below, for a fraction of the way to the next.
struct CubicPairs
{
  vec3 upper;
  vec3 lowerAt;
  vec3 upperAt;
};

CubicPairs cubicPairs(vec3 fraction)
{
  vec3 left = 1.0 - fraction;
  vec3 first = left * left * left / 6.0;
  vec3 last = fraction * fraction * fraction / 6.0;
  vec3 second = 2.0 / 3.0 - 0.5 * fraction * fraction * (1.0 + left);
  vec3 third = 1.0 - first - second - last;
  return CubicPairs(third + last, second / (first + second) - 1.0, 1.0 + last / (third + last));
}

// Red at a position, texture coordinates; `voxels`: of the texture, a side.
float cubicAt(sampler3D texels, vec3 position, vec3 voxels)
{
  vec3 voxel = position * voxels - 0.5;
  vec3 below = floor(voxel);
  CubicPairs pairs = cubicPairs(voxel - below);
  vec3 low = (below + pairs.lowerAt + 0.5) / voxels;
  vec3 high = (below + pairs.upperAt + 0.5) / voxels;
  vec4 sums; // (y, z): low low, high low, low high, high high
  for (int i = 0; i < 4; ++i)
  {
    vec2 yz = vec2((i & 1) == 1 ? high.y : low.y, i >> 1 == 1 ? high.z : low.z);
    float atLow = textureLod(texels, vec3(low.x, yz), 0.0).r;
    float atHigh = textureLod(texels, vec3(high.x, yz), 0.0).r;
    sums[i] = mix(atLow, atHigh, pairs.upper.x);
  }
  vec2 alongY = mix(sums.xz, sums.yw, pairs.upper.y);
  return mix(alongY.x, alongY.y, pairs.upper.z);
}

// isCubic: 1 or 0, with the texture's own filter.
float filteredAt(sampler3D texels, vec3 position, vec3 voxels, int isCubic)
{
  return isCubic == 1 ? cubicAt(texels, position, voxels) : textureLod(texels, position, 0.0).r;
}
