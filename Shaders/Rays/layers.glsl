// What a ray meets of two volumes, and how they hide each other (paper, section 3: the bent volume
// is red, the reference green). Each volume hides what lies behind its own surface. It hides the
// other volume only where it lies clearly in front: surfaces that are closer than the agreement
// count as one, and their colours add up: red and green to yellow, blue and orange to grey. Volumes
// with equal opacities are each as bright as alone.

uniform float agreementSamples; // samples from one surface to the other at which half is hidden
uniform vec3 ownColor;          // of the bent volume
uniform vec3 referenceColor;    // of the reference

const float LeastFacing = 0.35; // surfaces that are seen more from the side count as this
const vec3 Luminance = vec3(0.2126, 0.7152, 0.0722);

// What a ray has met of one volume.
struct Layer
{
  float opacity;
  float place;  // numbers of its samples, each times what it added to the opacity
  float facing; // how squarely their surfaces face the eye, 0 to 1, each times that opacity
  float hit;    // number of the sample where HitOpacity was reached; below 0: not yet
};

const Layer NothingMet = Layer(0.0, 0.0, 0.0, -1.0);

// How much of a sample a layer before it hides. This depends on the distance between the surfaces,
// which is shorter than the distance along the ray.
float hiding(Layer front, float number)
{
  float met = max(front.opacity, 1e-6);
  float behind = (number - front.place / met) * max(front.facing / met, LeastFacing);
  return front.opacity * clamp(behind / agreementSamples - 0.5, 0.0, 1.0);
}

// The fraction of a sample of the layer `own` that reaches the eye.
float seenFraction(Layer own, Layer other, float number)
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
