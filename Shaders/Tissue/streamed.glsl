// Voxels of a finer level of the volume, in bricks that come while rays or slices ask for them.
// Where a brick is not there, the volume's own voxels are drawn.

uniform sampler3D pages;      // for each brick: place of its slot, of 255; alpha 1 if it is there
uniform sampler3D atlas;      // slots of bricks, each with a border: red: the scalar, as stored
uniform vec3 fineFromTexture; // scale and shift: voxels of the finer level
uniform vec3 fineOfTextureZero;
uniform vec3 fineVoxels; // a side
uniform vec3 pagesTexel; // one brick, texture coordinates of `pages`
uniform vec3 atlasTexel; // one voxel, texture coordinates of `atlas`
uniform vec3 voxel;      // one of the volume's own, texture coordinates

const float SlotSideVoxels = BRICK_SIDE + 2.0 * BRICK_BORDER;

vec3 fineAt(vec3 rest)
{
  return clamp(rest * fineFromTexture + fineOfTextureZero, vec3(0.0), fineVoxels);
}

// The brick of a voxel. The last one has the volume's outer face, too.
vec3 brickOf(vec3 fine)
{
  return floor(min(fine, fineVoxels - 0.5) / BRICK_SIDE);
}

float numberOf(vec3 brick)
{
  vec3 bricks = ceil(fineVoxels / BRICK_SIDE);
  return (brick.z * bricks.y + brick.y) * bricks.x + brick.x;
}

vec4 pageOf(vec3 brick)
{
  return textureLod(pages, (brick + 0.5) * pagesTexel, 0.0);
}

// The brick that was read last. Samples of a ray mostly lie in the same one as the sample before.
vec3 heldLow = vec3(1.0); // its voxels, first and one past the last; at first none
vec3 heldHigh = vec3(0.0);
bool heldIsThere = false;
vec3 heldInAtlas = vec3(0.0); // a voxel's place in the atlas, less its number

void holdBrickOf(vec3 fine)
{
  if (any(lessThan(fine, heldLow)) || any(greaterThanEqual(fine, heldHigh)))
  {
    vec3 brick = brickOf(fine);
    vec4 page = pageOf(brick);
    heldLow = BRICK_SIDE * brick;
    heldHigh = heldLow + BRICK_SIDE;
    heldIsThere = page.a >= 0.5;
    heldInAtlas = floor(page.xyz * 255.0 + 0.5) * SlotSideVoxels + BRICK_BORDER - heldLow;
  }
}

// Position in the atlas of a voxel of the held brick.
vec3 positionInAtlas(vec3 fine)
{
  return (fine + heldInAtlas) * atlasTexel;
}

// The sampler would clamp, too. But a software driver skips a branch that no ray needs only if one
// of the two has 8 instructions or more (Mesa's llvmpipe). Without that, each sample reads both
// textures: a picture takes a fifth longer.
float coarseScalarAt(vec3 rest)
{
  return textureLod(scalars, clamp(rest, 0.0, 1.0), 0.0).r;
}

float scalarAt(vec3 rest)
{
  vec3 fine = fineAt(rest);
  holdBrickOf(fine);
  return heldIsThere ? textureLod(atlas, positionInAtlas(fine), 0.0).r : coarseScalarAt(rest);
}

// Differences over one voxel to either side, of the level that is drawn there. A slot's border has
// the voxels of its neighbours.
vec3 gradientAt(vec3 rest)
{
  vec3 fine = fineAt(rest);
  holdBrickOf(fine);
  return heldIsThere
    ? centralDifferences(atlas, positionInAtlas(fine), atlasTexel, 1.0 / fineFromTexture)
    : centralDifferences(scalars, rest, voxel);
}

#ifdef WISHES
// Each pixel names one brick that its ray saw and that is not there, and one that is: not always
// the first, so that pixels side by side name others. Up to a voxel from a brick's face the brick
// beyond it is looked at, because its finer voxels may be visible, too: at edges and corners each
// pixel looks across other faces.
uniform ivec2 wishSeed; // another one for each picture
uniform vec3 wishReach; // one of the volume's own voxels, voxels of the finer level

const int WishRanks = 16;

ivec2 wishPixel = ivec2(gl_FragCoord.xy);
int wishFaces = (3 * wishPixel.x + 5 * wishPixel.y + wishSeed.y) & 7;
vec3 wishShift =
  wishReach * vec3(float(wishFaces & 1), float(wishFaces >> 1 & 1), float(wishFaces >> 2));
ivec2 wishesLeft = ivec2((5 * wishPixel.x + 11 * wishPixel.y + wishSeed.x) & (WishRanks - 1));
vec2 wishes = vec2(-1.0); // numbers of bricks: not there, there
vec3 lastAsked = vec3(-1.0);

void askForBrick(vec3 rest)
{
  vec3 fine = fineAt(rest);
  vec3 towardsFace = step(0.5, fract(fine / BRICK_SIDE)) * 2.0 - 1.0;
  vec3 brick = brickOf(clamp(fine + towardsFace * wishShift, vec3(0.0), fineVoxels));
  if (brick == lastAsked)
  {
    return;
  }
  lastAsked = brick;
  float number = numberOf(brick);
  if (pageOf(brick).a < 0.5)
  {
    wishes.x = wishesLeft.x >= 0 ? number : wishes.x;
    wishesLeft.x -= 1;
  }
  else
  {
    wishes.y = wishesLeft.y >= 0 ? number : wishes.y;
    wishesLeft.y -= 1;
  }
}
#endif
