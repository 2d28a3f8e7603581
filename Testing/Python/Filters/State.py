# SPDX-License-Identifier: BSD-3-Clause
# Proves that a state file, in XML or Python, brings back the same strokes, the same fit, what no
# widget shows, and the same picture to the bit.
import numpy
from brainshift_testing import load_plugin, picture, run_tests, scratch, show_volume, view_along
from paraview import simple, smstate

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.reports import numbers  # noqa: E402

STROKES = (brainshift.stamp((3, 2, 8), (0, 0, 0), 4.0, major=12.0, minor=9.0)
           + brainshift.move((-5, 1, 6), (0.25, -1.5, 2.0))
           + brainshift.soft((0, -6, 4), (1.0, 1.0, 1.0 / 3.0), 7.0))
COLORS = [40, 0, 0, 0.2, 150, 0.9, 0.5, 0.3, 280, 1, 1, 1]
FACTORS = [0, 0.5, 20, 1]
OPACITIES = [40, 0, 0.5, 0, 120, 0, 0.5, 0, 280, 0.7, 0.5, 0]


def make_scene():
    filter = simple.FreeFormDeformation(registrationName="Bent", Input=simple.Wavelet())
    filter.LatticeDimensions = [11, 12, 13]
    filter.Strokes = STROKES
    filter.PointOfInterest = [1.5, -2.25, 3.0]
    filter.Strength = 0.75
    filter.Kernel = "B-Spline"
    view = view_along((0.3, -0.4, -1), (0, 0, 0), 60)
    # A unit of 1.0 would be missing in the Python state. ParaView writes no value that equals the
    # default in the XML, although Show then sets another value.
    display = show_volume(filter, view, "Deformed Volume", COLORS, OPACITIES, array="RTData",
                          shade=True, unit=1.5)
    display.GradientOpacity = FACTORS
    return view


def expect_scene(before, load):
    """Loading brings back what was drawn before."""
    simple.ResetSession()
    load_plugin()
    load()
    filter = simple.FindSource("Bent")
    assert filter is not None
    assert tuple(filter.Strokes) == STROKES, tuple(filter.Strokes)
    assert tuple(filter.PointOfInterest) == (1.5, -2.25, 3.0), tuple(filter.PointOfInterest)
    assert tuple(filter.LatticeDimensions) == (11, 12, 13)
    assert filter.Strength == 0.75
    assert filter.Kernel == "B-Spline"
    view = simple.GetActiveViewOrCreate("RenderView")
    assert list(simple.GetDisplayProperties(filter, view).GradientOpacity) == FACTORS
    after = picture(view)
    assert simple.GetDisplayProperties(filter, view).Representation == "Deformed Volume"
    assert after.shape == before.shape, (after.shape, before.shape)
    assert numpy.array_equal(after, before), f"{(after != before).any(axis=2).sum()} pixels differ"


def drawn_scene():
    simple.ResetSession()
    load_plugin()
    view = make_scene()
    before = picture(view)
    assert (before.max(axis=2) > 0.02).mean() > 0.1, "nothing to compare"
    return before


def test_state_file():
    before = drawn_scene()
    name = scratch("State.pvsm")
    simple.SaveState(name)
    expect_scene(before, lambda: simple.LoadState(name))


def test_python_state_file():
    before = drawn_scene()
    name = scratch("State-saved.py")
    with open(name, "w", encoding="utf-8") as file:
        file.write(smstate.get_state())  # what the desktop application saves as .py
    with open(name, encoding="utf-8") as file:
        script = compile(file.read(), name, "exec")
    expect_scene(before, lambda: exec(script, {"__name__": "state"}))


PULLS = [(0, 0, 4), (1, 0, 6.5)], [(4, 0, 0), (4, 3, 0)]


def fitted_scene():
    """Where points lie under a fit with a stroke on top, and what the fit says."""
    bent, probe = simple.FindSource("Fitted"), [(0, 0, 4), (2, -3, 1), (-6, 5, 2)]
    fit = bent.Lattice
    fit.UpdatePipeline()
    fit.SMProxy.UpdatePropertyInformation()
    return (numpy.array(brainshift.deformed_from_rest(bent, probe)),
            numpy.array(numbers(fit.SMProxy, "PullResiduals")), list(fit.Pins))


def test_a_fit_comes_back():
    for ending in ("pvsm", "py"):
        simple.ResetSession()
        load_plugin()
        bent = simple.FreeFormDeformation(registrationName="Fitted", Input=simple.Wavelet())
        brainshift.fit(bent, pulls=PULLS, pins=[(-6, 0, 0)])
        bent.Strokes = STROKES
        before = fitted_scene()
        name = scratch("Fitted." + ending)
        script = smstate.get_state()
        simple.SaveState(name)
        simple.ResetSession()
        load_plugin()
        if ending == "pvsm":
            simple.LoadState(name)
        else:
            exec(compile(script, name, "exec"), {"__name__": "state"})
        for found, expected in zip(fitted_scene(), before):
            assert len(expected) and numpy.array_equal(found, expected), (ending, found, expected)


def without_widget():
    """Values of properties that no widget shows, by registered name and property."""
    return {
        ("refined", "ControlPoints"): [0.25 * i for i in range(4 * 4 * 5 * 3)],
        ("fit", "RestNames"): ["b", "a, \"c\""], ("fit", "MeasuredNames"): ["a", "b"],
        ("fit", "LandmarksOff"): ["b"], ("fit", "PointAxes"): "RAS",
        ("grids", "ContactNames"): ["G1", "G2"], ("grids", "ContactGroups"): ["G", "G"],
        ("grids", "PointAxes"): "LPS",
        ("read", "WorldFromFile"): [0, -1, 0, 7.5, 1, 0, 0, -3, 0, 0, 1, 0.25, 0, 0, 0, 1],
        ("raw", "WorldFromFile"): [1, 0, 0, 4, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}


def test_a_python_state_keeps_what_has_no_widget():
    simple.ResetSession()
    load_plugin()
    for name in ("volume.nrrd", "volume.mha"):
        simple.SaveData(scratch(name), simple.Wavelet(), World="RAS")
    points = simple.PolyPointSource(registrationName="points", Points=[0, 0, 1, 2, 0, 1])
    wavelet = simple.Wavelet(registrationName="wavelet")
    simple.RefinedLattice(registrationName="refined", Input=wavelet, LatticeDimensions=[4, 4, 5])
    simple.FitDeformation(registrationName="fit", Input=wavelet, RestLandmarks=points,
                          MeasuredLandmarks=points)
    simple.ElectrodeGrids(registrationName="grids", Input=points, Cortex=wavelet)
    simple.NRRDVolumeReader(registrationName="read", FileName=scratch("volume.nrrd"))
    simple.RenameSource("raw", simple.OpenDataFile(scratch("volume.mha")))
    for (source, name), value in without_widget().items():
        setattr(simple.FindSource(source), name, value)
    script = smstate.get_state()
    simple.ResetSession()
    load_plugin()
    exec(compile(script, "state", "exec"), {"__name__": "state"})
    for (source, name), value in without_widget().items():
        found = simple.FindSource(source).GetPropertyValue(name)
        assert (found if isinstance(value, str) else list(found)) == value, (source, name, found)


run_tests(globals())
