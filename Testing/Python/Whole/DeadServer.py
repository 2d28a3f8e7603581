# SPDX-License-Identifier: BSD-3-Clause
# Proves that pvpython says once and clearly that its server was killed, and that SaveState then
# still keeps all strokes. State.py proves that such a file brings them back.
from xml.etree import ElementTree

from brainshift_testing import (load_plugin, messages, picture, run_tests, scratch, server,
                                server_finds_plugin, show_volume, view_along)
from paraview import simple

load_plugin()
import brainshift  # noqa: E402 after the plugin

STROKES = (brainshift.stamp((3, 2, 8), (0, 0, 0), 4.0, major=12.0, minor=9.0)
           + brainshift.soft((0, -6, 4), (1.0, 1.0, 1.0 / 3.0), 7.0))
LAST = brainshift.move((-5, 1, 6), (0.25, -1.5, 2.0))  # made after the server's death
COLORS = [40, 0, 0, 0.2, 280, 1, 1, 1]
OPACITIES = [40, 0, 0.5, 0, 280, 0.7, 0.5, 0]
SAID = "the server has ended"
STATE = scratch("DeadServer.pvsm")


def ask(bent, view):
    """Asks the server that is gone. ParaView 6.1 then draws a picture of any size that happens to
    lie in memory, and may end; so there the filter is asked."""
    if simple.GetParaViewVersion() >= (6, 0):
        bent.UpdatePipeline()
    else:
        view.SMProxy.StillRender()


def bend_and_lose_the_server():
    """What ParaView says when a server is killed under a drawn picture. Saves the state."""
    with server(server_finds_plugin()) as (port, process):
        simple.Connect("localhost", port)
        bent = simple.FreeFormDeformation(
            registrationName="Bent", Input=simple.Wavelet(), Strokes=STROKES)
        view = view_along((0, 0, -1), (0, 0, 0), 60)
        show_volume(bent, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
        assert (picture(view).max(axis=2) > 0.02).mean() > 0.1, "the server draws"
        process.kill()
        process.wait()
        with messages() as said:
            for _ in range(3):
                ask(bent, view)
            bent.Strokes = STROKES + LAST
            ask(bent, view)
            simple.SaveState(STATE)
    return said.text


def test_it_is_said_once_and_the_strokes_are_kept():
    text = bend_and_lose_the_server()
    assert text.count(SAID) == 1, text
    assert "SaveState" in text and "LoadState" in text, text


def test_the_state_holds_all_strokes():
    filters = [proxy for proxy in ElementTree.parse(STATE).iter("Proxy")
               if proxy.get("type") == "FreeFormDeformation"]
    assert len(filters) == 1, filters
    strokes, = (found for found in filters[0].iter("Property") if found.get("name") == "Strokes")
    numbers = tuple(float(element.get("value")) for element in strokes.iter("Element"))
    assert numbers == STROKES + LAST, numbers


run_tests(globals())
