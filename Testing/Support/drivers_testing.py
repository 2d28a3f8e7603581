# SPDX-License-Identifier: BSD-3-Clause
"""What a driver of OpenGL draws: one picture of each drawing feature, with empty-space skipping and
without. As a script of pvpython, this module writes the pictures, and the names of driver and
features, into the file that it is given."""

import os
import sys

import brainshift_testing as testing
import numpy
from brainshift_testing import ball, load_plugin, picture, show_volume, view_along, volume

SIZE = 128
MIDDLE = (16.0, 16.0, 16.0)
DIRECTION = (0.3, 0.2, -1.0)
COLORS = [0, 0.1, 0.3, 1, 50, 1, 0.6, 0.1, 100, 1, 1, 0.8]
FAINT = [0, 0, 0.5, 0, 20, 0, 0.5, 0, 100, 0.2, 0.5, 0]
OPAQUE = [0, 0, 0.5, 0, 30, 0, 0.5, 0, 50, 1, 0.5, 0, 100, 1, 0.5, 0]
SHADOW = [0, 0.9, 0.5, 0, 80, 0.2, 0.5, 0, 99, 0, 0.5, 0, 100, 0, 0.5, 0]
BLENDS = {"maximum": 1, "minimum": 2, "average": 3, "additive": 4, "isosurface": 5, "slice": 6}
UNSKIPPED = ", unskipped"
CROPPED = 0x2001  # VTK's cropping regions in the middle and in one corner

if __name__ == "__main__":
    load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402
from slices_testing import show_slices  # noqa: E402
from steepness_testing import faded, grid_of_table, table_of  # noqa: E402
from stock_testing import prop_of  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkPlane  # noqa: E402


def tissue(seed=3):
    """A ball with holes and lumps: much to skip, and edges in all directions."""
    random = numpy.random.default_rng(seed)
    voxels = ball(radius=11.0)
    for x, y, z in random.integers(6, 26, (24, 3)):
        voxels[z:z + 3, y:y + 3, x:x + 3] = random.uniform(0.0, 100.0)
    return voxels


def labels(radius):
    return volume((ball(radius=radius) > 50).astype(numpy.uint8))


def bent(voxels=None, **named):
    strokes = (brainshift.soft((16, 16, 22), (4, -3, -5), 14.0)
               + brainshift.soft((10, 14, 16), (-3, 4, 2), 9.0))
    return simple.FreeFormDeformation(Input=volume(tissue() if voxels is None else voxels),
                                      Strokes=strokes, **named)


def fitted():
    """A bent volume that a fit gives standard deviations."""
    source = simple.FreeFormDeformation(Input=volume(tissue()))
    brainshift.fit(source, pulls=[(MIDDLE, (16.0, 16.0, 20.0)),
                                  ((10, 12, 20), (12, 12, 22))]).filter.Evidence = 1
    return source


def compared(**named):
    return simple.CompareVolumes(Input=bent(), Reference=volume(tissue(seed=9)), **named)


def resected():
    source = bent(Segmentation=labels(9.0))
    return simple.Resection(Input=source, Tumour=labels(8.0), Cavity=labels(5.0))


def components(count):
    x = tissue()
    others = [100.0 - x, numpy.roll(x, 4, 0)][:max(count - 2, 0) + 1]
    return numpy.stack([*others, x, x][:count], axis=-1).astype(numpy.float32)


def alone(name, source, opacities=FAINT, configure=lambda display, view: None, shade=False,
          **properties):
    """A name, and a view of a volume with its display, until the next one is asked for."""
    view = view_along(DIRECTION, MIDDLE, 70.0, size=SIZE)
    testing.use_headlight(view)
    display = show_volume(source, view, "Deformed Volume", COLORS, opacities, shade=shade)
    for key, value in properties.items():
        setattr(display, key, value)
    configure(display, view)
    yield name, view, display
    simple.Delete(view)


def cut(display, view):
    picture(view)  # the mapper is there after it
    plane = vtkPlane()
    plane.SetOrigin(14.0, 15.0, 17.0)
    plane.SetNormal(-0.3, 0.4, -1.0)
    prop_of(view).GetMapper().AddClippingPlane(plane)


def crop(display, view):
    display.UseCropping, display.CroppingScale = 1, [0.5, 0.5, 0.5]
    picture(view)
    prop_of(view).GetMapper().SetCroppingRegionFlags(CROPPED)


def look_up_twice(display, view):
    scalar, steep = grid_of_table()
    picture(view)
    table = table_of(scalar, steep, 1.0 - scalar, numpy.where(scalar > 0.3, 0.4 * steep, 0.0))
    prop_of(view).GetProperty().SetTransferFunction2D(table)
    display.UseTransfer2D = 1


