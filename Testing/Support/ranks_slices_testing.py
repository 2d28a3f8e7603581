# SPDX-License-Identifier: BSD-3-Clause
"""What tests of Deformed Slices on several MPI ranks ask: pictures of planes, what is under their
pixels, and what the first rank has on its card. As a script of pvbatch, this module writes the
answers into the file that it is given."""

import os
import sys

import numpy
from brainshift_testing import look, picture, show_volume, view_along
from paraview import simple
from ranks_testing import (COLORS, OPACITIES, REFUSES, SIZE, TURN_DATA, TURN_INFORMATION, WIDE_HALO,
                           limit)
from slices_testing import PLANES, flat_view, show_slices
from vtkmodules.vtkParallelCore import vtkMultiProcessController

ALL = tuple(PLANES)
SIDE = 30  # voxels from the middle
MIDDLE = (0.0, 0.0, 0.0)
POSITION = (3.0, -2.0, 5.0)
PIXELS = [(x, y) for x in range(6, SIZE, 24) for y in range(6, SIZE, 24)]
#: What the first of several ranks reports then.
REFUSALS = ["MPI rank 1 of {}: its part of the volume, .* The first rank draws the whole volume"]
#: Why ranks draw no parts, as reported. Of slices alone there is no reason.
REASONS = ["a rank has no voxels of it", "two colours compare it with a reference"]

# Smooth, with noise that differs from voxel to voxel, on whatever part of the volume.
NOISE = """
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
given, made = self.GetInputDataObject(0, 0), self.GetImageDataOutput()
made.CopyStructure(given)
x0, x1, y0, y1, z0, z1 = given.GetExtent()
z, y, x = numpy.mgrid[z0:z1 + 1, y0:y1 + 1, x0:x1 + 1]
noise = (x * 7919 ^ y * 104729 ^ z * 1299709) % 61
values = 130 + 90 * numpy.sin(x / 5.0) * numpy.cos(y / 7.0 + z / 6.0) + noise
array = numpy_to_vtk(values.astype(numpy.{kind}).ravel(), deep=True)
array.SetName("RTData")
made.GetPointData().SetScalars(array)
"""


def noise(low=-SIDE, high=SIDE, kind="float32", turned=False):
    made = simple.ProgrammableFilter(
        Input=simple.Wavelet(WholeExtent=[low, high] * 3, Center=[0.5 * (low + high)] * 3),
        OutputDataSetType="vtkImageData", Script=NOISE.format(kind=kind))
    return made if not turned else simple.ProgrammableFilter(
        Input=made, OutputDataSetType="vtkImageData", Script=TURN_DATA,
        RequestInformationScript=TURN_INFORMATION)


def bent(source=None, **properties):
    import brainshift
    return simple.FreeFormDeformation(
        Input=source or noise(), Strokes=brainshift.soft(MIDDLE, (8, 2, 1), 25.0), **properties)


def see(direction=(-0.5, 0.3, -1), focus=MIDDLE, distance=150.0):
    return view_along(direction, focus, distance, size=SIZE)


def show(source, view, planes=ALL, position=POSITION, **properties):
    display = show_slices(source, view, planes, position, high=300.0, array="RTData")
    for name, value in properties.items():
        setattr(display, name, value)
    return display


def drawn(found, name, view, display=None):
    """Adds a picture to the answers, and the facts under some of its pixels."""
    found[name] = picture(view)
    if display is not None:
        found[name + " facts"] = numpy.array(
            [facts(display, view, *pixel) for pixel in PIXELS])


def facts(display, view, x, y):
    """The position under a pixel, the normal of its plane, and what is known of its tissue."""
    report = display.SMProxy.GetSessionProxyManager().NewProxy("misc", "DeformedVolumeReport")
    report.UnRegister(None)
    report.GetProperty("Representation").AddProxy(display.SMProxy)
    report.GetProperty("View").AddProxy(view.SMProxy)
    report.UpdateVTKObjects()  # all ranks look when they get the pixel
    report.GetProperty("Pixel").SetElements2(x, y)
    report.UpdateVTKObjects()
    numbers = []
    for name in ("Tissue", "Facts"):
        report.UpdatePropertyInformation(report.GetProperty(name))
        numbers += [report.GetProperty(name).GetElement(i)
                    for i in range(report.GetProperty(name).GetNumberOfElements())]
    return numbers


