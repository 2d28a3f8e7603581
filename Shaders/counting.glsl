// A third target for whoever tunes skipping: samples a ray took, and samples it leapt over before
// it ended. Joined on demand only: counting costs.

void countSamples(int taken, int skipped)
{
  gl_FragData[2] = vec4(float(taken), float(skipped), 0.0, 0.0);
}
