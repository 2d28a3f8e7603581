// A rectangle in the deformed frame: two triangles as two instances, without a buffer.

uniform mat4 clipFromTexture;
uniform vec3 quadCorner; // texture coordinates
uniform vec3 quadRight;
uniform vec3 quadUp;

out vec3 deformed; // texture coordinates

void main()
{
  int corner = gl_InstanceID == 0 ? gl_VertexID : 3 - gl_VertexID;
  deformed = quadCorner + float(corner & 1) * quadRight + float(corner >> 1) * quadUp;
  gl_Position = clipFromTexture * vec4(deformed, 1.0);
}
