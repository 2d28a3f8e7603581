# SPDX-License-Identifier: BSD-3-Clause
"""What the scenes of the documentation share: the head and its brain, views, outlines, and the
picture file that holds several views side by side."""

import os
import sys
import tempfile

import numpy
from paraview import simple
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import demo  # noqa: E402

YELLOW, ORANGE, CYAN = (1.0, 0.84, 0.2), (1.0, 0.45, 0.0), (0.2, 0.85, 1.0)
CAMERA = ("CameraPosition", "CameraFocalPoint", "CameraViewUp")
COLORS = 256  # of a picture's palette
NEARER_MM = 9.0

# RAS mm: the middle of the brain, and a place on the cortex, left of the midline.
CENTRE = (-309.0, 22.0, 477.0)
CORTEX = (-340.0, 30.0, 515.0)
BRAIN_FOCUS, BRAIN_EYE, BRAIN_ANGLE = (-310, 24, 468), (-170, 480, 90), 16.5
HEAD_FOCUS, HEAD_EYE, HEAD_ANGLE = (-309, 28, 476), (-550, 350, 250), 19

_kept, _kept_sources = {}, []


def once(name, make):
    """What make() returns, made once and kept for other scenes, with the sources it made."""
    if name not in _kept:
        before = list(simple.GetSources().values())
        _kept[name] = make()
        _kept_sources.extend(source for source in simple.GetSources().values()
                             if source not in before)
    return _kept[name]


def head():
    """The MR of the test data."""
    return once("head", lambda: demo.open_volume("Head", "seg3d_mr_t1.nii.gz"))


def mask():
    """Its brain mask."""
    return once("mask", lambda: demo.open_volume("Brain mask", "seg3d_brainmask.nii.gz"))


def brain():
    """The MR without its skull, array "Brain"."""
    return once("brain", lambda: demo.brain_alone(head(), mask()))