def scalar_bytes(display):
    import brainshift
    return numpy.array([brainshift.gpu(display)["gpuScalarBytes"]])


def answer_planes(found):
    """Opaque planes, near and far, and strokes within and beyond the halo."""
    import brainshift
    volume, view = bent(), see()
    display = show(volume, view)
    drawn(found, "planes", view, display)
    found["bytes bent"] = scalar_bytes(display)
    volume.Strokes = list(volume.Strokes) + list(brainshift.soft((9, -7, 4), (0, -4, 1), 12.0))
    drawn(found, "stroke", view, display)
    found["uploads"] = numpy.array(
        [brainshift.counters(display)[name] for name in ("volumeUploads", "latticeUploads")])
    volume.Strokes = brainshift.soft(MIDDLE, (30, 10, -10), 80.0)
    drawn(found, "far stroke", view, display)
    volume.Strokes = []
    drawn(found, "unbent", view, display)
    found["bytes unbent"] = scalar_bytes(display)
    display.ShowCrosshair = 1
    found["crosshair"] = picture(view)
    display.SlicePosition = [-29.0, 28.0, -29.5]  # some ranks draw nothing
    drawn(found, "near the sides", view, display)
    display.ShowAxial = display.ShowCoronal = 0
    drawn(found, "one plane", view, display)
    look(view, (1, 0.1, 0.1), MIDDLE, 40.0)
    drawn(found, "from within", view, display)
    simple.Delete(view)


def answer_filters(found):
    """Between two voxels: planes are there if a volume has an even number of them."""
    for kind in ("float32", "int16"):
        volume = bent(noise(-SIDE, SIDE - 1, kind))
        for interpolation in ("Nearest", "Linear", "Cubic"):
            view = see()
            display = show(volume, view, position=(-0.5,) * 3, SliceInterpolation=interpolation)
            drawn(found, f"{kind} {interpolation}", view,
                  display if interpolation == "Nearest" else None)
            simple.Delete(view)
    view = see()
    cells = simple.PointDatatoCellData(Input=noise())
    display = show_slices(simple.FreeFormDeformation(Input=cells), view, ALL, MIDDLE, high=300.0,
                          array="RTData", association="CELLS")
    drawn(found, "cells", view, display)
    simple.Delete(view)


def answer_flat(found):
    """Along the axes, pixels are on the very borders of the ranks' parts."""
    for axis, plane in enumerate(ALL):
        for size in (SIZE, SIZE + 1):
            view = flat_view(axis, MIDDLE, 33.0, size=size)
            display = show(bent(), view, (plane,), MIDDLE)
            drawn(found, f"{plane} {size}", view, display)
            display.Opacity = 0.6
            drawn(found, f"blended {plane} {size}", view)
            simple.Delete(view)


def answer_blended(found):
    volume = bent()
    for name, direction in (("", (-0.5, 0.3, -1)), (", from behind", (0.4, -0.7, 0.9))):
        view = see(direction)
        display = show(volume, view, Opacity=0.5)
        drawn(found, "blended" + name, view, display)
        display.ShowCrosshair = 1
        found["blended with crosshair" + name] = picture(view)
        display.ShowCrosshair, display.MapSliceOpacity = 0, 1
        drawn(found, "blended by the curve" + name, view, display)
        simple.Delete(view)


def answer_comparisons(found):
    """A reference that is turned and moved, in all ways, with uncertainty."""
    source = noise(-15, 15)
    fit = simple.FitDeformation(Input=source, Threshold=130.0, Evidence=1,
                                Pulls=[0, 0, 3, 3, 2, -4, 1, 7, -8, 1, 1, 3, 2, 1])
    volume = simple.FreeFormDeformation(Input=source, Lattice=fit)
    compare = simple.CompareVolumes(Input=volume, Reference=noise(-13, 13, "int16"),
                                    ReferenceRotation=[0, 0, 8],
                                    ReferenceTranslation=(1.5, -1.0, 0.5))
    view = see(distance=80.0)
    display = show(compare, view, WipePosition=[1.0, 0.5, 0.0], CheckerSize=7.0)
    for comparison in ("None", "Two colours", "Checkerboard", "Difference", "Gradient", "Wipe",
                       "Local similarity"):
        display.SliceComparison = comparison
        drawn(found, "comparison " + comparison, view, display)
        display.ShowEvidence = 1
        found[f"comparison {comparison}, evidence"] = picture(view)
        display.ShowEvidence = 0
    display.RankHalo = 0.0
    found["comparison Local similarity, no halo"] = picture(view)
    compare.Show = "Reference"
    drawn(found, "comparison, the reference alone", view, display)
    compare.Show, display.SliceComparison = "Both", "Wipe"
    compare.ReferenceTranslation = (-9.0, 6.0, 4.0)
    drawn(found, "comparison, moved far", view, display)
    simple.Delete(view)


