// Phong's model (paper, section 2) with ParaView's lights, two-sided as its volumes are.

#ifdef SHADED
uniform int lightCount;
uniform vec4 lightPosition[MAX_LIGHTS]; // world; w 0: direction towards the light, unit length
uniform vec3 lightColor[MAX_LIGHTS];    // times intensity
uniform vec3 lightSpecular[MAX_LIGHTS];
uniform int headlight;                  // 1: the only light is at the eye
uniform vec4 material;                  // ambient, diffuse, specular, specular power

// `normal`, `towardsEye`: unit length, world axes; `position`: mm, world.
vec3 lit(vec3 color, vec3 normal, vec3 towardsEye, vec3 position)
{
  if (headlight == 1)
  {
    // The commonest case: light, eye and mirrored light lie in one line with the normal's plane.
    float facing = dot(normal, towardsEye);
    vec3 bright = material.x * color + material.y * abs(facing) * lightColor[0] * color;
    if (material.z > 0.0)
    {
      float glint = max(2.0 * facing * facing - 1.0, 0.0);
      bright += material.z * pow(glint, material.w) * lightSpecular[0];
    }
    return bright;
  }
  vec3 diffuse = vec3(0.0);
  vec3 specular = vec3(0.0);
  for (int i = 0; i < lightCount; ++i)
  {
    vec3 towardsLight = normalize(lightPosition[i].xyz - position * lightPosition[i].w);
    float facing = dot(normal, towardsLight);
    diffuse += abs(facing) * lightColor[i];
    if (material.z > 0.0)
    {
      vec3 mirrored = 2.0 * facing * normal - towardsLight;
      specular += pow(max(dot(mirrored, towardsEye), 0.0), material.w) * lightSpecular[i];
    }
  }
  return material.x * color + material.y * diffuse * color + material.z * specular;
}
#endif
