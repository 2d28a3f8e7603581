# SPDX-License-Identifier: BSD-3-Clause
"""What tests of pictures of several MPI ranks ask: a Deformed Volume and ParaView's "Volume", drawn
alike, and what a Deformed Volume carries. As a script of pvbatch, this module writes the answers
into the file that it is given."""

import os
import sys

import numpy
from brainshift_testing import picture, show_volume, view_along
from paraview import simple
from ranks_testing import (COLORS, MIDDLE, OPACITIES, SIZE, TURN_DATA, TURN_INFORMATION,
                           load_plugin_on_ranks)

SIDE = 30  # voxels of 1 mm from the middle
OPAQUE = [0, 0, 0.5, 0, 200, 0, 0.5, 0, 210, 1, 0.5, 0]
MAPS = {"translucent": OPACITIES, "opaque": OPAQUE}
#: Displacements (mm) of strokes, about, and how far they reach (mm).
BENDS = {"0 mm": None, "8 mm": ((8, 2, 1), 25.0), "30 mm": ((28, 10, -9), 80.0)}
#: Balls inside tissue, before and behind it, and beside it: middle (mm) and radius.
BALLS = (((4, -3, 2), 12.0), ((-14, 8, 36), 5.0), ((6, 4, -40), 14.0), ((-44, 20, 0), 6.0))

# Labels of two balls that share a side, and of a shell around them.
LABELS = """
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
source, image = self.GetInputDataObject(0, 0), self.GetImageDataOutput()
x0, x1, y0, y1, z0, z1 = source.GetExtent()
z, y, x = numpy.mgrid[z0:z1 + 1, y0:y1 + 1, x0:x1 + 1]
away = numpy.sqrt((x - {x}) ** 2 + y ** 2 + z ** 2)
labels = numpy.where(away < 14, numpy.where(z > 1, 1, 2), numpy.where(away < 22, 3, 0))
array = numpy_to_vtk(labels.astype(numpy.uint8).ravel(), deep=True)
array.SetName("Labels")
image.CopyStructure(source)
image.GetPointData().SetScalars(array)
"""


def cube():
    return simple.Wavelet(WholeExtent=[-SIDE, SIDE] * 3)


def labelled(x=0):
    return simple.ProgrammableFilter(
        Input=cube(), OutputDataSetType="vtkImageData", Script=LABELS.format(x=x))


def turned(source):
    return simple.ProgrammableFilter(Input=source, OutputDataSetType="vtkImageData",
                                     Script=TURN_DATA, RequestInformationScript=TURN_INFORMATION)


def bent(bend="8 mm", source=None, **properties):
    import brainshift
    stroke = BENDS[bend]
    return simple.FreeFormDeformation(
        Input=source or cube(), Strokes=brainshift.soft(MIDDLE, *stroke) if stroke else [],
        **properties)


def see():
    return view_along((-0.5, 0.3, -1), MIDDLE, 150.0, size=SIZE)


def go_within(view):
    view.CameraParallelProjection = 0
    view.CameraPosition, view.CameraFocalPoint = [-20, 8, 15], [30, -9, 2]


def go_parallel(view):
    view.CameraParallelProjection, view.CameraParallelScale = 1, 40


#: How a view of `see` changes, one after the other.
CAMERAS = {"": lambda view: None, ", parallel": go_parallel, ", within": go_within}


def drawn_alike(found, name, source, kind, balls=()):
    """Pictures of both maps by all cameras."""
    for map_name, opacities in MAPS.items():
        view = see()
        show_volume(source, view, kind, COLORS, opacities, array="RTData", shade=True)
        for center, radius in balls:
            ball = simple.Show(simple.Sphere(
                Center=center, Radius=radius, ThetaResolution=40, PhiResolution=40), view,
                "GeometryRepresentation")
            ball.DisableLighting = 1
        for camera, go in CAMERAS.items():
            go(view)
            found[f"{name} {map_name}{camera}"] = picture(view)
        simple.Delete(view)


def answer_stock(found):
    drawn_alike(found, "stock", cube(), "Volume")
    drawn_alike(found, "stock turned", turned(cube()), "Volume")
    drawn_alike(found, "stock with balls", cube(), "Volume", BALLS)


def answer_bends(found):
    for bend in BENDS:
        drawn_alike(found, bend, bent(bend), "Deformed Volume")
    drawn_alike(found, "turned", bent(source=turned(cube())), "Deformed Volume")
    drawn_alike(found, "with balls", bent(), "Deformed Volume", BALLS)


def answer_attached(found):
    """Segments, a cavity with its tumour, and evidence, each bent and drawn in parts."""
    view = see()
    display = show_volume(bent(Segmentation=labelled()), view, "Deformed Volume", COLORS, OPAQUE,
                          array="RTData", shade=True)
    display.ScalarOpacityFunction.Points = [0, 0.3, 0.5, 0, 300, 0.3, 0.5, 0]
    for drawn in ([1], [2, 3]):
        display.DrawSegment, display.DrawnLabels = 1, drawn
        found[f"segments {drawn}"] = picture(view)
    simple.Delete(view)
    view = see()
    resected = simple.Resection(Input=bent(), Cavity=labelled(-25), Tumour=labelled(-18))
    display = show_volume(resected, view, "Deformed Volume", COLORS, OPACITIES, array="RTData",
                          shade=True)
    display.ScalarOpacityFunction.Points = [0, 0, 0.5, 0, 100, 0.4, 0.5, 0, 300, 0.9, 0.5, 0]
    found["resection"] = picture(view)
    simple.Delete(view)
    fit = simple.FitDeformation(Input=cube(), Threshold=200.0, Evidence=1,
                                Pulls=[0, 0, 3, 3, 2, -4, 1, 17, -18, 1, 1, 3, 2, 1])
    view = see()
    display = show_volume(simple.FreeFormDeformation(Input=cube(), Lattice=fit), view,
                          "Deformed Volume", COLORS, OPAQUE, array="RTData", shade=True)
    found["no evidence"] = picture(view)
    display.ShowEvidence = 1
    found["evidence"] = picture(view)
    simple.Delete(view)


def answers():
    """All pictures by name [row, column, colour]."""
    found = {}
    for answer in (answer_stock, answer_bends, answer_attached):
        answer(found)
    return found


if __name__ == "__main__":
    load_plugin_on_ranks()
    numpy.savez(sys.argv[1], **answers())