def answer_scene(found):
    """Planes with a volume of the same and of other data, and with a surface."""
    volume, view = bent(), see((-0.4, 0.5, -0.8), (0, 0, 10), 220.0)
    display = show(volume, view)
    same = show_volume(bent(), view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    found["scene of the same"] = picture(view)
    same.Visibility = 0
    far = simple.Wavelet(WholeExtent=[-12, 12, -12, 12, 34, 58], Center=[0, 0, 46])
    show_volume(far, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    found["scene of others"] = picture(view)
    display.Opacity = 0.5
    found["scene, blended"] = picture(view)
    display.Opacity = 1.0
    ball = simple.Show(simple.Sphere(Center=(10, 8, 14), Radius=14, ThetaResolution=40,
                                     PhiResolution=40), view, "GeometryRepresentation")
    ball.DisableLighting = 1
    found["scene with a ball"] = picture(view)
    simple.Delete(view)


def answer_askew(found):
    """A volume whose axes are along no side of the boxes of the ranks."""
    view = see()
    display = show(bent(noise(turned=True)), view, ShowCrosshair=1)
    drawn(found, "askew", view, display)
    display.Opacity = 0.5
    found["blended askew"] = picture(view)
    simple.Delete(view)


def answer_four_views(found):
    import brainshift
    volume = bent()
    views = brainshift.four_views(volume)
    for name in ("axial", "coronal", "sagittal"):
        views[name].ViewSize = [SIZE, SIZE]
        found["four views, " + name] = picture(views[name])
    simple.GetDisplayProperties(volume, views["axial"]).SlicePosition = list(POSITION)
    for name in ("axial", "coronal", "sagittal"):
        found["four views moved, " + name] = picture(views[name])
    for view in views.values():
        simple.Delete(view)


def answer_whole(found):
    """What the first rank draws alone."""
    view = see(distance=6.0)
    display = show(simple.Wavelet(WholeExtent=[0, 1, 0, 1, 0, 1]), view, position=(0.5,) * 3)
    drawn(found, "few voxels", view, display)
    simple.Delete(view)
    view = see()
    display = show(bent(), view)
    both = simple.CompareVolumes(Input=bent(), Reference=noise())
    other = show_volume(both, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    other.VolumeComparison = 1
    found["beside two colours"] = picture(view)
    other.Visibility = 0
    drawn(found, "in parts again", view, display)
    simple.Delete(view)


def answer_refusal(found):
    """A rank gets no memory for its part, then it gets it."""
    volume = simple.FreeFormDeformation(Input=simple.Wavelet(WholeExtent=[-80, 80] * 3))
    volume.UpdatePipeline()
    view = see(distance=450.0)
    display = show(volume, view, RankHalo=WIDE_HALO)
    display.Visibility = 0
    picture(view)  # windows and mappers need memory, too
    limit(1, REFUSES)
    display.Visibility = 1
    found["one refuses"] = picture(view)
    found["bytes one refuses"] = scalar_bytes(display)
    limit(1, 0)
    display.RankHalo = 5.0
    drawn(found, "none refuses", view, display)
    found["bytes none refuses"] = scalar_bytes(display)
    simple.Delete(view)


#: What is asked where, each of several ranks: of 2 and of 4 what depends on their number.
QUESTIONS = {
    2: (answer_refusal, answer_planes, answer_filters, answer_comparisons, answer_whole),
    4: (answer_refusal, answer_planes, answer_flat, answer_blended, answer_four_views),
    8: (answer_planes, answer_blended, answer_four_views),
    "server": (answer_scene, answer_askew, answer_four_views)}


def answers(road):
    """The answers of ranks by name: pictures [row, column, colour], facts, bytes."""
    found = {}
    for ask in QUESTIONS[road]:
        ask(found)
    return found


if __name__ == "__main__":
    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=simple.__dict__)
    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=True, ns=simple.__dict__)
    ranks = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
    numpy.savez(sys.argv[1], **answers(ranks))
