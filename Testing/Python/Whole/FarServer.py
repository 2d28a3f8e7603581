# SPDX-License-Identifier: BSD-3-Clause
# Proves of a server that is 50 ms away, of one process and of two MPI ranks: it draws what the
# built-in session draws; a stroke and a turned camera take as many round trips as a change of
# ParaView's own "Volume", and none for the stroke itself; and the next client of the server brings
# all strokes back from a state file.
import gc
import time

import far_network
from brainshift_testing import (load_plugin, messages, picture, run_tests, scratch, server,
                                server_finds_plugin, show_volume, view_along)
from paraview import simple
from ranks_testing import MPI

load_plugin()
import brainshift  # noqa: E402 after the plugin

AWAY = 0.05  # s, each way
EXTENT = [-40, 40] * 3
STROKES = brainshift.soft((0, 0, 0), (8, 4, 2), 25.0)
LATER = STROKES + brainshift.soft((9, -7, 14), (0, -6, 1), 20.0)
COLORS = [40, 0, 0, 0.2, 280, 1, 1, 1]
OPACITIES = [40, 0, 0.5, 0, 280, 0.7, 0.5, 0]
SIZE = 160
STATE = scratch("FarServer.pvsm")
LAUNCHERS = {1: (), 2: (*MPI, "2")}  # by ranks
LARGEST = {1: 0.0, 2: 4.5 / 255}  # difference from the session's picture
SERVER_FINDS_PLUGIN = server_finds_plugin()


def shown(kind):
    """A wavelet, bent if it is a Deformed Volume: the filter and its view."""
    made = simple.Wavelet(WholeExtent=EXTENT)
    if kind == "Deformed Volume":
        made = simple.FreeFormDeformation(registrationName="Bent", Input=made, Strokes=STROKES)
    view = view_along((-0.5, 0.3, -1), (0, 0, 0), 200.0, size=SIZE)
    view.RemoteRenderThreshold = 0.0  # the server draws, however small the data
    show_volume(made, view, kind, COLORS, OPACITIES, array="RTData")
    return made, view


def pictures(made, view):
    """Before and after another stroke."""
    before = picture(view)
    made.Strokes = LATER
    return before, picture(view)


EXPECTED = pictures(*shown("Deformed Volume"))


def round_trips(far, work):
    time.sleep(4 * AWAY)  # what is under way arrives
    before = far.counts()["roundTrips"]
    work()
    time.sleep(4 * AWAY)
    return far.counts()["roundTrips"] - before


def trips_of(far, kind, change):
    """Of a change alone; of a still and a moving picture of one; and of both of another camera."""
    made, view = shown(kind)
    proxy, camera = view.SMProxy, view.GetActiveCamera()
    picture(view)
    found = [round_trips(far, lambda: change(made, 0))]
    for number, draw in enumerate((proxy.StillRender, proxy.InteractiveRender), start=1):
        found.append(round_trips(far, lambda: (change(made, number), draw())))
    for draw in (proxy.StillRender, proxy.InteractiveRender):
        found.append(round_trips(far, lambda: (camera.Azimuth(3.0), draw())))
    simple.Delete(view)
    return found


def draw_and_leave(far):
    """What the first client sees and counts. It saves its state."""
    simple.Connect("localhost", far.port)
    made, view = shown("Deformed Volume")
    seen = pictures(made, view)
    simple.SaveState(STATE)
    simple.Delete(view)
    ours = trips_of(far, "Deformed Volume", lambda bent, number: setattr(
        bent, "Strokes", STROKES + brainshift.soft((2, 2, 2), (number, 1, 1), 20.0)))
    own = trips_of(far, "Volume", lambda wavelet, number: setattr(
        wavelet, "Maximum", 250.0 + number))
    simple.Disconnect()
    return seen, ours, own


def come_back(far):
    """What the next client of the same server sees once it has loaded the state."""
    simple.Connect("localhost", far.port)
    simple.LoadState(STATE)
    view = simple.GetActiveView()
    view.UseFXAA = 0
    seen = picture(view)
    strokes = list(simple.FindSource("Bent").Strokes)
    simple.Disconnect()
    return seen, strokes


def ask_both_clients(ranks):
    options = ["--multi-clients"]  # or the server ends with its first client
    with server(SERVER_FINDS_PLUGIN, LAUNCHERS[ranks], options) as (port, process), messages(), \
            far_network.between(port, AWAY) as far:
        first = draw_and_leave(far)
        gc.collect()
        second = come_back(far)
        gc.collect()
        assert process.poll() is None, "the server goes on"
    return first, second


ANSWERS = {ranks: ask_both_clients(ranks) for ranks in LAUNCHERS}


def test_there_is_something_to_see():
    assert all((image.max(axis=2) > 0.02).mean() > 0.2 for image in EXPECTED)
    assert (EXPECTED[0] != EXPECTED[1]).any(axis=2).mean() > 0.05


def test_the_pictures_are_those_of_the_session():
    for ranks, ((seen, *_), (again, _)) in ANSWERS.items():
        for found, expected in zip((*seen, again), (*EXPECTED, EXPECTED[1])):
            difference = abs(found - expected).max()
            print(ranks, "ranks differ by", difference, flush=True)
            assert difference <= LARGEST[ranks], (ranks, difference)


def test_round_trips_are_those_of_paraviews_own_volume():
    for ranks, ((_, ours, own), _) in ANSWERS.items():
        print(ranks, "ranks", ours, "ParaView's own", own, flush=True)
        assert ours[0] <= 1, "strokes are sent without an answer"
        assert all(our <= max(1, its) for our, its in zip(ours, own)), (ranks, ours, own)
        assert min(ours[1:3]) > 2 >= max(ours[3:]), (ranks, ours)


def test_the_next_client_has_all_strokes():
    for ranks, ((seen, *_), (again, strokes)) in ANSWERS.items():
        assert strokes == list(LATER), (ranks, strokes)
        # Boxes of several ranks stay where they were before the last stroke; new ones differ.
        assert abs(again - seen[1]).max() <= LARGEST[ranks], (ranks, abs(again - seen[1]).max())


run_tests(globals())
