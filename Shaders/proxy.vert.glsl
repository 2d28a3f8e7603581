// Faces of the occupied bricks: corners in bricks, from the volume's first voxel.

in vec3 corner;

uniform mat4 clipFromTexture;
uniform vec3 textureFromBrick;
uniform vec3 textureOfBrickZero;

out vec3 surface; // texture coordinates

void main()
{
  surface = corner * textureFromBrick + textureOfBrickZero;
  gl_Position = clipFromTexture * vec4(surface, 1.0);
}
