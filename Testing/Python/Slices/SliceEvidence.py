# SPDX-License-Identifier: BSD-3-Clause
# Proves that Deformed Slices show how far the place of tissue can be believed: each pixel has the
# class of the fit's deviation where its tissue rests, for several lattices, kinds of voxels and
# strokes on top; that it costs nothing while it is off; that a state keeps it; and that a volume
# without evidence says so.
import numpy
from brainshift_testing import (assert_says, load_plugin, messages, output, picture, run_tests,
                                scratch)
from slices_testing import flat_view, show_slices

load_plugin()
import brainshift  # noqa: E402 after the plugin
from evidence_testing import (MIDDLE, check_classes, class_of_color,  # noqa: E402
                              deviation_by_hand, pulled, white)
from paraview import simple  # noqa: E402

SIZE = 200
CENTRE = (MIDDLE,) * 3


def sliced(bent, evidence=1, axis=2):
    view = flat_view(axis, CENTRE, 90.0, SIZE)
    planes = ("Sagittal", "Coronal", "Axial")[axis]
    display = show_slices(bent, view, (planes,), CENTRE)
    display.ShowEvidence = evidence
    return view, display


def below_legend(view):
    """The picture without the corner that holds the legend."""
    shown = picture(view)
    return shown[:SIZE // 2]


def test_classes_of_lattices_and_planes():
    for sides, axis in (((19, 19, 19), 2), ((9, 12, 21), 0), ((31, 7, 15), 1)):
        bent, fit = pulled(LatticeDimensions=sides)
        view, display = sliced(bent, axis=axis)
        check_classes(bent, fit, display, view, below_legend(view), 3)
        simple.Delete(view)


def test_labels_and_a_b_spline():
    bent, fit = pulled(white(labels=True), Kernel="B-Spline")
    view, display = sliced(bent)
    display.SliceInterpolation = "Nearest"
    check_classes(bent, fit, display, view, below_legend(view), 3)
    simple.Delete(view)


def test_strokes_are_no_evidence():
    bent, _ = pulled()
    before = brainshift_field(bent)
    bent.Strokes = brainshift.soft(CENTRE, (0, 0, 9), 30.0)
    after = brainshift_field(bent)
    displaced = numpy.linalg.norm(
        after["Displacement"] - before["Displacement"], axis=1)
    asked = numpy.hypot(before["Deviation"], displaced / numpy.sqrt(3))
    assert displaced.max() > 5.0
    assert numpy.allclose(after["Deviation"], asked, atol=1e-3)
    bent.Strength = 0.0  # nothing of the fit is drawn
    weak = brainshift_field(bent)
    asked = numpy.hypot(before["Deviation"],
                        numpy.linalg.norm(before["Displacement"], axis=1) / numpy.sqrt(3))
    assert numpy.allclose(weak["Deviation"], asked, atol=1e-3)


def brainshift_field(bent):
    """The arrays of a forward field at the control points."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    field = simple.DeformationField(Input=bent, Direction="Forward",
                                    SampleGrid="Given Dimensions",
                                    Dimensions=list(bent.LatticeDimensions))
    data = output(field).GetPointData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).copy()
              for i in range(data.GetNumberOfArrays())}
    simple.Delete(field)
    return arrays


def test_deformation_field_has_the_fits_deviations():
    bent, fit = pulled()
    nodes = numpy.stack(numpy.meshgrid(*(numpy.linspace(0, 2 * MIDDLE, 19),) * 3,
                                       indexing="ij"), axis=-1).transpose(2, 1, 0, 3).reshape(-1, 3)
    given = brainshift_field(bent)["Deviation"]
    assert numpy.allclose(given, fit.deviation(nodes), atol=1e-4)
    # Backward: at a deformed point, that of the tissue there.
    field = simple.DeformationField(Input=bent, SampleGrid="Given Dimensions",
                                    Dimensions=[7, 8, 9])
    from vtkmodules.util.numpy_support import vtk_to_numpy
    image = output(field)
    points = numpy.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
    asked = deviation_by_hand(bent, fit, brainshift.rest_from_deformed(bent, points))
    given = vtk_to_numpy(image.GetPointData().GetArray("Deviation"))
    assert numpy.allclose(given, asked, atol=1e-3), numpy.abs(given - asked).max()


def test_nothing_measured_is_infinite_and_no_number_is_lost():
    bent = simple.FreeFormDeformation(Input=white())
    brainshift.fit(bent).filter.Evidence = 1
    given = brainshift_field(bent)["Deviation"]
    assert numpy.isinf(given).all()
    view, display = sliced(bent)
    shown = below_legend(view)[20:-20, 20:-20].reshape(-1, 3)
    assert {class_of_color(*color) for color in shown} == {3}
    simple.Delete(view)


def test_off_costs_nothing_and_draws_as_before():
    bent, fit = pulled()
    fit.filter.Evidence = 0
    view, display = sliced(bent, evidence=0)
    without = picture(view)
    counted = brainshift.counters(display)
    fit.filter.Evidence = 1
    assert (picture(view) == without).all()
    now = brainshift.counters(display)
    assert now["evidenceUploads"] == 0
    display.ShowEvidence = 1
    assert (picture(view) != without).any()
    assert brainshift.counters(display)["evidenceUploads"] == 1
    display.SlicePosition = [MIDDLE + 1.0] * 3
    picture(view)
    assert brainshift.counters(display)["evidenceUploads"] == 1  # not for each picture
    display.SlicePosition = CENTRE
    display.ShowEvidence = 0
    assert (picture(view) == without).all()
    assert now["programsCompiled"] == counted["programsCompiled"]
    simple.Delete(view)


def test_without_evidence_one_sentence_says_so():
    bent = simple.FreeFormDeformation(Input=white())
    view, display = sliced(bent)
    with messages() as told:
        plain = below_legend(view)
    assert_says(told.text, "Show Evidence", "Evidence on", "Lattice Dimensions")
    assert {class_of_color(*color) for color in plain[20:, 20:-20].reshape(-1, 3)} == {0}
    simple.Delete(view)


def test_two_views_say_it_once():
    bent = simple.FreeFormDeformation(Input=white())
    with messages() as told:
        views = [sliced(bent)[0] for _ in range(3)]
        for view in views:
            picture(view)
    assert told.text.count("Show Evidence is on") == 1, told.text
    with messages() as told:
        another = sliced(simple.FreeFormDeformation(Input=white()))[0]
        picture(another)
    assert told.text.count("Show Evidence is on") == 1, "another volume"
    for view in (*views, another):
        simple.Delete(view)


def test_another_lattice_takes_no_evidence():
    bent, fit = pulled()
    bent.LatticeDimensions = [21, 19, 19]
    assert "Deviation" not in brainshift_field(bent)


def test_a_state_keeps_it():
    bent, _ = pulled(simple.Wavelet())
    view, display = sliced(bent)
    display.SlicePosition = (0, 0, 0)
    before = picture(view)
    simple.SaveState(scratch("evidence.pvsm"))
    simple.Delete(view)
    simple.LoadState(scratch("evidence.pvsm"))
    view = simple.GetViews()[-1]
    display = next(shown for shown in view.Representations
                   if getattr(shown, "Representation", None) == "Deformed Slices")
    assert display.ShowEvidence == 1
    assert display.Input.Lattice.Evidence == 1
    assert numpy.abs(picture(view) - before).max() < 0.02


run_tests(globals())
