// Composite blending from front to back (paper, section 2). It is used most and has its own loop.

void main()
{
  if (!CountsSamples && meetsNothing())
  {
    gl_FragData[0] = vec4(0.0);
    gl_FragData[1] = NoHit;
#ifdef WISHES
    gl_FragData[2] = vec4(-1.0);
#endif
    return;
  }
  Path path = pathOf(rayOfPixel(ndc));
  TissueTable table = tissueTable();
  mat3 turn = worldFromGradient;
  Seen seen = nothingYet();
  // Samples are numbered from the edge of the box or from a cut, even if empty space is skipped.
  float end = path.samples.y;
  float i = evenBelow(path.samples.x);
  float ask = skipping == 0 ? end : i + Trust; // the first sample whose brick is asked
  float taken = 0.0;
  while (i < end && seen.picture.a <= OpaqueEnough)
  {
    bool present = true;
    if (i >= ask)
    {
      ask = evenBelow(sampleBeyond(leaps, leapsTexel, path.bricks, i, present));
      present = present || ask <= i;
    }
    float next = ask;
    if (present)
    {
      bool visible = takeTwo(path, table, turn, i, seen);
      ask = visible ? max(ask, i + Trust) : ask;
      taken += min(2.0, end - i);
      next = i + 2.0;
    }
    i = next;
  }
  float all = ceil((path.span.y - path.span.x) / stepMm);
  countSamples(taken, max((seen.picture.a > OpaqueEnough ? i : all) - taken, 0.0));
  gl_FragData[0] = pictureOfPart(seen.picture);
  gl_FragData[1] = seen.hit < 0.0 ? NoHit : hitAt(path.span.x + seen.hit * stepMm);
#ifdef WISHES
  gl_FragData[2] = vec4(wishes, -1.0, -1.0);
#endif
}
