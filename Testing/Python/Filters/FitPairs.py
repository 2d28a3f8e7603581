# SPDX-License-Identifier: BSD-3-Clause
# Proves that pairs of landmarks in the property LandmarkPairs count like pairs in the inputs, that
# names switch off landmarks of the inputs, that names, places and figures come in one order, that
# a pair that is switched off says how far the fit misses it, that states keep it all, and that
# lists without a common name and pairs that determine no rotation are refused or named.
import json

import numpy
from brainshift_testing import (assert_says, ball, load_plugin, messages, run_tests, scratch,
                                volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.reports import numbers  # noqa: E402
from paraview import simple  # noqa: E402

SIDE = 41
MIDDLE = (SIDE - 1) / 2 * 4.0  # mm


def head():
    return volume(ball(side=SIDE, radius=16), spacing=(4.0,) * 3)


def measured_pairs(count, seed=5):
    """Landmarks, and where they went: a shift, a bend and an error of measurement."""
    random = numpy.random.default_rng(seed)
    rest = MIDDLE + random.uniform(-45, 45, (count, 3))
    bend = 3.0 * numpy.exp(-((rest - MIDDLE) ** 2).sum(axis=1) / 40.0 ** 2)
    measured = rest + (2.0, -1.0, 0.5) + bend[:, None] * (0, 0, 1)
    return rest, measured + random.normal(0, 0.4, rest.shape)


def points(positions, labels=None, name="points.csv"):
    rows = ["x,y,z,label"] + [
        ",".join([*(repr(float(number)) for number in position), label])
        for position, label in zip(positions, labels or [""] * len(positions))]
    with open(scratch(name), "w", encoding="utf-8") as file:
        file.write("\n".join(rows) + "\n")
    return simple.LandmarkReader(FileName=scratch(name))


def by_ports(rest, measured, labels=None, **properties):
    return simple.FitDeformation(
        RestLandmarks=points(rest, labels, "rest.csv"),
        MeasuredLandmarks=points(measured, labels, "measured.csv"), **properties)


def pairs(rest, measured, weights=None):
    weights = [1.0] * len(rest) if weights is None else weights
    return [float(n) for a, b, weight in zip(rest, measured, weights) for n in (*a, *b, weight)]


def figures(fit):
    fit.UpdatePipeline()
    return brainshift.Fit(fit)


def told(fit, name):
    fit.SMProxy.UpdatePropertyInformation(fit.SMProxy.GetProperty(name))
    return list(numbers(fit.SMProxy, name))


def names(fit):
    wanted = fit.SMProxy.GetProperty("LandmarkNames")
    fit.SMProxy.UpdatePropertyInformation(wanted)
    return [wanted.GetElement(i) for i in range(wanted.GetNumberOfElements())]


def assert_same(one, other):
    probe = MIDDLE + numpy.random.default_rng(9).uniform(-60, 60, (30, 3))
    assert numpy.allclose(
        one.measured_from_rest(probe), other.measured_from_rest(probe), rtol=0, atol=1e-9)
    assert numpy.allclose(one.rigid, other.rigid, rtol=0, atol=1e-9)
    for name in ("landmark_residuals", "leave_one_out"):
        assert numpy.allclose(getattr(one, name), getattr(other, name), rtol=0, atol=1e-9,
                              equal_nan=True), name


def test_pairs_of_the_property_are_those_of_the_inputs():
    rest, measured = measured_pairs(12)
    source = head()
    ports = figures(by_ports(rest, measured, Input=source))
    own = figures(simple.FitDeformation(Input=source, LandmarkPairs=pairs(rest, measured)))
    assert len(own.landmark_residuals) == len(own.leave_one_out) == 12
    assert 0.1 < own.landmark_residuals.mean() < own.leave_one_out.mean()
    assert_same(own, ports)
    both = figures(by_ports(rest[:5], measured[:5], Input=source,
                            LandmarkPairs=pairs(rest[5:], measured[5:])))
    assert_same(both, ports)


def test_names_switch_off_landmarks_of_the_inputs():
    rest, measured = measured_pairs(10)
    labels = [f"mark {i}" for i in range(10)]
    source = head()
    fit = by_ports(rest, measured, labels, Input=source, LandmarksOff=["mark 3", "nobody"])
    kept = [i for i in range(10) if i != 3]
    off, without = figures(fit), figures(by_ports(rest[kept], measured[kept], Input=source))
    assert numpy.isnan(off.landmark_residuals[3]) and off.landmark_residuals.shape == (10,)
    assert numpy.allclose(off.landmark_residuals[kept], without.landmark_residuals, atol=1e-9)
    assert numpy.allclose(off.leave_one_out[kept], without.leave_one_out, atol=1e-9)
    # A landmark that is off was left out: its figure is how far this fit misses it.
    fit.LandmarksOff = []
    on = figures(fit)
    assert numpy.isfinite(on.landmark_residuals[3])
    assert abs(off.leave_one_out[3] - on.leave_one_out[3]) < 0.15, (off.leave_one_out[3],
                                                                    on.leave_one_out[3])
    # The order of files does not matter: names do.
    fit = by_ports(rest[::-1], measured[::-1], labels[::-1], Input=source, LandmarksOff=["mark 3"])
    assert list(numpy.flatnonzero(numpy.isnan(figures(fit).landmark_residuals))) == [6]


def test_a_pair_of_weight_0_is_off_and_says_how_far_it_is_missed():
    rest, measured = measured_pairs(9)
    measured[4] += (0, 12.0, 0)
    source = head()
    weights = [float(i != 4) for i in range(9)]
    fit = simple.FitDeformation(Input=source, LandmarkPairs=pairs(rest, measured, weights))
    found = figures(fit)
    kept = [i for i in range(9) if i != 4]
    without = figures(
        simple.FitDeformation(Input=source, LandmarkPairs=pairs(rest[kept], measured[kept])))
    miss = numpy.linalg.norm(without.measured_from_rest(rest[[4]])[0] - measured[4])
    assert numpy.isnan(found.landmark_residuals[4]) and miss > 9.0
    assert abs(found.leave_one_out[4] - miss) < 0.05, (found.leave_one_out[4], miss)
    assert numpy.allclose(found.leave_one_out[kept], without.leave_one_out, atol=1e-9)
    assert found.calibration == without.calibration
    fit.LandmarkPairs = pairs(rest[:2], measured[:2], [0.0, 0.0])
    assert numpy.isnan(figures(fit).leave_one_out).all(), "nothing is known"


def test_names_and_places_stand_in_the_order_of_the_figures():
    rest, measured = measured_pairs(8)
    fit = by_ports(rest[:3], measured[:3], ["tip", "", "tip 2"], Input=head(),
                   LandmarkPairs=pairs(rest[4:], measured[4:], [1, 0, 2, 1]))
    found = figures(fit)
    assert names(fit) == ["tip", "tip 2", "Pair 1", "Pair 2", "Pair 3", "Pair 4"], names(fit)
    places = numpy.reshape(told(fit, "LandmarkPlaces"), (-1, 10))
    order = [0, 2, 4, 5, 6, 7]
    assert numpy.allclose(places[:, :3], rest[order], atol=1e-9)
    assert numpy.allclose(places[:, 3:6], measured[order], atol=1e-9)
    assert numpy.allclose(places[:, 6:9], found.measured_from_rest(rest[order]), atol=1e-9)
    assert list(places[:, 9]) == [1, 1, 1, 0, 2, 1]
    misses = numpy.linalg.norm(places[:, 6:9] - places[:, 3:6], axis=1)
    assert numpy.allclose(misses[places[:, 9] > 0],
                          found.landmark_residuals[places[:, 9] > 0], atol=1e-9)
    fit = by_ports(rest[:2], measured[:2], Input=fit.Input)
    figures(fit)
    assert names(fit) == ["1", "2"], "without labels they have numbers"


def test_numbers_that_are_no_pairs_are_an_error():
    rest, measured = measured_pairs(3)
    fit = simple.FitDeformation(Input=head(), LandmarkPairs=pairs(rest, measured)[:-1])
    with messages() as said:
        fit.UpdatePipeline()
    assert_says(said.text, "LandmarkPairs has 20 numbers", "a pair has 7")
    assert not names(fit) and not told(fit, "LandmarkPlaces")


def markups(name, positions, labels, axes="RAS"):
    with open(scratch(name), "w", encoding="utf-8") as file:
        json.dump({"markups": [{"type": "Fiducial", "coordinateSystem": axes, "controlPoints": [
            {"label": label, "position": list(map(float, position))}
            for label, position in zip(labels, positions)]}]}, file)
    return scratch(name)


def test_names_that_are_on_one_list_only_are_refused_on_all_roads():
    """A prefix, and a list in reverse: by order the fit would be wrong without a word."""
    rest, measured = measured_pairs(8)
    labels = [f"mark {i}" for i in range(8)]
    others = [f"F-{i + 1}" for i in range(8)]
    source = head()
    fit = simple.FitDeformation(
        Input=source, RestLandmarks=points(rest, labels, "rest.csv"),
        MeasuredLandmarks=points(measured, others, "measured.csv"))
    with messages() as said:
        fit.UpdatePipeline()
    assert_says(said.text, "No name is on both lists", "mark 0", "F-1", "Pair By Order")
    assert not names(fit)
    fit.PairByOrder = 1
    by_order = figures(fit)
    assert_same(by_order, figures(simple.FitDeformation(
        Input=source, LandmarkPairs=pairs(rest, measured))))
    # The same by files that Python reads.
    read = brainshift.read_points
    bent = simple.FreeFormDeformation(Input=source)
    one = read(markups("one.mrk.json", rest, labels))
    other = read(markups("other.mrk.json", measured[::-1], others))
    raises("No name is on both lists", brainshift.fit, bent, one, other)
    raises("No name is on both lists", brainshift.fit, bent, one, measured)
    assert bent.Lattice is None
    assert_same(brainshift.fit(bent, one, measured, by_order=True), by_order)
    # By name whatever the order, with one that is missing.
    fewer = read(markups("fewer.mrk.json", measured[7:2:-1], labels[7:2:-1]))
    found = brainshift.fit(bent, rest=one, measured=fewer)
    assert "mark 0 at rest" in found.warning and "mark 3" not in found.warning, found.warning
    assert len(found.landmark_residuals) == 5
    assert_same(found, figures(simple.FitDeformation(
        Input=source, LandmarkPairs=pairs(rest[3:], measured[3:]))))
    raises("must have the same number", brainshift.fit, bent, rest, measured[:5])
    unnamed = read(markups("unnamed.mrk.json", rest, [""] * 8))
    assert_same(brainshift.fit(bent, unnamed, measured), by_order)
    twice = read(markups("twice.mrk.json", [*measured, (50, 50, 50)], [*labels, "mark 2"]))
    found = brainshift.fit(bent, one, twice)
    assert_says(found.warning, "more than once: mark 2", "measured landmark mark 2")


def test_names_pair_whatever_their_column_is_called():
    rest, measured = measured_pairs(8)
    order = [3, 1, 2, 0, 4, 5, 7, 6]

    def read(name, column, places, labels):
        with open(scratch(name), "w", encoding="utf-8") as file:
            file.write(f"{column},x,y,z\n" + "".join(
                ",".join([label, *map(repr, map(float, place))]) + "\n"
                for label, place in zip(labels, places)))
        with messages():
            return brainshift.read_points(scratch(name))

    bent = simple.FreeFormDeformation(Input=head())
    right = brainshift.fit(bent, rest, measured)
    for one, other, labels in (("electrode", "name", [f"A{i}" for i in range(8)]),
                               ("id", "id", [str(i) for i in range(8)]),
                               ("wo", "Punkt", [f"P{i}" for i in range(8)])):
        found = brainshift.fit(
            bent, read("one.csv", one, rest, labels),
            read("other.csv", other, measured[order], [labels[i] for i in order]))
        assert len(found.landmark_residuals) == 8
        assert_same(found, right)


def raises(words, call, *arguments, **options):
    try:
        call(*arguments, **options)
    except (ValueError, TypeError) as error:
        assert words in str(error), error
    else:
        raise AssertionError(words)


def test_what_pairs_do_not_say_is_said():
    """In the property and in Python; the deviation covers the rotation that is open."""
    bent = simple.FreeFormDeformation(Input=head())
    line = MIDDLE + numpy.outer((-30.0, -10.0, 5.0, 25.0), (1.0, 0.0, 0.0))
    turned = MIDDLE + (line - MIDDLE) + (1.0, 2.0, 0.0)
    with messages() as said:
        found = brainshift.fit(bent, line, turned)
    assert_says(found.warning, "rotation about it is not determined")
    assert_says(said.text, "rotation about it is not determined")
    away, on_line = MIDDLE + numpy.array([(0, 40.0, 0)]), MIDDLE + numpy.array([(0.0, 0, 0)])
    assert found.deviation(away)[0] > 20.0 and found.deviation(on_line)[0] < 2.0
    lattice = figures(simple.FitDeformation(
        Input=bent.Input, LandmarkPairs=pairs(line, turned), Evidence=1))
    assert lattice.filter.PointData["Deviation"].GetRange()[1] > 20.0, "evidence, too"
    # LPS numbers under the word RAS: a half turn with residuals of 0.
    rest, measured = measured_pairs(8)
    found = brainshift.fit(bent, rest, measured * (-1, -1, 1))
    assert_says(found.warning, "look exchanged or mirrored", "-x -y z")
    found = brainshift.fit(bent, rest, measured)
    assert found.warning == "", found.warning
    assert_says(brainshift.fit(bent, rest / 1000, measured / 1000).warning, "are in mm")


def test_each_list_that_lies_wrong_is_named():
    """Traces, pulls, pins and landmarks in other units or frames, and pairs that do not fit."""
    source = volume(ball(side=SIDE, radius=16), spacing=(4.0,) * 3, origin=(-MIDDLE,) * 3)
    random = numpy.random.default_rng(3)
    rest = random.uniform(-45, 45, (8, 3))
    unit = random.normal(size=(60, 3))
    unit /= numpy.linalg.norm(unit, axis=1)[:, None]
    traces = 64.0 * unit[unit[:, 2] > 0.4] - (0, 0, 5.0)

    def warning(**measured):
        bent = simple.FreeFormDeformation(Input=source)
        with messages() as said:
            found = brainshift.fit(bent, threshold=50, **measured)
        assert bool(found.warning) == bool(said.text), "a warning is said, too"
        simple.Delete(bent)
        return found.warning

    def pulls(places):
        return numpy.stack([places, places + 0.02 * places], axis=1)

    assert warning(traces=traces) == ""
    assert warning(pulls=pulls(rest * 0.5)) == ""
    for make, name in ((lambda places: {"traces": places}, "The traced points are"),
                       (lambda places: {"pulls": pulls(places)}, "The pulls are"),
                       (lambda places: {"pulls": pulls(rest[:1]), "pins": places}, "The pins are"),
                       (lambda places: {"rest": places, "measured": places + (2.0, -1.0, 0.5)},
                        "The landmarks at rest are")):
        assert_says(warning(**make(traces * 0.001)), name, "check that they are in mm")
        assert_says(warning(**make(traces * 0.1)), name, "not in cm")
        assert_says(warning(**make(traces + (0, 0, 400.0))), name, "outside the volume")
    assert_says(warning(traces=traces * 0.5), "from the cortex at rest", "frame")
    measured = rest + (2.0, -1.0, 0.5)
    wrong = measured.copy()
    wrong[0] += (40.0, 0, 0)
    assert_says(warning(rest=rest, measured=wrong), "Landmark 1 is measured 40 mm from")
    assert_says(warning(rest=rest, measured=measured[[1, 0, 2, 3, 4, 5, 6, 7]]),
                "Landmarks 1 and 2 look exchanged")
    wrong = measured.copy()
    wrong[1] = wrong[0]
    assert_says(warning(rest=rest, measured=wrong), "1 and 2 are measured at the same place")
    assert_says(warning(rest=rest, measured=1.5 * measured), "1.5 times as far apart")


def test_a_fit_prints_as_a_line_and_takes_what_was_read():
    rest, measured = measured_pairs(8)
    bent = simple.FreeFormDeformation(Input=head())
    read = brainshift.read_points(markups("read.mrk.json", rest, [""] * 8))
    text = str(brainshift.fit(bent, rest=read, measured=measured))
    assert_says(text, "Fit: 8 landmarks", "residuals of", "leave-one-out", "degrees",
                "applied 100 %", "deviations x ")
    assert "\n" not in text
    for array in (rest, rest.tolist(), read):
        raises("deformed_from_rest(filter, points)", brainshift.map_points, array, "out.csv")
    raises("map_points takes paths", brainshift.map_points, "in.csv", rest)


def test_a_lattice_report_says_where_tissue_is_drawn():
    bent = simple.FreeFormDeformation(
        Input=head(), Strokes=brainshift.soft((MIDDLE,) * 3, (0, 0, 6.0), 40.0))
    bent.UpdatePipeline()
    places = MIDDLE + numpy.random.default_rng(1).uniform(-30, 30, (5, 3))
    report = bent.SMProxy.GetSessionProxyManager().NewProxy("misc", "LatticeReport")
    report.UnRegister(None)
    report.GetProperty("Filter").AddProxy(bent.SMProxy)
    wanted = report.GetProperty("Places")
    wanted.SetNumberOfElements(15)
    for i, number in enumerate(places.ravel()):
        wanted.SetElement(i, float(number))
    report.GetProperty("ToRest").SetElement(0, 0)
    report.UpdateVTKObjects()
    report.UpdatePropertyInformation(report.GetProperty("SameTissue"))
    drawn = numpy.reshape(list(numbers(report, "SameTissue")), (-1, 3))
    expected = brainshift.deformed_from_rest(bent, places)
    assert numpy.abs(expected - places).max() > 1.0
    assert numpy.allclose(drawn, expected, atol=1e-5), drawn - expected


def test_states_keep_pairs_and_what_is_off():
    rest, measured = measured_pairs(8)
    source = simple.Wavelet(WholeExtent=[0, 160, 0, 160, 0, 160])  # a state can bring it back
    fit = by_ports(rest[:4], measured[:4], Input=source, LandmarksOff=["2"],
                   LandmarkPairs=pairs(rest[4:], measured[4:]), registrationName="to keep")
    before = figures(fit)
    simple.SaveState(scratch("pairs.pvsm"))
    simple.Delete(fit)
    assert simple.FindSource("to keep") is None
    simple.LoadState(scratch("pairs.pvsm"))
    again = simple.FindSource("to keep")
    assert list(again.LandmarksOff) == ["2"] and len(again.LandmarkPairs) == 28
    after = figures(again)
    assert numpy.allclose(after.leave_one_out, before.leave_one_out)
    assert numpy.isnan(after.landmark_residuals[1])


run_tests(globals())
