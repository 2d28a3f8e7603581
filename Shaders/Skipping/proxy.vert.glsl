// Faces of the occupied bricks: corners in bricks, from the volume's first voxel.

in vec3 corner;

uniform mat4 clipFromTexture;
uniform vec3 textureFromBrick;
uniform vec3 textureOfBrickZero;
uniform vec3 shareFromTexture; // of the way from the near to the far plane
uniform float shareOfTextureZero;

out float share;

void main()
{
  vec3 position = corner * textureFromBrick + textureOfBrickZero;
  share = dot(position, shareFromTexture) + shareOfTextureZero;
  gl_Position = clipFromTexture * vec4(position, 1.0);
}
