// The lines in which the other two planes cut a slice. Where they meet stays a gap, so that the
// tissue there is seen.

uniform int crosshair;        // 1: the lines are drawn
uniform int quadAxis;         // the slice lies across this axis of the texture
uniform vec3 crossing;        // where the planes meet, texture coordinates
uniform mat3 crosshairColors; // a column for the plane across each axis of the texture
uniform float screenScale;    // pixels for one of a usual screen, along a side

const float HalfCrosshairPixels = 1.0; // thinner lines fade where edges are smoothed
const float GapPixels = 9.0;           // to either side

// Whether a line is drawn here, in which colour. To be called by all fragments, for derivatives.
bool onCrosshair(vec3 deformed, out vec3 color)
{
  vec3 pixels = (deformed - crossing) / max(fwidth(deformed), vec3(1e-12));
  // The crossing moves to an edge between pixels, so that both sides are alike. A shift of 0 or a
  // half would let rounding choose the edge where the crossing is on an edge or amid a pixel.
  vec3 distance = abs(floor(pixels + 0.3) + 0.5) / screenScale;
  for (int turn = 1; turn < 3; ++turn)
  {
    int axis = (quadAxis + turn) % 3;
    int along = (quadAxis + 3 - turn) % 3;
    if (distance[axis] < HalfCrosshairPixels && distance[along] > GapPixels)
    {
      color = crosshairColors[axis];
      return crosshair == 1;
    }
  }
  return false;
}
