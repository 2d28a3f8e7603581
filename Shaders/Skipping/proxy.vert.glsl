// Faces of the occupied bricks: corners in bricks, from the volume's first voxel.

in vec3 corner;

uniform mat4 clipFromTexture;
uniform vec3 textureFromBrick;
uniform vec3 textureOfBrickZero;
uniform vec3 fractionFromTexture; // of the way from the near to the far plane
uniform float fractionOfTextureZero;

out float fraction;

void main()
{
  vec3 position = corner * textureFromBrick + textureOfBrickZero;
  fraction = dot(position, fractionFromTexture) + fractionOfTextureZero;
  gl_Position = clipFromTexture * vec4(position, 1.0);
}
