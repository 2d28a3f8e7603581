# SPDX-License-Identifier: BSD-3-Clause
"""How near Align and Refine come to what is known, and how long they take.

    ./brainshift python Benchmark/registration.py [VOLUME]

Rigid: the volume (NIfTI; without one, that of the tests) against itself, inverted, noisy and on
another grid, from 20 random starts up to 20 mm and 15 degrees away. The error is the largest one
at eight corners of a head.

Elastic: the case study's sag with its cavity, and the 50 landmarks of Examples/case_study.py; then
a sag 2.5 times as large. Speed: steps on the finest level, and the longest call.
"""

import contextlib
import os
import pathlib
import sys
import time

import numpy
from paraview import servermanager, simple

simple.LoadDistributedPlugin("BrainShift", ns=globals())
ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "Examples"))

import brainshift  # noqa: E402 (after the plugin)
import case_study  # noqa: E402

HEAD = ROOT / "Testing" / "Data" / "seg3d-utah" / "seg3d_mr_t1.nii.gz"
STARTS = 20
FARTHEST_MM = 20.0
FARTHEST_DEGREES = 15.0
NOISE = 0.05  # of the largest value, standard deviation
CORNERS_MM = 70.0  # from the middle, along each axis
LARGE_SAG = 2.5  # times the sag of the case study

# Another contrast: `mode` names it. Values above `top` are few.
CHANGED = """
import numpy
image = inputs[0]
name = image.PointData.keys()[0] if image.VTKObject.GetPointData().GetScalars() is None \\
    else image.VTKObject.GetPointData().GetScalars().GetName()
values = numpy.array(image.PointData[name], float)
top = numpy.percentile(values, 99.9)
k, j, i = (index.ravel() for index in numpy.indices(image.GetDimensions()[::-1]))
random = numpy.random.default_rng({seed})
if "inverted" in "{mode}":
    values = top - values
if "bias" in "{mode}":
    values = values * (1 + 0.3 * numpy.sin(0.02 * i + 1) * numpy.cos(0.015 * j))
if "noise" in "{mode}":
    values = values + random.normal(0, {noise} * top, len(values))
output.PointData.append(values.astype(numpy.float32), "Changed")
output.PointData.SetActiveScalars("Changed")
"""


def changed(source, mode, seed=1):
    """The volume with another contrast."""
    result = simple.ProgrammableFilter(
        Input=source, Script=CHANGED.format(mode=mode, seed=seed, noise=NOISE))
    result.UpdatePipeline()
    return result


def start(random, number):
    """Rotation (degrees) and translation (mm) of a start; every other one is farthest."""
    directions = random.normal(size=(2, 3))
    directions /= numpy.linalg.norm(directions, axis=1)[:, None]
    shares = random.uniform(0, 1, 2) if number % 2 else (1.0, 1.0)
    return (FARTHEST_DEGREES * shares[0] * directions[0] / 1.05,
            FARTHEST_MM * shares[1] * directions[1])


def rotation_matrix(degrees):
    """A rotation about x, then y, then z."""
    matrix = numpy.eye(3)
    for axis, angle in enumerate(numpy.radians(degrees)):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        about = numpy.eye(3)
        about[[a, b], [a, b]] = numpy.cos(angle)
        about[b, a], about[a, b] = numpy.sin(angle), -numpy.sin(angle)
        matrix = about @ matrix
    return matrix


def left_over(compare):
    """Largest distance (mm) at the corners between where the reference lies and its place."""
    turn = rotation_matrix(compare.ReferenceRotation)
    signs = numpy.array(numpy.meshgrid(*[(-1, 1)] * 3)).reshape(3, -1).T
    corners = CORNERS_MM * signs
    moved = corners @ turn.T + numpy.array(compare.ReferenceTranslation)
    return numpy.linalg.norm(moved - corners, axis=1).max()


def rigid(name):
    volume = simple.NIFTIVolumeReader(FileName=str(name))
    volume.UpdatePipeline()
    bounds = volume.GetDataInformation().GetBounds()
    sides = [int((bounds[2 * a + 1] - bounds[2 * a]) / step) for a, step in
             enumerate((1.2, 1.4, 1.6))]
    other = simple.ResampleToImage(Input=changed(volume, "inverted noise"),
                                   SamplingDimensions=sides)
    other.UpdatePipeline()
    array = simple.Calculator(Input=other, Function="Changed", ResultArrayName="Inverted")
    random = numpy.random.default_rng(19)
    errors, seconds = [], []
    for number in range(STARTS):
        rotation, translation = start(random, number)
        compare = simple.CompareVolumes(
            Input=volume, Reference=array, ReferenceRotation=rotation.tolist(),
            ReferenceTranslation=translation.tolist())
        compare.UpdatePipeline()
        before = time.process_time()
        brainshift.align(compare)
        seconds.append(time.process_time() - before)
        errors.append(left_over(compare))
        simple.Delete(compare)
    print(f"rigid: {numpy.sum(numpy.array(errors) < 0.3)} of {STARTS} starts within 0.3 mm, "
          f"largest error {max(errors):.3f} mm, CPU mean {numpy.mean(seconds):.1f} s, "
          f"largest {max(seconds):.1f} s")


