// What is at a rest position: scalar, colour and opacity, gradient. Texture coordinates.

// Colour, and opacity for one step, over the range of scalars. Each step length has a row.
uniform sampler2D transfer;
uniform float transferRow;       // texture coordinate of the present step's row
uniform vec2 transferFromScalar; // scale and shift: stored scalar to texture coordinate
uniform vec2 visibleScalars;     // stored scalars beyond which nothing is visible
uniform vec3 volumeLow;          // the volume's box, texture coordinates
uniform vec3 volumeHigh;

// What the loop needs is read once: a software driver reads and checks a uniform at each use.
struct TissueTable
{
  vec3 volumeLow;
  vec3 volumeHigh;
  vec2 transferFromScalar;
  vec2 visibleScalars;
};

TissueTable tissueTable()
{
  return TissueTable(volumeLow, volumeHigh, transferFromScalar, visibleScalars);
}

bool insideVolume(TissueTable table, vec3 rest)
{
  return all(greaterThanEqual(rest, table.volumeLow)) && all(lessThanEqual(rest, table.volumeHigh));
}

bool insideVolume(vec3 rest)
{
  return insideVolume(tissueTable(), rest);
}

uniform sampler3D scalars; // red: the scalar, as stored

#ifndef STREAMED // else streamed.glsl follows
float scalarAt(vec3 rest)
{
  return textureLod(scalars, rest, 0.0).r;
}
#endif

// Colour and opacity of one step. No opacity if the scalar is not a number.
vec4 tissueOf(TissueTable table, float scalar)
{
  float entry = scalar * table.transferFromScalar.x + table.transferFromScalar.y;
  vec4 tissue = textureLod(transfer, vec2(entry, transferRow), 0.0);
  tissue.a = isNumber(scalar) ? tissue.a : 0.0;
  return tissue;
}

vec4 tissueOf(float scalar)
{
  return tissueOf(tissueTable(), scalar);
}

// Whether a scalar may be visible. This is faster than a read of the colour map.
bool mayBeVisible(TissueTable table, float scalar)
{
  return scalar >= table.visibleScalars.x && scalar <= table.visibleScalars.y;
}

// Colour and opacity of one step at a position. No opacity outside the volume.
vec4 tissueAt(TissueTable table, vec3 rest, float scalar)
{
  vec4 tissue = tissueOf(table, scalar);
  tissue.a = insideVolume(table, rest) ? tissue.a * segmentOpacityAt(rest) : 0.0;
  return tissue;
}

// The scalar's gradient, of any length.
#ifdef GRADIENT_TEXTURE
uniform sampler3D normals; // see normals.frag.glsl

vec3 gradientAt(vec3 rest)
{
  return textureLod(normals, rest, 0.0).xyz - ZeroGradient;
}
#elif !defined(STREAMED)
uniform vec3 voxel; // one voxel, texture coordinates

vec3 gradientAt(vec3 rest)
{
  return centralDifferences(scalars, rest, voxel);
}
#endif
