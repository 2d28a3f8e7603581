# SPDX-License-Identifier: BSD-3-Clause
"""Measures a long session: what an edit costs after thousands of strokes.

A time runs from the new value of Strokes to the end of the filter. It holds the way of all numbers
to the server. `replay alone` is the filter's part, after the numbers are there.
"""

import numpy
from measure import Side, interleaved
from paraview import simple

ADDED, TAKEN_BACK = "a stroke is added", "the last stroke is taken back"
CHANGED, ALONE = "the tenth last stroke is changed", "the last stroke is taken back, replay alone"


class Session:
    """A volume with strokes all over it, and what is measured of them."""

    def __init__(self, scene, count):
        import brainshift
        random = numpy.random.default_rng(2)
        size = numpy.array(scene.dimensions, dtype=float)
        self.strokes = []
        for _ in range(count):
            self.strokes += brainshift.soft(
                tuple(random.uniform(0.1, 0.9, 3) * size), tuple(random.uniform(-2.0, 2.0, 3)),
                radius=0.2 * float(size.max()))
        self.bent = simple.FreeFormDeformation(Input=scene.source)
        self.changes = 0

    def close(self):
        simple.Delete(self.bent)

    def all_again(self):
        self.bent.Strokes = self.strokes
        self.bent.UpdatePipeline()

    def set(self, strokes):
        self.bent.Strokes = strokes
        self.bent.UpdatePipeline()

    def changed(self):
        """Another vector each time, or nothing would be redone."""
        self.changes += 1
        strokes = list(self.strokes)
        strokes[-140 + 4] += 0.01 * self.changes
        self.set(strokes)

    def send_less(self):
        self.all_again()
        self.bent.Strokes = self.strokes[:-14]
        self.bent.UpdateVTKObjects()

    def sides(self):
        added = self.strokes + self.strokes[-14:]
        return [Side(ADDED, lambda: self.set(added), self.all_again),
                Side(TAKEN_BACK, lambda: self.set(self.strokes[:-14]), self.all_again),
                Side(CHANGED, self.changed, self.all_again),
                Side(ALONE, self.bent.UpdatePipeline, self.send_less)]


def measure_session(scene, report, options, about):
    """Adds one group of rows."""
    session = Session(scene, options.strokes)
    report.group("long session", f"long session, {options.strokes} strokes",
                 {**about, "window": options.windows[0]},
                 interleaved(session.sides(), options.rounds, options.seconds))
    session.close()
