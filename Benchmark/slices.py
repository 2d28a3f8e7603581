# SPDX-License-Identifier: BSD-3-Clause
"""Measures three flat views of one slice each, and ParaView's own filter Slice.

Our side draws the bent volume. Stock cuts the volume that our Bake Deformation made of it. A user
without BrainShift has vtkImageReslice instead, which takes longer: see the group "bake". A stock
slice is a surface with one point for each voxel. Ours looks the volume up at every pixel.
"""

from measure import Side, interleaved
from paraview import simple
from scene import ARRAY

OURS, CUBIC = "ours, bent", "ours, bent, cubic"
STOCK = "Slice of the baked volume"
PLANES = ("Sagittal", "Coronal", "Axial")
STEP = 1.0  # mm, a voxel


def _flat_view(axis, middle, half_height, window):
    view = simple.CreateView("RenderView")
    view.ViewSize = [window, window]
    view.UseColorPaletteForBackground = 0
    view.Background = [0.0, 0.0, 0.0]
    view.OrientationAxesVisibility = view.CenterAxesVisibility = view.UseFXAA = 0
    view.CameraParallelProjection = 1
    view.CameraParallelScale = half_height
    view.CameraFocalPoint = list(middle)
    view.CameraPosition = [m + 1000.0 * (i == axis) for i, m in enumerate(middle)]
    view.CameraViewUp = [0, 1, 0] if axis == 2 else [0, 0, 1]
    return view


class Slices:
    """Three views of a scene, each with our plane and ParaView's, of which one is shown."""

    def __init__(self, scene, window):
        self.scene = scene
        self.position = list(scene.centre)
        self.moved = 0
        self.views, self.cuts, self.shown = [], [], {OURS: [], STOCK: []}
        for axis, plane in enumerate(PLANES):
            view = _flat_view(axis, scene.centre, max(scene.centre), window)
            ours = simple.Show(scene.bent, view, "UniformGridRepresentation")
            ours.SetRepresentationType("Deformed Slices")
            for other in PLANES:
                setattr(ours, f"Show{other}", int(other == plane))
            cut = simple.Slice(Input=scene.bake)
            cut.SliceType.Normal = [float(i == axis) for i in range(3)]
            stock = simple.Show(cut, view, "GeometryRepresentation")
            stock.SetPropertyWithName("DisableLighting", 1)
            for display in (ours, stock):
                simple.ColorBy(display, ("POINTS", ARRAY))
                display.SetScalarBarVisibility(view, False)
            self.views.append(view)
            self.cuts.append(cut)
            self.shown[OURS].append(ours)
            self.shown[STOCK].append(stock)
        for view in self.views:
            view.UseFXAA = 0  # a new view turns it on for all
        self.place()

    def close(self):
        for proxy in self.views + self.cuts:
            simple.Delete(proxy)

    def place(self):
        for ours, cut in zip(self.shown[OURS], self.cuts):
            ours.SlicePosition = self.position
            cut.SliceType.Origin = self.position

    def move(self):
        """To the next slice, or back."""
        self.moved += 1
        step = STEP if self.moved % 2 else -STEP
        self.position = [coordinate + step for coordinate in self.position]
        self.place()

    def show(self, kind, interpolation="Linear"):
        for name, displays in self.shown.items():
            for display in displays:
                display.Visibility = int(name == kind)
        for display in self.shown[OURS]:
            display.SliceInterpolation = interpolation

    def frame(self):
        """Three pictures, finished."""
        for view in self.views:
            view.SMProxy.StillRender()
            view.GetClientSideObject().GetRenderWindow().WaitForCompletion()

    def sides(self, before=None):
        """What each side does for three pictures, after a change that is part of it."""

        def run():
            if before:
                before()
            self.frame()

        return [Side(OURS, run, lambda: self.show(OURS)),
                Side(CUBIC, run, lambda: self.show(OURS, "Cubic")),
                Side(STOCK, run, lambda: self.show(STOCK))]


def measure_slices(scene, report, options, about):
    """Adds three groups of rows: nothing changes, the slices move, a stroke changes."""
    window = options.windows[0]
    slices = Slices(scene, window)
    for kind, before in (("slices, steady", None), ("slices, moved", slices.move),
                         ("slices, edited", scene.edit)):
        report.group(kind, f"{kind}, three of {window}x{window}", {**about, "window": window},
                     interleaved(slices.sides(before), options.rounds, options.seconds))
    slices.close()
