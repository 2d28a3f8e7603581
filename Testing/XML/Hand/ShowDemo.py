# SPDX-License-Identifier: BSD-3-Clause
"""Proves that `./brainshift demo` builds its scene in ParaView's window, whatever Python packages
are installed, and plays it: a bent head and a bent brain, each drawn, with Strength at 1 at the
end. ParaView 5.13 ends where the panel of a Programmable Filter meets pygments.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""

import os
import sys

import test_hand as hand
import window_testing as window
from paraview import simple

CHECKOUT = os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "..", "..")
os.environ["BRAINSHIFT_DATA"] = os.environ["BRAINSHIFT_TEST_DATA"]
sys.path.append(os.path.join(CHECKOUT, "Examples"))
import demo  # noqa: E402


def build_and_play():
    demo.play()
    hand.wait(500)
    for name, array in (("Bent head", "Intensity"), ("Bent brain", "Brain")):
        bent = simple.FindSource(name)
        assert bent.Strength == 1.0, (name, bent.Strength)
        bent.UpdatePropertyInformation()
        assert bent.MaximumDisplacement > 5.0, (name, bent.MaximumDisplacement)
        low, high = bent.PointData[array].GetRange()
        assert low == 0.0 and high > 100.0, (name, low, high)


def select_every_source():
    """Each has a panel that opens."""
    for source in simple.GetSources().values():
        simple.SetActiveSource(source)
        hand.wait(200)


def play():
    yield (build_and_play,)
    yield (select_every_source,)


if __name__ == "__main__":
    window.main("ShowDemo", play())
