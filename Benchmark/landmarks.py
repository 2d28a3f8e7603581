# SPDX-License-Identifier: BSD-3-Clause
"""How well a fit puts landmarks that it was not given: leave-one-out on files of landmark pairs.

    ./brainshift python Benchmark/landmarks.py FOLDER

Each MNI tag file of two volumes (`.tag`) in the folder is a case. One pair after the other is left
out, the others are fitted by Fit Deformation, and the error at the pair is its target registration
error. A rigid fit and a thin-plate spline of the same pairs stand beside it. The ball of 95 %
around the fitted point holds the measured one in as many cases as the last column says.

The RESECT data (Xiao et al. 2017, doi:10.1002/mp.12268, CC BY 4.0) have such files.
"""

import pathlib
import sys

import numpy
from paraview import simple

simple.LoadDistributedPlugin("BrainShift", ns=globals())

import brainshift  # noqa: E402 (after the plugin)

LANDMARK_DEVIATION = 0.7  # mm along each axis, the default of a landmark
BALL = 2.7955  # deviations that hold 95 % of a normal distribution in space
MARGIN = 20  # mm around the landmarks


def rigid(rest, measured):
    """The map with the least squared distances among rotations with a shift."""
    middle, there = rest.mean(0), measured.mean(0)
    left, _, right = numpy.linalg.svd((rest - middle).T @ (measured - there))
    sign = numpy.diag([1.0, 1.0, numpy.sign(numpy.linalg.det(left @ right))])
    turn = left @ sign @ right
    return lambda points: (points - middle) @ turn + there


def thin_plate(rest, measured):
    """The interpolating spline of least bending energy in space."""
    def distances(points):
        return numpy.linalg.norm(points[:, None] - rest[None], axis=2)

    def affine(points):
        return numpy.hstack([numpy.ones((len(points), 1)), points])
    count = len(rest)
    matrix = numpy.zeros((count + 4, count + 4))
    matrix[:count, :count] = distances(rest)
    matrix[:count, count:] = affine(rest)
    matrix[count:, :count] = affine(rest).T
    weights = numpy.linalg.solve(matrix, numpy.vstack([measured, numpy.zeros((4, 3))]))
    return lambda points: numpy.hstack([distances(points), affine(points)]) @ weights


def volume_around(points):
    """A Free-Form Deformation of a volume that holds the points."""
    low = numpy.floor(points.min(0) - MARGIN).astype(int)
    high = numpy.ceil(points.max(0) + MARGIN).astype(int)
    box = simple.Wavelet(WholeExtent=[int(x) for pair in zip(low, high) for x in pair])
    return simple.FreeFormDeformation(Input=box)


def case(name):
    """Errors (mm) of the fit, rigid and spline at each pair of a file, and which balls held."""
    rest = brainshift.read_points(name, volume=1).positions
    measured = brainshift.read_points(name, volume=2).positions
    bent = volume_around(rest)
    errors, held = [], []
    for i in range(len(rest)):
        others = numpy.arange(len(rest)) != i
        pairs = rest[others], measured[others]
        fit = brainshift.fit(bent, rest=pairs[0], measured=pairs[1])
        left_out = rest[i:i + 1]
        errors.append([numpy.linalg.norm(found(left_out)[0] - measured[i]) for found in
                       (fit.measured_from_rest, rigid(*pairs), thin_plate(*pairs))])
        deviation = numpy.hypot(fit.deviation(left_out)[0], fit.calibration * LANDMARK_DEVIATION)
        held.append(errors[-1][0] <= BALL * deviation)
    whole = brainshift.fit(bent, rest=rest, measured=measured)
    closed = float(numpy.mean(whole.leave_one_out))
    return numpy.array(errors), numpy.array(held), closed


def main(folder):
    names = sorted(pathlib.Path(folder).glob("*.tag"))
    if not names:
        sys.exit(f"{folder} has no .tag files")
    means, held = [], []
    print("case                           pairs   fit  rigid  spline  closed form  in the ball")
    for name in names:
        errors, balls, closed = case(str(name))
        means.append(errors.mean(0))
        held += list(balls)
        fit, stiff, spline = means[-1]
        print(f"{name.stem:30} {len(errors):5} {fit:5.2f} {stiff:6.2f} {spline:7.2f} "
              f"{closed:12.2f} {100 * balls.mean():10.0f} %")
    fit, stiff, spline = numpy.mean(means, axis=0)
    print(f"{'mean (mm)':30} {len(held):5} {fit:5.3f} {stiff:6.3f} {spline:7.3f} "
          f"{'':12} {100 * numpy.mean(held):10.1f} %")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
