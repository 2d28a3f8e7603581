// What is at a rest position: scalar, colour and opacity, gradient. Texture coordinates.

uniform sampler3D scalars;       // red: the scalar, as stored
uniform sampler2D transfer;      // colour, and opacity for one step, over the scalar range
uniform vec2 transferFromScalar; // scale and shift: stored scalar to texture coordinate
uniform vec3 volumeLow;          // the volume's box, texture coordinates
uniform vec3 volumeHigh;

bool insideVolume(vec3 rest)
{
  return all(greaterThanEqual(rest, volumeLow)) && all(lessThanEqual(rest, volumeHigh));
}

float scalarAt(vec3 rest)
{
  return textureLod(scalars, rest, 0.0).r;
}

// Colour and opacity; nothing where the scalar is not a number.
vec4 tissueOf(float scalar)
{
  vec4 tissue =
    textureLod(transfer, vec2(scalar * transferFromScalar.x + transferFromScalar.y, 0.5), 0.0);
  return isnan(scalar) ? vec4(0.0) : tissue;
}

#ifdef SHADED
#ifdef NORMAL_TEXTURE
uniform sampler3D normals; // gradients found beforehand, see normals.frag.glsl

vec3 gradientAt(vec3 rest)
{
  return textureLod(normals, rest, 0.0).xyz;
}
#else
uniform vec3 voxel; // one voxel, texture coordinates

vec3 gradientAt(vec3 rest)
{
  return centralDifferences(scalars, rest, voxel);
}
#endif
#endif
