# SPDX-License-Identifier: BSD-3-Clause
"""Plays in ParaView's window what drag.py measures."""

import json
import os
import statistics
import sys
import time
import traceback

MOVES, CLICKS, HOVERS = 100, 50, 20
LONGEST = 5.0  # seconds for one picture; after that none is expected


class Pictures:
    """Counts the pictures of a view."""

    def __init__(self, view):
        self.window = view.GetRenderWindow()
        self.drawn = 0
        self.window.AddObserver("EndEvent", self._count)

    def _count(self, *_):
        self.drawn += 1

    def after(self, act):
        """Seconds from an event to the end of its picture, by the clock and of the processors."""
        import test_hand as hand
        before, start, used = self.drawn, time.perf_counter(), time.process_time()
        act()
        while self.drawn == before:
            hand.wait()
            if time.perf_counter() - start > LONGEST:
                raise RuntimeError("an event has led to no picture")
        self.window.WaitForCompletion()
        return time.perf_counter() - start, time.process_time() - used


def row(kind, window, seconds):
    """The time on a quiet machine where llvmpipe draws: "quiet" of benchmark.py."""
    clock, processors = zip(*seconds)
    return {"kind": kind, "window": window, "count": len(seconds),
            "median": 1000 * statistics.median(clock), "worst": 1000 * max(clock),
            "quiet": 1000 * statistics.median(processors) / rendering_threads()}


def play(view, window):
    import test_hand as hand
    hand.resize(window, window)
    width, height = view.ViewSize
    middle = [width // 2, height // 2]
    pictures = Pictures(view)
    hand.take(hand.STAMP)
    hand.hover(middle)
    hand.wait(200)
    hover = [pictures.after(lambda i=i: hand.hover([middle[0] + 6 * (i + 1), middle[1]]))
             for i in range(HOVERS)]
    hand.hover(middle)
    hand.wait(200)
    hand.press(middle)
    drag = [pictures.after(lambda i=i: hand.drag_to([middle[0] - i % 7, middle[1] - i]))
            for i in range(1, MOVES + 1)]
    hand.release([middle[0], middle[1] - MOVES])
    hand.wait(200)
    hand.hover(middle)
    hand.wait(200)
    wheel = [pictures.after(lambda: hand.wheel(middle, 1)) for _ in range(CLICKS)]
    hand.hover([5, 5])
    hand.wait(500)
    return [row("hover", window, hover), row("drag", window, drag), row("wheel", window, wheel)]


def main(job):
    from paraview import simple
    from scene import ARRAY, COLORS, OPACITIES, TOWARDS_EYE, VIEW_ANGLE, head
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(head(job["dimensions"]))
    bent = simple.FreeFormDeformation(Input=source)
    view = simple.GetActiveViewOrCreate("RenderView")
    display = simple.Show(bent, view)
    simple.SetActiveSource(bent)
    simple.ColorBy(display, ("POINTS", ARRAY))
    simple.GetColorTransferFunction(ARRAY).RGBPoints = COLORS
    simple.GetOpacityTransferFunction(ARRAY).Points = [
        number for i in range(0, 8, 2) for number in (*OPACITIES["opaque"][i:i + 2], 0.5, 0)]
    display.ScalarOpacityUnitDistance = 1.0
    display.Shade = 1
    simple.Render(view)
    centre = [(side - 1) / 2 for side in job["dimensions"]]
    distance = 2.9 * max(job["dimensions"])
    view.CameraFocalPoint = centre
    view.CameraPosition = [c + distance * t for c, t in zip(centre, TOWARDS_EYE)]
    view.CameraViewUp = (0, 0, 1)
    view.CameraViewAngle = VIEW_ANGLE
    results = []
    for window in job["windows"]:
        results += play(view, window)
    return results


if __name__ == "__main__":
    task = json.loads(os.environ["BRAINSHIFT_DRAG"])
    sys.path[:0] = task["path"]
    import test_hand
    from measure import rendering_threads
    try:
        results = main(task)
    except BaseException:
        results = traceback.format_exc()
    with open(task["file"], "w", encoding="utf-8") as output:
        json.dump(results, output)
    test_hand.quit()
