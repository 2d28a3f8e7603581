# SPDX-License-Identifier: BSD-3-Clause
# Proves that Deformed Volume shows how far the place of tissue can be believed: the first hits of a
# picture have the class of the fit's deviation where they rest, in a comparison by
# stripes; that a fit that changes is shown anew; that off is as
# before; and that other blend modes say that they show none.
import numpy
from brainshift_testing import (assert_says, load_plugin, messages, picture, run_tests, show_volume,
                                view_along)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from evidence_testing import MIDDLE, check_classes, pulled, white  # noqa: E402
from paraview import simple  # noqa: E402

SIZE = 240
COLORS = [0, 1, 1, 1, 100, 1, 1, 1]
OPAQUE = [0, 1, 0.5, 0, 100, 1, 0.5, 0]
COMPOSITE, MAXIMUM = 0, 1
AT_CORNER = {"low": -80.0, "high": -40.0}  # which the view shows


def seen(bent, evidence=1, mode=COMPOSITE):
    view = view_along((0.5, 0.35, 0.8), (MIDDLE,) * 3, 500.0, half_height=120.0, size=SIZE)
    display = show_volume(bent, view, "Deformed Volume", COLORS, OPAQUE)
    display.BlendMode = mode
    display.SampleDistance = 0.2  # mm: a hit lies within a step of what gave it its colour
    display.ShowEvidence = evidence
    return view, display


def half(view):
    """The picture without the corner that holds the legend."""
    return picture(view)[:SIZE // 2 + 10]


def test_first_hits_have_their_classes():
    for sides in ((19, 19, 19), (8, 14, 25)):
        bent, fit = pulled(**AT_CORNER, LatticeDimensions=sides)
        view, display = seen(bent)
        check_classes(bent, fit, display, view, half(view), 3, step=4)
        simple.Delete(view)


def test_a_fit_that_changes_is_shown_anew():
    bent, fit = pulled(**AT_CORNER)
    view, display = seen(bent)
    before = half(view)
    display.KeepPicture = 1
    fit.filter.Pulls = list(fit.filter.Pulls)[:21]  # fewer: less is known
    after = half(view)
    assert (before != after).any()
    check_classes(bent, fit, display, view, after, 2, step=4)
    simple.Delete(view)


def test_off_is_as_before():
    bent, fit = pulled(**AT_CORNER)
    fit.filter.Evidence = 0
    view, display = seen(bent, evidence=0)
    without = picture(view)
    fit.filter.Evidence = 1
    assert (picture(view) == without).all()
    assert brainshift.counters(display)["evidenceUploads"] == 0
    display.ShowEvidence = 1
    assert (picture(view) != without).any()
    assert brainshift.counters(display)["evidenceUploads"] == 1
    display.ShowEvidence = 0
    assert (picture(view) == without).all()
    simple.Delete(view)


def test_other_modes_say_that_they_show_none():
    bent, _ = pulled(**AT_CORNER)
    view, display = seen(bent, evidence=0, mode=MAXIMUM)
    without = half(view)
    display.ShowEvidence = 1
    with messages() as told:
        shown = half(view)
    assert_says(told.text, "Show Evidence", "Composite")
    assert (shown == without).all()
    simple.Delete(view)


def test_a_comparison_shows_stripes():
    bent, _ = pulled(**AT_CORNER)
    both = simple.CompareVolumes(Input=bent, Reference=white())
    view, display = seen(both, evidence=0)
    display.ShowEvidence = 0
    without = half(view)
    display.ShowEvidence = 1
    striped = half(view)
    darker = (striped < without - 0.02).any(axis=2)
    assert 0.05 < darker.mean() < 0.6, darker.mean()
    assert (striped <= without + 0.01).all()  # no hue: colours tell the volumes apart
    simple.Delete(view)


run_tests(globals())
