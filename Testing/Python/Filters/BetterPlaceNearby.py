# SPDX-License-Identifier: BSD-3-Clause
# Proves that refine by ultrasound, which ends at a wrong place, goes on from a better one that its
# checks find, and ends at the right one. And that it calls a place good that no other comes near.
import numpy
from brainshift_testing import load_plugin, run_tests, volume

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

SPACING = 1.5  # mm, of the volume
MIDDLE = numpy.array([53.0, 42.0, 55.0])  # of the fan
FAN = 22.0  # mm, radius
FAN_SPACING = 0.8
FAN_SIDE = 58
GRAIN = (2, 3)  # axes across the beam, along which grains are longer


def waves():
    """Wave vectors (1/mm) and phases of folds that are 9 to 16 mm wide and repeat nowhere."""
    random = numpy.random.default_rng(5)
    for direction in random.normal(size=(9, 3)):
        length = random.uniform(9, 16)
        yield (2 * numpy.pi / length * direction / numpy.linalg.norm(direction),
               random.uniform(0, 6.28))


def folds(x, y, z):
    return 100 + 18 * sum(numpy.sin(k[0] * x + k[1] * y + k[2] * z + phase)
                          for k, phase in waves())


def places(side, spacing, origin):
    k, j, i = numpy.indices((side,) * 3)
    return [start + spacing * index for start, index in zip(origin, (i, j, k))]


def echo(x, y, z):
    """Dark tissue echoes most, and borders across the beam do."""
    value = folds(x, y, z)
    border = abs(folds(x, y, z + 0.7) - folds(x, y, z - 0.7))
    return numpy.where(value > 140, 0.05, 0.3) + 1.2 / (1 + numpy.exp((value - 80) / 5)) + \
        0.01 * border


def sweep(shift):
    """Speckle of the echoes within a ball, darker in the depth; `shift` (mm) from its place."""
    origin = MIDDLE - FAN_SPACING * (FAN_SIDE - 1) / 2
    x, y, z = places(FAN_SIDE, FAN_SPACING, origin)
    parts = numpy.random.default_rng(1).normal(size=(2,) + (FAN_SIDE,) * 3)
    for axis in GRAIN:
        parts = parts + numpy.roll(parts, 1, axis) + numpy.roll(parts, -1, axis)
    power = (parts ** 2).sum(0) / 18 * (echo(x, y, z) * numpy.exp((MIDDLE[2] - z) / 60)) ** 2
    away = (x - MIDDLE[0]) ** 2 + (y - MIDDLE[1]) ** 2 + (z - MIDDLE[2]) ** 2
    values = numpy.where(away < FAN ** 2, numpy.maximum(1, 200 + 20 * numpy.log10(power)), 0)
    return volume(values.astype(numpy.float32), spacing=(FAN_SPACING,) * 3,
                  origin=tuple(origin + shift))


def refined(shift):
    """How far (mm) tissue in the fan ends from its place, what was found, and the numbers of steps
    that the callback was told."""
    rest = volume(folds(*places(64, SPACING, (0, 0, 0))).astype(numpy.float32),
                  spacing=(SPACING,) * 3)
    bent = simple.FreeFormDeformation(Input=rest)
    told = []

    def note(progress):
        told.append(progress.steps)
    found = brainshift.refine(bent, sweep(shift), similarity="ultrasound", callback=note)
    points = MIDDLE + 10 * (numpy.indices((3, 3, 3)).reshape(3, -1).T - 1.0)
    ends = brainshift.deformed_from_rest(bent, points)
    return numpy.linalg.norm(ends - points - shift, axis=1).mean(), found, told


def test_it_goes_on_from_a_better_place():
    for shift in ((0, -5, -5), (3, -6, -5)):  # from both it ends 10.7 mm off at first
        off, found, told = refined(numpy.array(shift, float))
        print(f"  from {shift}: {off:.2f} mm off, {found.steps} steps, {found.trust}")
        assert off < 0.5 and found.trust == "good" and not found.warnings, (off, found)
        assert found.finished and told == sorted(told), told


def test_what_is_right_is_kept():
    off, found, _ = refined(numpy.array([4.0, 0.0, 0.0]))
    assert off < 0.3 and found.trust == "good", (off, found)


run_tests(globals())
