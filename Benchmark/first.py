# SPDX-License-Identifier: BSD-3-Clause
"""Measures the first picture of a volume that was delivered, and a drag in the opacity editor.

Each round has a new array of voxels, a new view and new displays. ParaView looks for the ranges of
new arrays when it makes a filter or a display of them; that is in both sides' times.
The view has drawn an empty picture before. Shaders come from the driver's cache on disk, if it has
one, because the first run is not counted.
"""

from measure import Side, Times, interleaved, timed
from paraview import simple
from scene import ARRAY, TOWARDS_EYE

FIRST, SHOWN, DRAWN = "ours: all", "ours: the filter and its display", "ours: the picture"
STOCK_FIRST = "ParaView's Volume: all"
STILL, MOVING = "ours, a picture as it stays", "ours, as while the hand moves"


class Delivered:
    """A copy of a scene's volume, and an empty view for it."""

    def __init__(self, scene, window):
        image = scene.image.NewInstance()
        image.DeepCopy(scene.image)
        self.source = simple.TrivialProducer()
        self.source.GetClientSideObject().SetOutput(image)
        self.source.UpdatePipeline()
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = [window, window]
        self.view.UseColorPaletteForBackground = 0
        self.view.OrientationAxesVisibility = self.view.CenterAxesVisibility = 0
        self.view.UseFXAA = 0
        radius = float(sum(side * side for side in scene.centre)) ** 0.5
        self.view.CameraFocalPoint = list(scene.centre)
        self.view.CameraPosition = [side + 3.9 * radius * ahead
                                    for side, ahead in zip(scene.centre, TOWARDS_EYE)]
        self.view.CameraViewUp = [0, 0, 1]
        self.made = [self.view, self.source]
        self.draw()

    def show(self, kind):
        shown = self.source
        if kind == "Deformed Volume":
            shown = simple.FreeFormDeformation(Input=self.source)
            self.made.insert(0, shown)
        display = simple.Show(shown, self.view, "UniformGridRepresentation")
        display.SetRepresentationType(kind)
        simple.ColorBy(display, ("POINTS", ARRAY))
        display.SetScalarBarVisibility(self.view, False)

    def draw(self):
        self.view.SMProxy.StillRender()
        self.view.GetClientSideObject().GetRenderWindow().WaitForCompletion()

    def close(self):
        for proxy in self.made:
            simple.Delete(proxy)


def first_pictures(scene, window, rounds):
    """{name: Times} of both sides in turn."""
    times = {name: Times([], []) for name in (FIRST, SHOWN, DRAWN, STOCK_FIRST)}
    for counts in [False] + [True] * rounds:
        for kind in ("Deformed Volume", "Volume"):
            delivered = Delivered(scene, window)
            parts = [timed(lambda: delivered.show(kind)), timed(delivered.draw)]
            parts.insert(0, tuple(map(sum, zip(*parts))))
            delivered.close()
            names = (FIRST, SHOWN, DRAWN) if kind == "Deformed Volume" else (STOCK_FIRST,)
            for name, (wall, processor) in zip(names, parts if counts else ()):
                times[name].wall.append(wall)
                times[name].processor.append(processor)
    return times


def opacity_drags(scene):
    """Sides that change a point of the opacity curve, and draw."""
    curve = simple.GetOpacityTransferFunction(ARRAY)
    points = list(curve.Points)

    def changed(draw):
        def run():
            points[4] += 0.5 if points[4] < 0.5 * (points[0] + points[8]) else -0.5
            curve.Points = points
            draw()
            scene.window.WaitForCompletion()
        return run

    def prepare():
        scene.show("ours")

    return [Side(STILL, changed(scene.view.SMProxy.StillRender), prepare),
            Side(MOVING, changed(scene.view.SMProxy.InteractiveRender), prepare)]


def measure_first(scene, report, options, about):
    window = options.windows[0]
    about = {**about, "window": window}
    scene.use("opaque", window)
    rows = report.group("opacity curve dragged", f"opacity curve dragged, {window}x{window}", about,
                        interleaved(opacity_drags(scene), options.rounds, options.seconds))
    report.target("curve", *(1000.0 / max(rows[MOVING][time], 1e-9)
                             for time in ("median", "quiet")), window=window)
    scene.use("opaque", window)
    rows = report.group("first picture", f"first picture of delivered voxels, {window}x{window}",
                        about, first_pictures(scene, window, options.rounds))
    # What ParaView and a new texture take is the work of one thread.
    report.target("first", rows[FIRST]["median"] / 1000.0, window=window)
