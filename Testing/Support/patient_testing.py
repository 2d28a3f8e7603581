# SPDX-License-Identifier: BSD-3-Clause
"""The files of a synthetic patient: a brain that sank under its opening, with a tumour and a
cavity."""

import csv
import os
import shutil

import brainshift
import numpy
from brainshift_testing import assert_says, ball, volume
from paraview import simple

SIDE, SPACING = 41, 4.0  # voxels; mm
MIDDLE = (SIDE - 1) / 2 * SPACING
RADIUS = 60.0  # mm
SAG = 6.0  # mm
TOP = (MIDDLE, MIDDLE, MIDDLE + RADIUS)


def refused(words, function):
    """Runs a function that must raise a ValueError which says the words."""
    try:
        function()
    except ValueError as error:
        assert_says(str(error), *words)
    else:
        raise AssertionError(f"nothing was refused that should say {words}")


def table(file, header, rows):
    """Writes a table."""
    with open(file, "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([header, *rows])


def sunk(points):
    """Where points of the brain are after it sank."""
    away = numpy.minimum(1.0, numpy.linalg.norm(points - TOP, axis=1) / 50.0)
    return points - SAG * ((1 - away ** 2) ** 2)[:, None] * (0, 0, 1)


def cap(count, angle=0.45):
    """Points of the cortex under the opening."""
    random = numpy.random.default_rng(1)
    down = numpy.cos(angle * numpy.sqrt(random.uniform(0, 1, count)))
    turn = random.uniform(0, 2 * numpy.pi, count)
    flat = numpy.sqrt(1 - down ** 2)
    return MIDDLE + RADIUS * numpy.stack(
        (flat * numpy.cos(turn), flat * numpy.sin(turn), down), axis=1)


def save(file, voxels):
    """Writes a volume of the patient's grid."""
    source = volume(voxels, spacing=(SPACING,) * 3)
    brainshift.save_volume(source, file, world="RAS")
    simple.Delete(source)


def make_patient(folder):
    """Writes a patient's files, as they come, into a new folder."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)

    def path(name):
        return os.path.join(folder, name)
    head = ball(side=SIDE, radius=RADIUS / SPACING)
    noise = numpy.random.default_rng(0).normal(0, 3.0, head.shape).astype(numpy.float32)
    save(path("sub-1_T1w.nii.gz"), head + noise)
    save(path("sub-1_postop.nii.gz"), head + noise)
    save(path("sub-1_brainmask.nii.gz"), (head > 50).astype(numpy.uint8))
    at = (SIDE - 1) / 2
    save(path("sub-1_Tumor.nii.gz"), (ball(SIDE, 3.0, (at, at, at + 8)) > 50).astype(numpy.uint8))
    save(path("cavity.nii.gz"), (ball(SIDE, 2.5, (at + 1, at, at + 7)) > 50).astype(numpy.uint8))
    table(path("pointer.csv"), "xyz", sunk(cap(150)).tolist())
    rest = MIDDLE + numpy.random.default_rng(2).uniform(-25, 25, (8, 3)) + (0, 0, 15)
    columns = [f"{axis}_{when}" for when in ("rest", "measured") for axis in "xyz"]
    table(path("targets.csv"), ["name", *columns],
          [[f"L{i}", *a, *b] for i, (a, b) in enumerate(zip(rest.tolist(), sunk(rest).tolist()))])
    with open(path("ecog_contacts.tsv"), "w", encoding="utf-8") as file:
        file.write("name\tx\ty\tz\n" + "".join(
            f"C{i}\t{x}\t{y}\t{z}\n" for i, (x, y, z) in enumerate(sunk(cap(12, 0.2)))))
    with open(path("notes.txt"), "w", encoding="utf-8") as file:
        file.write("nothing\n")
