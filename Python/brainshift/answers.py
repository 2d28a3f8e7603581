# SPDX-License-Identifier: BSD-3-Clause
"""Reads facts about the last picture of a Deformed Volume or Deformed Slices.

The process that draws computes them, so they are right with a server too.
"""

import time

REPRESENTATIONS = ("Deformed Volume", "Deformed Slices")


def _report(representation, view=None, wanted=REPRESENTATIONS):
    """The proxy that answers for a representation, in the process that draws it."""
    kind = getattr(representation, "Representation", None)
    if kind not in wanted:
        raise ValueError(f"the representation is {kind}; it must be {' or '.join(wanted)}")
    manager = representation.SMProxy.GetSessionProxyManager()
    report = manager.NewProxy("misc", "DeformedVolumeReport")
    report.UnRegister(None)  # Python holds it
    report.PrototypeOn()  # a question is no step to undo
    report.GetProperty("Representation").AddProxy(representation.SMProxy)
    if view is not None:
        report.GetProperty("View").AddProxy(view.SMProxy)
    report.UpdateVTKObjects()
    return report


def _answer(report, name):
    """The property that holds the answer, brought up to date."""
    answer = report.GetProperty(name)
    report.UpdatePropertyInformation(answer)
    return answer


def pick(representation, view, x, y):
    """Find the position of the tissue that a view shows at a pixel.

    The position is where the opacity along the ray reaches one half, or on the visible slice.
    It belongs to the picture that was drawn last. The function draws nothing.

    - `representation`: the display of the volume in `view`. It must be drawn as Deformed Volume or
      Deformed Slices.
    - `view`: a render view.
    - `x`, `y`: pixels from the lower left corner of the view.

    Returns three numbers in mm, world axes, deformed frame, or `None` where there is no tissue.

    Raises `ValueError` if `representation` is not shown in `view` or is drawn in another way.
    """
    if representation not in view.Representations:
        raise ValueError("the representation is not shown in this view")
    report = _report(representation, view)
    report.GetProperty("Pixel").SetElements2(int(x), int(y))
    report.UpdateVTKObjects()
    tissue = _answer(report, "Tissue")
    *position, found = (tissue.GetElement(i) for i in range(4))
    return tuple(position) if found else None


def slice_axes(representation):
    """Find the orientation of the planes of Deformed Slices in the world.

    They are known once the representation has been drawn.

    - `representation`: a display that is drawn as Deformed Slices.

    Returns two tuples. The first has three directions in world axes, the normals of the sagittal,
    the coronal and the axial plane. Each points towards greater coordinates. The second has three
    numbers, the distances in mm between voxels along those directions.

    Raises `ValueError` if `representation` is drawn in another way.
    """
    report = _report(representation, wanted=("Deformed Slices",))
    normals, steps = _answer(report, "SliceNormals"), _answer(report, "VoxelSteps")
    directions = tuple(tuple(normals.GetElement(3 * plane + i) for i in range(3))
                       for plane in range(3))
    return directions, tuple(steps.GetElement(plane) for plane in range(3))


def _numbers(representation):
    lines = _answer(_report(representation), "Counters").GetElement(0).splitlines()
    return {name: int(number) for name, number in (line.split() for line in lines)}


def counters(representation):
    """Count the work of the renderer of a representation since it was created.

    - `representation`: a display that is drawn as Deformed Volume or Deformed Slices.

    Returns a dict of integers:

    - `frames`: pictures drawn
    - `pixelsCast`: pixels of its images that rays were cast through, approximately
    - `volumeUploads`, `latticeUploads`, `transferUploads`, `segmentUploads`: how often the voxels,
      the control points, the colour map and the segments were sent to the GPU
    - `bytesUploaded`: bytes sent to the GPU, without corrections and bricks
    - `texelsRefined`: samples of the displacement that were computed from control points
    - `presenceUpdates`: how often the map of visible bricks was computed
    - `skippingBytes`: bytes of brick faces and leaps that were made from that map
    - `correctionBytes`: bytes sent to the GPU to correct the deformation where it varies fast
    - `samplesTaken`, `samplesSkipped`: samples along rays. They are counted while the property
      `CountSamples` of the representation is on
    - `imageScale`: screen pixels along one side of a pixel that was drawn, a state, not a count
    - `programsCompiled`: shader programs compiled
    - `voxelBytes`: bytes of the volume in this process's memory, a state: ParaView's part of it,
      and what a rank of several draws beyond that part

    Raises `ValueError` if `representation` is drawn in another way.
    """
    numbers = _numbers(representation)
    return {name: number for name, number in numbers.items() if not name.startswith("gpu")}


def gpu(representation):
    """Return how much of the GPU a representation uses now.

    - `representation`: a display that is drawn as Deformed Volume or Deformed Slices.

    Returns a dict of integers:

    - `gpuScalarBytes`: bytes of the voxels
    - `gpuOtherBytes`: bytes of all other textures and buffers, including those of picture size
    - `gpuVoxelsPerTexel`: voxels that one value stands for; 1: there is memory for each of them
    - `gpuNeedsPyramid`: 1 if it is drawn coarser, and `draw_from_pyramid` would bring all its
      voxels where the view needs them; else 0
    - `gpuLevel`: the finer level of an OME-Zarr store of which bricks are drawn; -1: none
    - `gpuBricks`: bricks of it that are drawn where rays or slices meet them, in all views
    - `gpuBricksWanted`: bricks that are still to come, at least 1 while there may be some; 0: each
      view is complete, or has as many as its memory holds
    - `gpuBricksComing`: views that had better be drawn a little later, while bricks are read
    - `gpuBricksRead`: bricks that were read and are in no picture yet
    - `gpuBricksLackRoom`: views with more bricks than their memory holds
    - `gpuFieldMicroseconds`: microseconds of the last computation from control points to offset
      field, or 0 if the driver does not measure it

    Raises `ValueError` if `representation` is drawn in another way.
    """
    numbers = _numbers(representation)
    return {name: number for name, number in numbers.items() if name.startswith("gpu")}


def draw_detail(view, representation, seconds=60.0):
    """Draw a view again and again until it shows all detail that it gets of a large volume.

    - `view`: a render view.
    - `representation`: a display that is drawn as Deformed Volume or Deformed Slices in it.
    - `seconds`: the longest time to wait, s. Default 60.

    Returns what `gpu` returns then. A volume that is read at its finest level takes one picture.
    Raises `ValueError` if `representation` is drawn in another way, `RuntimeError` after `seconds`.
    """
    end = time.monotonic() + seconds
    while True:
        view.SMProxy.StillRender()
        now = gpu(representation)
        if now["gpuBricksWanted"] == 0:
            return now
        if time.monotonic() > end:
            raise RuntimeError(f"{now['gpuBricksWanted']} bricks of level {now['gpuLevel']} are "
                               f"still to come after {seconds} s; give more seconds")
        report = _report(representation)  # a picture of each brick would take most of the time
        while _answer(report, "Detail").GetElement(4) and time.monotonic() < end:
            time.sleep(0.01)
