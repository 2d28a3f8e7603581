// What is at a rest position: scalar, colour and opacity, gradient. Texture coordinates.

uniform sampler2D transfer;      // colour, and opacity for one step, over the scalar range
uniform vec2 transferFromScalar; // scale and shift: stored scalar to texture coordinate
uniform vec3 volumeLow;          // the volume's box, texture coordinates
uniform vec3 volumeHigh;

// What the loop needs, read once: a software driver reads uniforms anew, and checked, at each use.
struct TissueTable
{
  vec3 volumeLow;
  vec3 volumeHigh;
  vec2 transferFromScalar;
};

TissueTable tissueTable()
{
  return TissueTable(volumeLow, volumeHigh, transferFromScalar);
}

bool insideVolume(TissueTable table, vec3 rest)
{
  return all(greaterThanEqual(rest, table.volumeLow)) && all(lessThanEqual(rest, table.volumeHigh));
}

uniform sampler3D scalars; // red: the scalar, as stored

float scalarAt(vec3 rest)
{
  return textureLod(scalars, rest, 0.0).r;
}

// Colour and opacity of one step; nothing outside the volume and where the scalar is not a number.
vec4 tissueAt(TissueTable table, vec3 rest)
{
  float scalar = scalarAt(rest);
  float entry = scalar * table.transferFromScalar.x + table.transferFromScalar.y;
  vec4 tissue = textureLod(transfer, vec2(entry, 0.5), 0.0);
  return insideVolume(table, rest) && !isnan(scalar) ? tissue : vec4(0.0);
}

// The scalar's gradient, of any length.
#ifdef GRADIENT_TEXTURE
uniform sampler3D normals; // see normals.frag.glsl

vec3 gradientAt(vec3 rest)
{
  return textureLod(normals, rest, 0.0).xyz - ZeroGradient;
}
#else
uniform vec3 voxel; // one voxel, texture coordinates

vec3 gradientAt(vec3 rest)
{
  return centralDifferences(scalars, rest, voxel);
}
#endif
