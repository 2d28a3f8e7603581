# SPDX-License-Identifier: BSD-3-Clause
"""Measures 100 000 traced points with a volume: while the camera turns, while points change, and
the computation of their distances after a stroke.

Our side draws the bent volume and Trace Points, which its tissue hides. Stock draws the volume as
loaded at the same step, and ParaView's Points of the same width, which are opaque everywhere. Stock
has nothing like Trace Distance. The cortex is here the skin, found by a threshold. Its surface is
finer than that of a mask.
"""

import numpy
from measure import Side, interleaved
from paraview import simple
from scene import AIR, ARRAY
from vtkmodules.util.numpy_support import vtk_to_numpy

COUNT = 100_000
NOISE_MM = 2.0
RADIUS_MM = 1.0
ALONE, FADED, HIDDEN = "ours alone", "ours, points faded", "ours, points hidden"
STOCK_ALONE, STOCK = "stock, same step, alone", "stock, same step, Points"
DISTANCES = "Trace Distance after a stroke"


def _points(scene):
    """Around the skin, as if traced there; the same each time."""
    skin = simple.Contour(Input=scene.source, ContourBy=["POINTS", ARRAY],
                          Isosurfaces=[2 * AIR])
    skin.UpdatePipeline()
    surface = vtk_to_numpy(skin.GetClientSideObject().GetOutputDataObject(0).GetPoints().GetData())
    random = numpy.random.default_rng(1)
    points = surface[random.integers(0, len(surface), COUNT)].astype(float)
    simple.Delete(skin)
    return simple.PolyPointSource(
        Points=(points + random.normal(0.0, NOISE_MM, points.shape)).ravel().tolist())


class Traces:
    """A scene with points, and what is measured of them."""

    def __init__(self, scene):
        self.scene = scene
        self.points = _points(scene)
        self.measure = simple.TraceDistance(Input=self.points, Deformation=scene.bent,
                                            Threshold=2 * AIR)
        self.display = simple.Show(self.points, scene.view, "GeometryRepresentation")
        self.display.TraceRadius = RADIUS_MM
        self.changes = 0

    def close(self):
        for proxy in (self.measure, self.points):
            simple.Delete(proxy)

    def show(self, volume, kind=None, hidden="Fade"):
        """A volume of the scene, alone or with the points as `kind`."""
        self.scene.show(volume)
        self.display.Visibility = int(kind is not None)
        if kind:
            self.display.SetRepresentationType(kind)
            self.display.HiddenPoints = hidden
            self.display.PointSize = 2 * RADIUS_MM * self.pixels_for_mm()
        self.scene.frame()

    def pixels_for_mm(self):
        view = self.scene.view
        distance = numpy.linalg.norm(numpy.subtract(view.CameraPosition, view.CameraFocalPoint))
        height = 2 * distance * numpy.tan(numpy.radians(view.CameraViewAngle / 2))
        return view.ViewSize[1] / height

    def turn(self):
        """The camera, back and forth."""
        self.changes += 1
        self.scene.view.GetActiveCamera().Azimuth(1.0 if self.changes % 2 else -1.0)
        self.scene.frame()

    def recolor(self):
        self.changes += 1
        self.display.DiffuseColor = self.display.AmbientColor = [1.0, self.changes % 2, 0.0]
        self.scene.frame()

    def distances(self):
        self.scene.edit()
        self.measure.UpdatePipeline()

    def sides(self, run):
        return {name: Side(name, run, lambda arguments=arguments: self.show(*arguments))
                for name, arguments in ((ALONE, ("ours",)), (FADED, ("ours", "Trace Points")),
                                        (HIDDEN, ("ours", "Trace Points", "Hide")),
                                        (STOCK_ALONE, ("stock",)), (STOCK, ("stock", "Points")))}


def measure_traces(scene, report, options, about):
    """Adds three groups of rows: the camera turns, the points change, a stroke changes."""
    window = options.windows[-1]
    scene.use("opaque", window)
    traces = Traces(scene)
    turned = traces.sides(traces.turn)
    recolored = {name: side for name, side in traces.sides(traces.recolor).items()
                 if name in (FADED, HIDDEN, STOCK)}
    about = {**about, "window": window}
    for kind, sides in (
            ("traces, camera turns", turned.values()),
            ("traces, points change", recolored.values()),
            ("traces, distances", [Side(DISTANCES, traces.distances)])):
        report.group(kind, f"{kind}, {COUNT} points, {window}x{window}", about,
                     interleaved(list(sides), options.rounds, options.seconds))
    traces.close()
    scene.show("ours")
