# SPDX-License-Identifier: BSD-3-Clause
"""Measures Fit Deformation after a measured point has moved: from the new numbers to the lattice.

Landmarks and pulls lie all over the volume. Traced points lie on the skin under an opening of 35 mm
and sag by 5 mm in the middle; about 250 anchors hold the rest. The fold guard is included.
"""

import numpy
from measure import Side, interleaved
from paraview import simple
from scene import AIR, ARRAY
from vtkmodules.util.numpy_support import vtk_to_numpy

OPENING_MM = 35.0
SAG_MM = 5.0
LANDMARKS, PULLS, TRACES, MANY = 16, 30, 300, 10_000
NAMES = {"fit landmarks": f"{LANDMARKS} landmarks", "fit pulls": f"one of {PULLS} pulls moved",
         "fit traces": f"{TRACES} traces, 250 anchors",
         "fit live": f"{TRACES} traces, 250 anchors, a pull held by a hand",
         "fit many traces": f"{MANY} traces"}


def _outermost(points):
    """The highest point of each column of 2 mm: what lies below is the skull or the brain."""
    order = points[:, 2].argsort()[::-1]
    columns = numpy.floor(points[order, :2] / 2.0)
    return points[order[numpy.unique(columns, axis=0, return_index=True)[1]]]


def _skin(scene):
    """Points of the skin."""
    skin = simple.Contour(Input=scene.source, ContourBy=["POINTS", ARRAY], Isosurfaces=[2 * AIR])
    skin.UpdatePipeline()
    points = vtk_to_numpy(skin.GetClientSideObject().GetOutputDataObject(0).GetPoints().GetData())
    simple.Delete(skin)
    return points.astype(float)


class Fits:
    """A fit of each kind."""

    def __init__(self, scene):
        self.scene, self.random, self.made = scene, numpy.random.default_rng(4), []
        size = numpy.array(scene.dimensions, dtype=float)
        rest = self.random.uniform(0.2, 0.8, (LANDMARKS, 3)) * size
        skin = _skin(scene)
        self.top = skin[skin[:, 2].argmax()]
        under = _outermost(skin[numpy.linalg.norm(skin - self.top, axis=1) < OPENING_MM])
        starts = self.random.uniform(0.2, 0.8, (PULLS, 3)) * size
        self.pulls = numpy.hstack([starts, starts + self.random.normal(0.0, 2.0, starts.shape),
                                   numpy.ones((PULLS, 1))])
        self.fits = {
            "fit landmarks": self.fit(
                RestLandmarks=self.points(rest),
                MeasuredLandmarks=self.points(rest + self.random.normal(0.0, 1.0, rest.shape))),
            "fit pulls": self.fit(Pulls=self.pulls.ravel().tolist()),
            "fit traces": self.trace_fit(under, TRACES),
            "fit live": self.trace_fit(under, TRACES, Live=1, Pulls=self.pulls[0].tolist()),
            "fit many traces": self.trace_fit(under, MANY)}

    def points(self, positions):
        self.made.append(simple.PolyPointSource(Points=positions.ravel().tolist()))
        return self.made[-1]

    def fit(self, **properties):
        made = simple.FitDeformation(
            Input=self.scene.source, SurfaceArray=ARRAY, Threshold=2 * AIR, **properties)
        self.made.insert(0, made)  # deleted before its inputs
        return made

    def trace_fit(self, under, count, **properties):
        chosen = under[self.random.integers(0, len(under), count)]
        away = numpy.linalg.norm(chosen - self.top, axis=1) / (1.2 * OPENING_MM)
        chosen[:, 2] -= SAG_MM * (1.0 - numpy.minimum(1.0, away) ** 2) ** 2
        chosen += self.random.normal(0.0, 0.3, chosen.shape)
        return self.fit(Traces=self.points(chosen), OpeningCentre=self.top.tolist(),
                        OpeningRadius=OPENING_MM, **properties)

    def move(self, key):
        """Moves the first pull, or the first point of an input, by a little. Not timed."""
        fit = self.fits[key]
        if key in ("fit pulls", "fit live"):
            self.pulls[0, 3] += 0.01
            fit.Pulls = (self.pulls[:1] if key == "fit live" else self.pulls).ravel().tolist()
        else:
            source = fit.MeasuredLandmarks if key == "fit landmarks" else fit.Traces
            numbers = list(source.Points)
            numbers[0] += 0.01
            source.Points = numbers
            source.UpdatePipeline()
        fit.UpdateVTKObjects()

    def close(self):
        for proxy in self.made:
            simple.Delete(proxy)


def measure_fits(scene, report, options, about):
    """Adds one group of rows, and holds each against its floor."""
    fits = Fits(scene)
    sides = [Side(name, fits.fits[key].UpdatePipeline, lambda key=key: fits.move(key))
             for key, name in NAMES.items()]
    rows = report.group("fit", "Fit Deformation after a point moved",
                        {**about, "window": options.windows[0]},
                        interleaved(sides, options.rounds, options.seconds))
    for key, name in NAMES.items():
        report.target(key, rows[name]["median"], rows[name]["quiet"])
    fits.close()
