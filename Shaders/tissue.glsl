// What is at a rest position: scalar, colour and opacity, gradient. Texture coordinates.

uniform sampler2D transfer;      // colour, and opacity for one step, over the scalar range
uniform vec2 transferFromScalar; // scale and shift: stored scalar to texture coordinate
uniform vec3 volumeLow;          // the volume's box, texture coordinates
uniform vec3 volumeHigh;

bool insideVolume(vec3 rest)
{
  return all(greaterThanEqual(rest, volumeLow)) && all(lessThanEqual(rest, volumeHigh));
}

// Colour and opacity; nothing where the scalar is not a number.
vec4 tissueOf(float scalar)
{
  vec4 tissue =
    textureLod(transfer, vec2(scalar * transferFromScalar.x + transferFromScalar.y, 0.5), 0.0);
  return isnan(scalar) ? vec4(0.0) : tissue;
}

// What one sample reads: the scalar in alpha and, where they come packed, the gradient in the rest.
#ifdef PACKED_GRADIENTS
uniform sampler3D packedTissue; // see normals.frag.glsl

vec4 probeAt(vec3 rest)
{
  return textureLod(packedTissue, rest, 0.0);
}

vec3 gradientOf(vec4 probe, vec3 rest)
{
  return probe.rgb - PackedZero;
}
#else
uniform sampler3D scalars; // red: the scalar, as stored

vec4 probeAt(vec3 rest)
{
  return vec4(0.0, 0.0, 0.0, textureLod(scalars, rest, 0.0).r);
}

#ifdef GRADIENT_TEXTURE
uniform sampler3D normals; // see normals.frag.glsl

vec3 gradientOf(vec4 probe, vec3 rest)
{
  return textureLod(normals, rest, 0.0).xyz;
}
#else
uniform vec3 voxel; // one voxel, texture coordinates

vec3 gradientOf(vec4 probe, vec3 rest)
{
  return centralDifferences(scalars, rest, voxel);
}
#endif
#endif
