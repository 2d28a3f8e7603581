# SPDX-License-Identifier: BSD-3-Clause
# Proves that brainshift.electrodes recognises a grid beside a strip, finds the tissue under its
# contacts at rest, bends a volume to them and leaves the rest; that BIDS tables say shapes; that
# saved files read back, also of electrodes without labels; that a surface is as good as a mask;
# that other world axes are doubted; and that errors name their cause.
import csv
import json

import numpy
from brainshift_testing import (assert_says, ball, load_plugin, messages, output, run_tests,
                                scratch, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402
from vtkmodules.vtkCommonCore import vtkStringArray  # noqa: E402

SIDE = 61
SPACING = 2.5  # mm
MIDDLE = (SIDE - 1) / 2 * SPACING
RADIUS = 60.0  # mm
TOP = numpy.array((MIDDLE, MIDDLE, MIDDLE + RADIUS))
PITCH = 10.0  # mm
ROWS, COLUMNS = 4, 5


def on_ball(steps):
    """The point of the brain that is at some mm along it from the top."""
    angle = numpy.linalg.norm(steps, axis=1) / RADIUS
    direction = steps / numpy.maximum(numpy.linalg.norm(steps, axis=1), 1e-9)[:, None]
    return MIDDLE + RADIUS * numpy.column_stack(
        (direction * numpy.sin(angle)[:, None], numpy.cos(angle)))


def sunk(points):
    away = numpy.minimum(1.0, numpy.linalg.norm(points - TOP, axis=1) / 55.0)
    return points - 7.0 * ((1 - away ** 2) ** 2)[:, None] * (0, 0, 1)


def grid():
    """Contacts at rest and as measured, with their labels."""
    steps = numpy.array([(PITCH * (column - 2), PITCH * (row - 1.5))
                         for row in range(ROWS) for column in range(COLUMNS)])
    rest = on_ball(steps)
    noise = numpy.random.default_rng(1).normal(0.0, 0.3, rest.shape)
    return rest, sunk(rest) + noise, [f"G{i + 1}" for i in range(len(rest))]


def strip():
    steps = numpy.array([(-70.0 + 10.0 * i, 0.5 * i ** 2) for i in range(4)])
    return on_ball(steps), [f"S{i + 1}" for i in range(4)]


def brain():
    return volume(ball(side=SIDE, radius=RADIUS / SPACING), spacing=(SPACING,) * 3)


def named(source, world):
    """The source, which says its world axes."""
    word = vtkStringArray()
    word.SetName("WorldAxes")
    word.InsertNextValue(world)
    output(source).GetFieldData().AddArray(word)
    source.MarkModified(source.SMProxy)
    source.UpdatePipeline()
    return source


def points_of(positions, labels):
    nothing = numpy.full(len(labels), numpy.nan)
    return brainshift.points.Points(positions, labels, nothing, nothing, nothing)


def assert_refused(call, words):
    try:
        call()
    except ValueError as error:
        assert_says(str(error), words)
    else:
        raise AssertionError(f"nothing was raised; {words!r} was expected")


def test_a_grid_is_found_fitted_and_saved():
    rest, measured, labels = grid()
    beside, names = strip()
    contacts = numpy.concatenate((numpy.delete(measured, 7, axis=0), beside))
    given = points_of(contacts, labels[:7] + labels[8:] + names)
    mask = brain()
    bent = simple.FreeFormDeformation(Input=mask)
    found = brainshift.electrodes(given, mask, deformation=bent, threshold=50, labels=mask)
    one, other = found.grids
    assert (one.name, one.kind, one.rows, one.columns, one.pitch) == ("G", "grid", 4, 5, 10.0), one
    assert one.missing == ["G8"] and list(found.missing) == ["G8"], one
    assert (other.name, other.kind, other.columns) == ("S", "strip", 4), other
    truth = numpy.delete(rest, 7, axis=0)
    error = numpy.linalg.norm(found.rest[:19] - truth, axis=1)
    left_out = numpy.linalg.norm(found.missing["G8"][1] - sunk(rest)[7])
    print(f"at rest {error.mean():.2f} mm (largest {error.max():.2f}), left out {left_out:.2f} mm")
    assert error.mean() < 1.5 and left_out < 1.0
    assert numpy.array_equal(found.rest[19:], beside), "a strip moved"
    assert not found.off.any() and numpy.isnan(found.floating[19:]).all()
    assert len(found.label) == 23 and float(found.label[0]) > 0.0, found.label
    assert "G grid 4 x 5" in repr(found), repr(found)
    moved = brainshift.deformed_from_rest(bent, found.rest[:19])
    misses = numpy.linalg.norm(moved - contacts[:19], axis=1)
    print(f"contacts to their tissue {misses.mean():.2f} mm")
    assert misses.mean() < 0.8
    far = MIDDLE + RADIUS * numpy.array(((0, 0, -1.0), (0.0, 0.8, -0.6), (-1.0, 0, 0)))
    moved = brainshift.deformed_from_rest(bent, far) - far
    still = numpy.abs((moved * (far - MIDDLE)).sum(axis=1))
    assert (still / RADIUS).max() < 0.5, still / RADIUS
    check_files(found)


def check_files(found):
    name = scratch("rest_electrodes.tsv")
    found.save(name)
    back = brainshift.read_points(name)
    assert back.labels == found.names
    assert numpy.abs(back.positions - found.rest).max() < 0.001
    with open(name, newline="") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    assert (rows[0]["group"], rows[0]["type"], rows[0]["dimension"]) == ("G", "grid", "[4x5]")
    with open(scratch("rest_coordsystem.json")) as file:
        assert json.load(file)["iEEGCoordinateUnits"] == "mm"
    for ending in ("rest.mrk.json", "rest.csv"):
        found.save(scratch(ending))
        back = brainshift.read_points(scratch(ending))
        assert back.labels == found.names
        assert numpy.abs(back.positions - found.rest).max() < 0.001
    assert_refused(lambda: found.save(scratch("rest.txt")), "must end in")


def test_a_contact_that_floats_is_named():
    _, measured, labels = grid()
    measured[7] += 5.0 * (measured[7] - MIDDLE) / numpy.linalg.norm(measured[7] - MIDDLE)
    found = brainshift.electrodes(points_of(measured, labels), brain(), threshold=50)
    assert list(numpy.nonzero(found.off)[0]) == [7], found.floating
    assert 3.5 < found.floating[7] < 6.5, found.floating[7]
    assert "G8" in found.warning and "above" in found.warning, found.warning
    used = numpy.delete(found.leave_one_out, 7).mean()
    assert found.leave_one_out.mean() > used + 0.1, (found.leave_one_out, used)
    assert f"leave-one-out error {used:.2f} mm (mean)" in repr(found), found


def test_bids_columns_give_the_shape():
    _, measured, _ = grid()
    name = scratch("sub-01_electrodes.tsv")
    # In UTF-8, with its mark, and in Latin-1.
    for encoding, letter in (("utf-8", "A"), ("utf-8-sig", "A"), ("latin-1", "\u00c4")):
        with open(name, "w", encoding=encoding) as file:
            file.write("name\tx\ty\tz\tsize\tgroup\ttype\tdimension\n")
            for i, (x, y, z) in enumerate(measured[:15]):
                file.write(f"{letter}{i + 1}\t{x}\t{y}\t{z}\t4\tfrontal\tgrid\t[4x5]\n")
        found = brainshift.electrodes(name, brain(), threshold=50)
        assert found.grids[0].name == "frontal" and found.grids[0].rows == 4, found.grids
        assert found.grids[0].missing == [f"{letter}{i}" for i in range(16, 21)], found.grids


def test_a_surface_is_as_good_as_a_mask():
    _, measured, labels = grid()
    sphere = simple.Sphere(Center=(MIDDLE,) * 3, Radius=RADIUS, ThetaResolution=120,
                           PhiResolution=120)
    given = points_of(measured, labels)
    by_surface = brainshift.electrodes(given, sphere)
    by_mask = brainshift.electrodes(given, brain(), threshold=50)
    assert numpy.linalg.norm(by_surface.rest - by_mask.rest, axis=1).max() < 1.0
    corners = numpy.array(((0, 0, 0), (150.0, 0, 0), (0, 150, 0), (0, 0, 150)))
    faces = numpy.array(((0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)))
    assert len(brainshift.electrodes(given, (corners, faces)).rest) == len(measured)


def test_steps_between_voxels_of_a_mask_do_not_count():
    rest, measured, labels = grid()
    steps = volume((ball(side=SIDE, radius=RADIUS / SPACING) >= 50).astype(numpy.uint8),
                   spacing=(SPACING,) * 3)
    found = brainshift.electrodes(points_of(measured, labels), steps)
    error = numpy.linalg.norm(found.rest - rest, axis=1)
    print(f"at rest {error.mean():.2f} mm (largest {error.max():.2f})")
    assert error.mean() < 1.0 and not found.off.any(), found


def test_electrodes_without_labels_are_kept_apart_in_files():
    rest, measured, _ = grid()
    turn = numpy.array(((1.0, 0, 0), (0, 0, -1.0), (0, 1.0, 0)))  # to the front of the ball
    corner = numpy.array([COLUMNS * row + column for row in range(3) for column in range(4)])
    beside = (rest[corner] - MIDDLE) @ turn.T + MIDDLE
    first = numpy.delete(measured, (7, 11), axis=0)
    ids = numpy.full((SIDE,) * 3, 182305713, numpy.int32)
    found = brainshift.electrodes(numpy.concatenate((first, beside)), brain(), threshold=50,
                                  labels=volume(ids, spacing=(SPACING,) * 3))
    assert [(one.rows, one.columns) for one in found.grids] == [(4, 5), (3, 4)], found.grids
    assert len(found.grids[0].missing) == 2 and len(found.missing) == 2, found.missing
    assert all(name.startswith("1-r") for name in found.missing), found.missing
    assert found.label[0] == "182305713", found.label[0]
    for name, key in (("none_electrodes.tsv", "group"), ("none.tsv", "electrode")):
        found.save(scratch(name))
        with open(scratch(name), newline="") as file:
            rows = list(csv.DictReader(file, delimiter="\t"))
        assert [row[key] for row in rows] == ["electrode1"] * 18 + ["electrode2"] * 12, rows
        if key == "group":
            assert (rows[0]["dimension"], rows[-1]["dimension"]) == ("[4x5]", "[3x4]")


def test_contacts_and_a_cortex_of_other_axes_are_doubted():
    _, measured, labels = grid()
    given, lps = points_of(measured, labels), named(brain(), "LPS")
    bent = simple.FreeFormDeformation(Input=lps)
    found = brainshift.electrodes(given, lps, deformation=bent, threshold=50)
    assert "the cortex are LPS, and those of the contacts are RAS" in found.warning, found.warning
    assert "LPS" in found.fit.warning, found.fit.warning
    same = brainshift.electrodes(given, named(brain(), "RAS"), threshold=50)
    assert "world axes" not in same.warning, same.warning
    bare = brainshift.electrodes(measured, lps, threshold=50)  # in the frame of the cortex
    assert "world axes" not in bare.warning, bare.warning
    assert_refused(lambda: bare.save(scratch("lps.csv")), "LPS")


def test_a_file_of_3d_slicer_names_the_axes_of_contacts():
    """Its comment does, beside a volume of other axes and in what comes out."""
    _, measured, labels = grid()
    for axes in ("RAS", "LPS"):
        name = scratch(f"contacts-{axes}.vtk")
        with open(name, "w", encoding="ascii") as file:
            file.write(f"# vtk DataFile Version 4.2\n3D Slicer output. SPACE={axes}\nASCII\n"
                       f"DATASET POLYDATA\nPOINTS {len(labels)} double\n")
            numpy.savetxt(file, measured)
        with messages() as said:
            found = simple.ElectrodeGrids(Input=simple.OpenDataFile(name),
                                          Cortex=named(brain(), "RAS"), Threshold=50)
            found.UpdatePipeline()
        warns = "the contacts (by the word SPACE in its file) are LPS" in said.text
        assert warns == (axes == "LPS"), said.text
        word = output(found).GetFieldData().GetAbstractArray("WorldAxes")
        assert word.GetValue(0) == axes, word


def test_errors_name_their_cause():
    _, measured, labels = grid()
    given, mask = points_of(measured, labels), brain()
    assert_refused(lambda: brainshift.electrodes(numpy.empty((0, 3)), mask), "no points")
    assert_refused(lambda: brainshift.electrodes(given, mask, shapes={"G": "round"}), "round")
    assert_refused(lambda: brainshift.electrodes(given, mask, threshold=900.0), "Threshold")
    wrong = (measured, numpy.array(((0, 1, 99),)))
    assert_refused(lambda: brainshift.electrodes(given, wrong), "99")
    nothing = points_of(measured[:3], ["A1", "B1", "C1"])
    bent = simple.FreeFormDeformation(Input=mask)
    assert_refused(lambda: brainshift.electrodes(nothing, mask, deformation=bent), "no contact")


run_tests(globals())
