# SPDX-License-Identifier: BSD-3-Clause
# Proves that a picture survives values that a filter refuses, and follows the filter again as soon
# as the values are valid, also after several refusals in turn.
import numpy
from brainshift_testing import (ball, load_plugin, messages, picture, run_tests, show_volume,
                                view_along, volume)
from slices_testing import show_slices

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    CompareVolumes, FreeFormDeformation, PolyPointSource, Show, TraceDistance)

MIDDLE = (16.0, 16.0, 16.0)
STROKES = brainshift.soft(MIDDLE, (3, -2, 1.5), 14.0)
SIZE = 120


def bent():
    return FreeFormDeformation(Input=volume(ball()), Strokes=STROKES)


def flat_view():
    return view_along((0, 0, -1), MIDDLE, 200.0, half_height=20.0, size=SIZE)


def show_as_slices(source, view):
    show_slices(source, view, ("Axial",), MIDDLE)


def show_as_volume(source, view):
    show_volume(source, view, "Deformed Volume", [0, 0, 0, 0, 100, 1, 1, 1],
                [0, 0, 0.5, 0, 100, 0.5, 0.5, 0])


def show_as_points(source, view):
    Show(source, view, "GeometryRepresentation").SetRepresentationType("Trace Points")


def pictures_of(view, proxy, changes):
    """One picture after each change of a property, and what was said meanwhile."""
    drawn = []
    with messages() as said:
        for name, value in changes:
            setattr(proxy, name, value)
            drawn.append(picture(view))
    return drawn, said.text


def test_comparison():
    mask = volume((ball(radius=5.0) > 50).astype(numpy.uint8))
    wrong = (("Show", "Reference"), ("ReferenceRotation", [-1e308, 1.0, 1e308]),
             ("Cavity", mask), ("CavityLabels", [100]))
    right = (("Show", "Both"), ("ReferenceRotation", [0.0, 0.0, 0.0]), ("Cavity", None),
             ("CavityLabels", []))
    reference = volume(ball(radius=7.0, center=(18, 16, 15)))
    for show in (show_as_slices, show_as_volume):
        compared, view = CompareVolumes(Input=bent(), Reference=reference), flat_view()
        show(compared, view)
        first = picture(view)
        drawn, said = pictures_of(view, compared, wrong)
        assert "CavityLabels" in said, said
        assert (drawn[-1] == drawn[-2]).all(), "the picture before the refusal stays"
        drawn, _ = pictures_of(view, compared, right)
        assert (drawn[-1] == first).all(), f"{(drawn[-1] != first).any(axis=2).sum()} pixels"
        drawn, _ = pictures_of(view, compared, [("Show", "Reference")])
        assert (drawn[-1] != first).any(), "later changes are drawn, too"


def test_traced_points():
    points = PolyPointSource(Points=[16, 16, 30, 8, 12, 28])
    trace, view = TraceDistance(Input=points, Deformation=bent(), Threshold=50.0), flat_view()
    show_as_points(trace, view)
    first = picture(view)
    assert (first.max(axis=2) > 0.02).any(), "points to compare"
    _, said = pictures_of(view, trace, [("Threshold", 1e6), ("Threshold", 2e6)])
    assert "gives no surface" in said, said
    _, said = pictures_of(view, trace, [("Threshold", 3e6), ("Threshold", 50.0)])
    assert "gives no surface" in said, said
    points.Points = [20, 20, 30, 12, 22, 28]
    assert (picture(view) != first).any(), "the points are drawn where they are now"


run_tests(globals())
