# SPDX-License-Identifier: BSD-3-Clause
"""Proves that brainshift.look shows tissue without the background, aims the camera so that tissue
fills views of any shape, follows a segmentation, and names what is wrong."""

import numpy
from brainshift_testing import ball, data, load_plugin, picture, run_tests, volume

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

HEAD = data("seg3d-utah", "seg3d_mr_t1.nii.gz")
MASK = data("seg3d-utah", "seg3d_brainmask.nii.gz")


def shown(size, **inputs):
    """The head in a view of this size."""
    reader = simple.NIFTIVolumeReader(FileName=HEAD)
    bent = simple.FreeFormDeformation(Input=reader, **inputs)
    view = simple.CreateView("RenderView")
    view.ViewSize = size
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [0.0, 0.0, 0.0]
    display = simple.Show(bent, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Volume")
    return bent, display, view


def filled(view):
    """Which part of the view's height and width tissue takes."""
    tissue = picture(view).sum(axis=2) > 0.05
    return tissue.any(axis=1).mean(), tissue.any(axis=0).mean()


def roughness(pixels):
    """Mean difference of neighbours in the middle of the picture."""
    middle = pixels[150:250, 150:250]
    return numpy.abs(numpy.diff(middle, axis=0)).mean()


def test_tissue_fills_views_of_any_shape():
    for size in ((400, 400), (700, 300), (300, 600)):
        _, display, view = shown(size)
        assert brainshift.look(display, view=view) == "Skin"
        display.SetScalarBarVisibility(view, False)
        for parallel in (0, 1):
            view.CameraParallelProjection = parallel
            assert 0.8 < max(filled(view)) < 1.0, (size, parallel, filled(view))
        simple.Delete(view)


def test_a_brain_is_drawn_alone_and_large():
    _, display, view = shown((400, 400), Segmentation=simple.NIFTIVolumeReader(FileName=MASK))
    assert brainshift.looks(display) == ["Skin", "Brain", "See-through"]
    display.SetScalarBarVisibility(view, False)
    brainshift.look(display, "Skin", view)
    head = picture(view)
    brainshift.look(display, "Brain", view)
    assert display.DrawSegment == 1
    assert 0.8 < max(filled(view)) < 1.0, filled(view)
    brain = picture(view)
    assert roughness(brain) > 2.0 * roughness(head), "gyri are rougher than skin"
    brainshift.look(display, "Skin")
    assert display.DrawSegment == 0
    simple.Delete(view)


def test_what_is_wrong_is_named():
    _, display, view = shown((300, 300))
    brainshift.look(display)
    for name, words in (("Bone", ("Bone", "Skin, See-through")), ("Brain", ("Brain",))):
        before = list(display.ScalarOpacityFunction.Points)
        try:
            brainshift.look(display, name)
        except ValueError as error:
            assert all(word in str(error) for word in words), error
        else:
            raise AssertionError(f"{name} was taken")
        assert list(display.ScalarOpacityFunction.Points) == before
    labels = volume(numpy.round(ball() / 50.0))
    of_labels = simple.Show(labels, view, "UniformGridRepresentation")
    of_labels.SetRepresentationType("Deformed Volume")
    assert brainshift.looks(of_labels) == []
    try:
        brainshift.look(of_labels)
    except ValueError as error:
        assert "none" in str(error), error
    else:
        raise AssertionError("labels have a look")


run_tests(globals())