def labels_of(name, inside):
    """A source of labels on the grid of the mask: 1 where inside(positions) is true, an array for
    N x 3 positions (mm)."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    grid = simple.FetchData(mask())[0]
    side = grid.GetDimensions()
    z, y, x = numpy.indices(side[::-1]).reshape(3, -1)
    matrix = grid.GetIndexToPhysicalMatrix()
    world = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(3)])
    positions = numpy.stack((x, y, z), axis=1) @ world[:, :3].T + world[:, 3]
    made = grid.NewInstance()
    made.CopyStructure(grid)
    array = numpy_to_vtk(inside(positions).astype(numpy.uint8), deep=True)
    array.SetName(name)
    made.GetPointData().SetScalars(array)
    source = simple.TrivialProducer(registrationName=name)
    source.GetClientSideObject().SetOutput(made)
    return source


def clear():
    """Deletes everything but the volumes that scenes share."""
    for view in simple.GetViews():
        simple.Delete(view)
    for source in reversed(list(simple.GetSources().values())):
        if source not in _kept_sources:
            simple.Delete(source)


def bend(volume, strokes=(), **properties):
    return simple.FreeFormDeformation(Input=volume, Strokes=strokes, **properties)


def push(amount=-12.0, major=80.0, minor=45.0):
    """A stamp at the cortex, towards the middle of the brain."""
    import brainshift
    return brainshift.stamp(CORTEX, CENTRE, amount, major=major, minor=minor)


def view(side):
    made = simple.CreateView("RenderView", ViewSize=(side, side))
    made.UseColorPaletteForBackground = 0
    made.BackgroundColorMode = "Single Color"
    made.Background = demo.BACKGROUND
    made.OrientationAxesVisibility = 0
    made.CenterAxesVisibility = 0
    return made


def _look(made, focus, eye, angle):
    simple.Render(made)  # the first picture of a view finds a camera of its own
    demo.frame(made, focus, eye, angle)


def look_at_brain(made):
    """From the front, with what the stamp bends against the background."""
    _look(made, BRAIN_FOCUS, BRAIN_EYE, BRAIN_ANGLE)


def brain_view(deformed, side):
    """A brain as Deformed Volume."""
    made = view(side)
    demo.look_like_tissue("Brain", demo.CORTEX_COLORS, demo.CORTEX_OPACITIES)
    demo.show(deformed, "Brain", made)
    look_at_brain(made)
    return made


def show_head(deformed, made):
    """A head as Deformed Volume, seen from the left."""
    demo.look_like_tissue("Intensity", demo.SKIN_COLORS, demo.SKIN_OPACITIES)
    demo.show(deformed, "Intensity", made)
    _look(made, HEAD_FOCUS, HEAD_EYE, HEAD_ANGLE)
    made.BackgroundColorMode = "Single Color"


def head_view(deformed, side):
    made = view(side)
    show_head(deformed, made)
    return made


def flat_view(side, focus, half_height, plane="Coronal"):
    """A view along an axis, radiological: coronal slices from the front, axial ones from below."""
    eye, up = {"Coronal": ((0, 1, 0), (0, 0, 1)), "Sagittal": ((-1, 0, 0), (0, 0, 1)),
               "Axial": ((0, 0, -1), (0, 1, 0))}[plane]
    made = view(side)
    made.Background = (0.0, 0.0, 0.0)
    made.InteractionMode = "2D"
    made.CameraParallelProjection = 1
    made.CameraFocalPoint = focus
    made.CameraPosition = [f + 400.0 * e for f, e in zip(focus, eye)]
    made.CameraViewUp = up
    made.CameraParallelScale = half_height
    return made


def show_slices(volume, made, planes=("Coronal",), array="Intensity", position=CORTEX, white=420.0):
    """A volume as grey Deformed Slices; returns its display."""
    camera, half_height = [list(getattr(made, name)) for name in CAMERA], made.CameraParallelScale
    display = simple.Show(volume, made, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    simple.ColorBy(display, ("POINTS", array), separate=True)
    display.SetScalarBarVisibility(made, False)
    color = simple.GetColorTransferFunction(array, display, separate=True)
    color.ColorSpace = "RGB"
    color.RGBPoints = (0, 0, 0, 0, white, 1, 1, 1)
    opacity = simple.GetOpacityTransferFunction(array, display, separate=True)
    opacity.Points = (0, 0, 0.5, 0, 15, 0, 0.5, 0, 35, 1, 0.5, 0, white, 1, 0.5, 0)
    for plane in ("Sagittal", "Coronal", "Axial"):
        setattr(display, f"Show{plane}", int(plane in planes))
    display.SlicePosition = position
    simple.Render(made)  # the first picture of a view finds a camera of its own
    for name, value in zip(CAMERA, camera):
        setattr(made, name, value)
    made.CameraParallelScale = half_height
    return display


def show_surface(source, made, color=(0.9, 0.9, 0.9), **properties):
    """Geometry in one colour; returns its display."""
    display = simple.Show(source, made)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = color
    for name, value in properties.items():
        setattr(display, name, value)
    return display


def color_by(source, made, array, title, low, high, component="Magnitude"):
    """Colours geometry by an array, with a scale at the right; returns its display."""
    display = simple.Show(source, made)
    simple.ColorBy(display, ("POINTS", array, component) if component else ("POINTS", array))
    color = simple.GetColorTransferFunction(array)
    color.RescaleTransferFunction(low, high)
    bar = simple.GetScalarBar(color, made)
    bar.Title, bar.ComponentTitle = title, ""
    bar.RangeLabelFormat = "{:.3g}" if "{" in bar.RangeLabelFormat else "%.3g"
    bar.HorizontalTitle, bar.ScalarBarLength = 1, 0.3
    bar.WindowLocation, bar.Position = "Any Location", (0.84, 0.03)
    bar.TitleFontSize = bar.LabelFontSize = max(6, made.ViewSize[1] // 32)
    display.SetScalarBarVisibility(made, True)
    return display


def cortex(volume):
    """A mesh of the cortex: array "Brain" at one value."""
    return simple.Contour(Input=volume, ContourBy=["POINTS", "Brain"], Isosurfaces=[115.0])


def as_bent(lattice):
    """Control points of an image where they are after the deformation."""
    return simple.WarpByVector(Input=lattice, Vectors=["POINTS", "Displacement"], ScaleFactor=1.0)


def line(points):
    return simple.PolyLineSource(Points=numpy.asarray(points, float).ravel().tolist())


def rings(centre, axis, major, minor):
    """Three ellipses around a centre (mm): along the axis twice and across it."""
    along = numpy.asarray(axis, float) / numpy.linalg.norm(axis)
    side = numpy.cross(along, (0.0, 1.0, 0.0))
    side /= numpy.linalg.norm(side)
    other = numpy.cross(along, side)
    turn = numpy.linspace(0.0, 2.0 * numpy.pi, 73)[:, None]
    pairs = ((major * along, minor * side), (major * along, minor * other),
             (minor * side, minor * other))
    return [line(centre + numpy.cos(turn) * a + numpy.sin(turn) * b) for a, b in pairs]


def show_outline(lines, made, color, width_mm=0.5):
    """Lines as tubes in one colour that needs no light."""
    for curve in lines:
        tube = simple.Tube(Input=curve, Radius=width_mm)
        show_surface(tube, made, color, Ambient=1.0, Diffuse=0.0, Specular=0.0)


def show_balls(points, made, color, radius_mm=1.5):
    """Balls, a little towards the eye, so that the tissue around them does not hide them."""
    towards_eye = numpy.subtract(made.CameraPosition, made.CameraFocalPoint)
    points = points + NEARER_MM * towards_eye / numpy.linalg.norm(towards_eye)
    balls = simple.Glyph(
        Input=simple.PolyPointSource(Points=numpy.asarray(points, float).ravel().tolist()),
        GlyphType="Sphere", GlyphMode="All Points", ScaleArray=["POINTS", "No scale array"])
    balls.ScaleFactor = 2 * radius_mm
    balls.GlyphType.ThetaResolution = balls.GlyphType.PhiResolution = 24
    show_surface(balls, made, color, Ambient=0.3, Diffuse=0.7)


def pixels(made):
    """Height x width x 3 bytes, top row first."""
    simple.Render(made)
    image = made.SMProxy.CaptureWindow(1)
    width, height, _ = image.GetDimensions()
    found = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).copy()
    image.UnRegister(None)
    return found[::-1, :, :3]


def pixels_of_layout(layout, size):
    """The picture of a whole layout, width x height pixels."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "layout.png")
        simple.SaveScreenshot(file, layout, ImageResolution=size, SeparatorWidth=1,
                              SeparatorColor=(1.0, 1.0, 1.0))
        return numpy.asarray(Image.open(file).convert("RGB"))


def side_by_side(views):
    """The pictures of several views of one height, in a row."""
    return numpy.hstack([pixels(made) for made in views])


def write(picture, file):
    """As a PNG, grey where it has no colours, else with a palette: a third as large."""
    image = Image.fromarray(numpy.ascontiguousarray(picture))
    if (picture == picture[:, :, :1]).all():
        image = image.convert("L")
    else:
        image = image.quantize(COLORS, Image.Quantize.MAXCOVERAGE, kmeans=2,
                               dither=Image.Dither.FLOYDSTEINBERG)
    image.save(file, optimize=True)


demo.load_plugin()
