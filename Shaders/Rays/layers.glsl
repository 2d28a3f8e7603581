// What a ray meets of two volumes, and how they hide each other (paper, section 3: the bent one
// red, the reference green). Each hides what lies behind itself. It hides the other only where it
// lies clearly before it: surfaces closer than the agreement count as one, and red and green add up
// to yellow. Where both have the same opacities, each is as bright as alone.

uniform float agreementSamples; // samples from one surface to the other at which half is hidden

const float LeastFacing = 0.35; // surfaces seen more from the side are measured as if they were not
const vec3 Luminance = vec3(0.2126, 0.7152, 0.0722);

// What was met of one volume.
struct Layer
{
  float opacity;
  float place;  // numbers of its samples, each times what it added to the opacity
  float facing; // likewise how squarely their surfaces face the eye, 0 to 1
  float hit;    // number of the sample where HitOpacity was reached; below 0: not yet
};

const Layer NothingMet = Layer(0.0, 0.0, 0.0, -1.0);

// How much of a sample is hidden by a layer before it, by the distance between the surfaces, which
// is shorter than that along the ray.
float hiding(Layer front, float number)
{
  float met = max(front.opacity, 1e-6);
  float behind = (number - front.place / met) * max(front.facing / met, LeastFacing);
  return front.opacity * clamp(behind / agreementSamples - 0.5, 0.0, 1.0);
}

// Share of what lies at a sample of its own layer that reaches the eye.
float shownShare(Layer own, Layer other, float number)
{
  return min(1.0 - own.opacity, 1.0 - hiding(other, number));
}

void join(inout Layer layer, float opacity, float facing, float number)
{
  float added = (1.0 - layer.opacity) * opacity;
  layer.opacity += added;
  layer.place += added * number;
  layer.facing += added * facing;
  bool hit = layer.hit < 0.0 && layer.opacity >= HitOpacity;
  layer.hit = hit ? max(number - 0.5, 0.0) : layer.hit;
}

// Light of a white surface, and how squarely it faces the eye.
vec2 lightOf(vec3 gradient, vec3 towardsEye, vec3 deformed)
{
#ifdef SHADED
  float steepness = length(gradient);
  vec3 normal = steepness > 0.0 ? gradient / steepness : vec3(0.0);
  vec3 light = shone(shineOn(normal, towardsEye, worldFromDeformed(deformed)), vec3(1.0));
  return vec2(clamp(dot(light, Luminance), 0.0, 1.0), abs(dot(normal, towardsEye)));
#else
  return vec2(1.0);
#endif
}
