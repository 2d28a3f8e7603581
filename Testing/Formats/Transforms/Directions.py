# SPDX-License-Identifier: BSD-3-Clause
# Proves that `direction` says which way a file leads: the map and its inverse by numbers that are
# known, what the file says of itself, and a field that says that it leads forward.
import numpy
from brainshift_testing import ball, load_plugin, run_tests, scratch, volume
from outside_testing import itk_text, write

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import FreeFormDeformation  # noqa: E402

SHIFT = (3.0, -8.0, 5.5)  # LPS
AFFINE = ("AffineTransform", (*numpy.eye(3).ravel(), *SHIFT), (0, 0, 0))


def test_an_affine_map_of_itk():
    name = write("shift.tfm", itk_text(AFFINE))
    points = numpy.array(((1.0, 2.0, 3.0), (-4.0, 5.0, 6.0)))
    found = brainshift.direction(name, points=points)
    assert found.kind == "rigid" and found.closure < 1e-9
    assert numpy.allclose(found.moving, points + (-3.0, 8.0, 5.5))
    text = str(found)
    for words in ("shift.tfm holds a transform of ITK", "fixed image to the moving one, as stored",
                  "(1.00, 2.00, 3.00) mm goes to (-2.00, 10.00, 8.50) mm", "ANTs:", "FSL:", "SPM:",
                  "Slicer:", "direction=\"backward\""):
        assert words in text, (words, text)


def test_files_that_are_turned_round_say_so():
    lta = ("type = 1\nnxforms = 1\n1 4 4\n1 0 0 3\n0 1 0 -8\n0 0 1 5.5\n0 0 0 1\n"
           "src volume info\nvalid = 0\ndst volume info\nvalid = 0\n")
    xfm = ("MNI Transform File\n\nTransform_Type = Linear;\n"
           "Linear_Transform =\n1 0 0 3\n0 1 0 -8\n0 0 1 5.5;\n")
    for name, text, words in (("turned.lta", lta, "its src is the moving image"),
                              ("turned.xfm", xfm, "from its source, the moving image")):
        found = brainshift.direction(write(name, text), points=[(0.0, 0.0, 0.0)])
        assert numpy.allclose(found.moving, [(-3.0, 8.0, -5.5)]), found.moving
        assert words in str(found) and "inverts it" in str(found), str(found)


def test_both_fields_of_a_deformation_lead_the_same_way():
    """A field that says forward is turned round, so both take the picture to the tissue."""
    bent = FreeFormDeformation(Input=volume(ball()), Strokes=brainshift.stamp(
        (16, 16, 16), (16, 16, 0), 3.0, major=14.0, minor=10.0))
    points = numpy.random.default_rng(2).uniform(8, 24, (50, 3))
    right = brainshift.rest_from_deformed(bent, points)
    assert numpy.abs(right - points).max() > 1.0
    for way in ("forward", "backward"):
        name = scratch(way + ".nii.gz")
        brainshift.save_field(bent, name, direction=way.capitalize())
        found = brainshift.direction(name, points=points)
        assert numpy.abs(found.moving - right).max() < 0.1, way
        assert found.closure < 0.01 and f"says that it is a {way} one" in str(found), str(found)
    of_own_points = brainshift.direction(name)
    assert len(of_own_points.fixed) == 343 and of_own_points.fixed.min() > 0.0
    assert of_own_points.closure < 0.01, of_own_points.closure


run_tests(globals())