class Landmarks:
    """How far a bend moves the landmarks of a case from where its sag moves them."""

    def __init__(self, case):
        self.points = case.landmarks
        self.truth = brainshift.deformed_from_rest(case.sag, self.points)

    def error(self, bent):
        found = brainshift.deformed_from_rest(bent, self.points)
        apart = numpy.linalg.norm(found - self.truth, axis=1)
        return f"{apart.mean():.2f} / {apart.max():.2f} mm"


def refine_each(title, case, cases):
    """Refines an unbent volume once for each contrast and similarity, and prints what is left."""
    landmarks = Landmarks(case)
    print(f"{title}, before: {landmarks.error(case.bent)}")
    for mode, similarity in cases:
        bent = simple.FreeFormDeformation(Input=case.brain)
        reference = changed(case.after_surgery, mode)
        before = time.process_time(), time.monotonic()
        found = brainshift.refine(bent, reference, similarity=similarity,
                                  cavity=case.compare.Cavity)
        took = time.process_time() - before[0], time.monotonic() - before[1]
        print(f"{title}, {mode}, {similarity}: {landmarks.error(bent)}, {found.steps} steps, "
              f"CPU {took[0]:.1f} s, {took[1]:.1f} s, determinant {found.smallest_determinant:.2f}")


def elastic():
    case = case_study.Case()
    refine_each("elastic", case, (
        ("inverted", "auto"), ("bias noise", "auto"), ("inverted bias noise", "auto"),
        ("same", "same contrast"), ("bias noise", "same contrast")))
    case_study.stamp_to_trace(case.bent, case.measure)
    landmarks = Landmarks(case)
    by_hand = landmarks.error(case.bent)
    brainshift.refine(case.bent, changed(case.after_surgery, "inverted"),
                      cavity=case.compare.Cavity)
    print(f"elastic, inverted, auto: ten stamps {by_hand}, refined from there "
          f"{landmarks.error(case.bent)}")
    refine_each(f"sag times {LARGE_SAG}", case_study.Case(LARGE_SAG), (
        ("inverted", "auto"), ("bias noise", "auto"), ("same", "same contrast")))


@contextlib.contextmanager
def every_call(note):
    """Calls note(level, steps) after each call of a run, whether or not it took a step."""
    from brainshift import registering
    figure = registering._Run.figure

    def noted(run, name):
        if name == "Finished":  # is read once after each call
            note(figure(run, "Level"), figure(run, "Steps"))
        return figure(run, name)
    registering._Run.figure = noted
    try:
        yield
    finally:
        registering._Run.figure = figure


def speed():
    """Time of a step at 256 x 256 x 150 voxels, on the finest level, and of the longest call."""
    head = simple.NIFTIVolumeReader(FileName=str(HEAD))
    big = simple.ResampleToImage(Input=head, SamplingDimensions=(256, 256, 150))
    image = servermanager.Fetch(big)
    name = image.GetPointData().GetArray(0).GetName()
    # As fine as scans of that size are, so that the levels have as many samples.
    placed = simple.ProgrammableFilter(Input=big, Script=f"""
output.VTKObject.SetSpacing(1.0, 1.0, 1.0)
output.PointData.append(inputs[0].PointData["{name}"], "Scan")
output.PointData.SetActiveScalars("Scan")
""", RequestInformationScript="""
from vtkmodules.vtkCommonDataModel import vtkDataObject
executive = self.GetExecutive()
executive.GetOutputInformation(0).Set(vtkDataObject.SPACING(), 1.0, 1.0, 1.0)
""")
    placed.UpdatePipeline()
    bounds = numpy.array(placed.GetDataInformation().GetBounds()).reshape(3, 2)
    strokes = brainshift.soft(bounds.mean(axis=1), (3, -3, 4), 60.0)
    baked = simple.BakeDeformation(
        Input=simple.FreeFormDeformation(Input=placed, Strokes=strokes))
    for similarity in ("auto", "same contrast", "ultrasound"):
        bent = simple.FreeFormDeformation(Input=placed)
        times = []  # of each call: level, steps, clock and processor time

        def note(level, steps, times=times):
            times.append((level, steps, time.monotonic(), time.process_time()))
        with every_call(note):
            note(0, 0)
            found = brainshift.refine(bent, baked, similarity=similarity)
        whole = times[-1][2] - times[0][2]
        calls = numpy.diff(times, axis=0)
        fine = (calls[:, 1] == 1) & (numpy.array(times)[1:, 0] == found.level)
        step, cpu = 1000 * numpy.median(calls[fine, 2:], axis=0)
        print(f"speed, 256 x 256 x 150, {similarity}: {step:.0f} ms a step on the finest level "
              f"(CPU {cpu:.0f} ms), longest call {1000 * calls[1:, 2].max():.0f} ms, "
              f"{found.steps} steps, {whole:.1f} s in all, {os.cpu_count()} cores")


if __name__ == "__main__":
    rigid(sys.argv[1] if len(sys.argv) > 1 else HEAD)
    elastic()
    speed()
