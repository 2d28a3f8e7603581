// Render to a 3D texture: one viewport-covering triangle for each layer, as instances.

uniform int firstLayer;

flat out int layerVSOut;

void main()
{
  layerVSOut = firstLayer + gl_InstanceID;
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
