// A third target for whoever tunes skipping: samples a ray took, and samples it leapt over before
// it ended. Joined on demand only: counting costs.

const bool CountsSamples = true;

void countSamples(float taken, float skipped)
{
  gl_FragData[2] = vec4(taken, skipped, 0.0, 0.0);
}