def with_a_surface(display, view):
    simple.Show(simple.Sphere(Center=(20, 14, 20), Radius=7.0), view).DiffuseColor = [0.9, 0.1, 0.1]


def with_traces(display, view):
    points = simple.PolyPointSource(Points=[16, 16, 31, 12, 20, 26, 16, 16, 4, 28, 16, 16])
    traces = simple.Show(points, view, "GeometryRepresentation")
    traces.SetRepresentationType("Trace Points")
    traces.DiffuseColor = traces.AmbientColor = [0.2, 1.0, 0.2]
    traces.TraceRadius = 1.5


def within(display, view):
    testing.look(view, DIRECTION, MIDDLE, 3.0)


def from_aside(display, view):
    testing.look(view, (1, 0, 0.1), MIDDLE, 70.0)
    view.CameraParallelProjection, view.CameraParallelScale = 1, 18.0


def rays():
    """Each feature of Deformed Volume."""
    yield from alone("opaque", bent(), OPAQUE)
    yield from alone("opaque, unbent", volume(tissue()), OPAQUE)
    yield from alone("translucent", bent())
    yield from alone("parallel", bent(), configure=from_aside)
    yield from alone("eye inside", bent(), configure=within)
    for light in ("Full resolution", "Half resolution", "On the fly"):
        yield from alone(f"shaded, {light}", bent(), OPAQUE, shade=True, VolumeNormalTexture=light)
    yield from alone("shaded, translucent", bent(), shade=True)
    yield from alone("occlusion", bent(), OPAQUE, shade=True, AmbientOcclusion=1.0)
    yield from alone("gradient opacity", bent(), configure=faded([0.0, 0.0, 6.0, 0.0, 20.0, 1.0]))
    yield from alone("2D transfer function", bent(), configure=look_up_twice)
    yield from alone("clipping planes", bent(), OPAQUE, configure=cut)
    yield from alone("cropping", bent(), OPAQUE, configure=crop)
    yield from alone("colours of voxels", bent(components(4)), MapScalars=0)
    yield from alone("colour and opacity", bent(components(2)), MultiComponentsMapping=1)
    for name, mode in BLENDS.items():
        voxels, opacities = (100.0 - tissue(), SHADOW) if name == "minimum" else (None, FAINT)
        yield from alone(name, bent(voxels), opacities, BlendMode=mode,
                         IsosurfaceValues=[35.0, 70.0], shade=mode > 4)
    yield from alone("segment", bent(Segmentation=labels(8.0)), OPAQUE, shade=True, DrawSegment=1)
    yield from alone("two colours", compared(), OPAQUE, shade=True)
    yield from alone("two colours, cavity", compared(Cavity=labels(5.0)))
    yield from alone("resection", resected(), OPAQUE, shade=True)
    yield from alone("evidence", fitted(), OPAQUE, ShowEvidence=1)
    yield from alone("a surface inside", bent(), configure=with_a_surface)
    yield from alone("trace points", bent(), OPAQUE, configure=with_traces)


def planes():
    """Each feature of Deformed Slices."""
    for name, source, properties in (
            ("slices", bent(), {"ShowCrosshair": 1}),
            ("slices, cubic", bent(), {"SliceInterpolation": "Cubic"}),
            ("slices, colours", bent(components(4)), {"MapScalars": 0}),
            ("slices, evidence", fitted(), {"ShowEvidence": 1}),
            ("slices, resection", resected(), {}),
            *((f"slices, {way}", compared(), {"SliceComparison": way})
              for way in ("Two colours", "Checkerboard", "Difference", "Gradient", "Wipe",
                          "Local similarity"))):
        view = view_along((0.5, 0.4, -1), MIDDLE, 70.0, size=SIZE)
        display = show_slices(source, view, ("Axial", "Coronal"), MIDDLE)
        for key, value in properties.items():
            setattr(display, key, value)
        yield name, view, None
        simple.Delete(view)


def driver_of(view):
    """What the driver calls itself: GL_RENDERER."""
    lines = view.GetRenderWindow().ReportCapabilities().splitlines()
    return next(line.split(":", 1)[1].strip() for line in lines if "renderer string" in line)


def drawn():
    """All pictures by name, as levels 0 to 255; those without skipping end with UNSKIPPED."""
    found = {}
    for scenes in (rays(), planes()):
        for name, view, display in scenes:
            found[name] = levels(view)
            if display is not None:
                display.EmptySpaceSkipping = 0
                found[name + UNSKIPPED] = levels(view)
            found["driver"] = numpy.array(driver_of(view))
    return found


def levels(view):
    return numpy.round(255.0 * picture(view)).astype(numpy.uint8)


if __name__ == "__main__":
    os.makedirs(os.path.dirname(sys.argv[1]), exist_ok=True)
    numpy.savez(sys.argv[1], **drawn())
