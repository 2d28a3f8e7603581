# SPDX-License-Identifier: BSD-3-Clause
# Proves that every program of the renderer draws with each of its uniforms set: numbers, matrices
# and textures. The renderer gives uniforms of a new program values that nobody would set, and
# writes into a log which of them still have those values after the program has drawn.
import os
import shutil

import numpy
from brainshift_testing import (ball, load_plugin, look, picture, run_tests, scratch, show_volume,
                                use_headlight, view_along, volume)

LOG = scratch("uniforms.log")
os.environ["BRAINSHIFT_UNIFORM_LOG"] = LOG
load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    ClearSelection, CompareVolumes, Delete, FreeFormDeformation, OMEZarrReader, PolyPointSource,
    Resection, SelectSurfaceCells, Show, Sphere)
from slices_testing import show_slices  # noqa: E402
from steepness_testing import grid_of_table, table_of  # noqa: E402
from stock_testing import prop_of  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkPlane  # noqa: E402

MIDDLE = (16.0, 16.0, 16.0)
STROKE = brainshift.soft(MIDDLE, (0, 0, 4), 14)
COLORS = [0, 1, 0.5, 0, 100, 1, 1, 1]
FAINT = [0, 0, 0.5, 0, 20, 0, 0.5, 0, 100, 0.1, 0.5, 0]
OPAQUE = [0, 0, 0.5, 0, 30, 0, 0.5, 0, 70, 1, 0.5, 0, 100, 1, 0.5, 0]
STEEP = [0, 0, 0.5, 0, 50, 0, 0.5, 0, 50.5, 1, 0.5, 0, 100, 1, 0.5, 0]
COMPOSITE, MAXIMUM, MINIMUM, AVERAGE, ADDITIVE, ISOSURFACE, SLICE = range(7)
LIGHTS = (None, "On the fly", "Half resolution")
CROPPED = 0x2001  # VTK's cropping regions in the middle and in one corner


def components(*arrays):
    return volume(numpy.stack(arrays, axis=-1).astype(numpy.float32))


class Drawn:
    """A volume in a view of its own, lit by one lamp and cut by one plane."""

    def __init__(self, source, opacities=FAINT, first=MAXIMUM, size=40):
        self.view = view_along((0.3, 0.2, -1), MIDDLE, 90.0, size=size)
        use_headlight(self.view)
        self.display = show_volume(source, self.view, "Deformed Volume", COLORS, opacities)
        self.display.SliceFunction.Origin = list(MIDDLE)
        self.display.IsosurfaceValues = [40.0]
        self.display.BlendMode = first
        picture(self.view)  # makes the mapper, which is not cut yet
        plane = vtkPlane()
        plane.SetOrigin(2.0, 2.0, 2.0)
        prop_of(self.view).GetMapper().AddClippingPlane(plane)

    def draw(self, light=None, mode=COMPOSITE, regions=False, **properties):
        self.display.Shade = int(light is not None)
        self.display.VolumeNormalTexture = light or "On the fly"
        self.display.BlendMode = mode
        self.display.UseCropping = int(regions)
        if regions:
            self.display.CroppingScale = [0.5, 0.5, 0.5]
        for name, value in properties.items():
            setattr(self.display, name, value)
        picture(self.view)
        if regions:
            prop_of(self.view).GetMapper().SetCroppingRegionFlags(CROPPED)
        look(self.view, (0.3, 0.2, -1), MIDDLE, 91.0)
        picture(self.view)  # the last program of a picture is looked at by the next one

    def close(self):
        Delete(self.view)


def bent_and_not(source):
    return source, FreeFormDeformation(Input=source, Strokes=STROKE)


def test_blend_modes_and_light():
    for source in bent_and_not(volume(ball())):
        drawn = Drawn(source)
        for light in LIGHTS:
            for mode in (COMPOSITE, ISOSURFACE, SLICE):
                drawn.draw(light, mode)
        for mode in (MAXIMUM, MINIMUM, AVERAGE, ADDITIVE):
            drawn.draw(None, mode)
        drawn.draw("Half resolution", regions=True)
        drawn.close()
        drawn = Drawn(source, OPAQUE, first=MINIMUM)
        drawn.draw(None, MAXIMUM)
        drawn.draw("Half resolution", CountSamples=1)
        drawn.draw("Half resolution", AmbientOcclusion=1.0)
        drawn.close()


def test_colours_of_voxels():
    x = ball()
    for numbers, named in ((components(x, x, x, x), {"MapScalars": 0}),
                           (components(x, x), {"MultiComponentsMapping": 1})):
        for source in bent_and_not(numbers):
            drawn = Drawn(source)
            drawn.draw("Half resolution", **named)
            drawn.draw(None, MAXIMUM, regions=True)
            drawn.close()


def draw_steep(source, opacities, largest, **segment):
    """Draws with gradient opacity, and with a 2D transfer function of that largest opacity."""
    scalar, steep = grid_of_table()
    table = table_of(scalar, steep, scalar, numpy.where(scalar > 0.2, largest, 0.0))
    for light in (None, "On the fly"):
        drawn = Drawn(source, opacities)
        drawn.draw(light, GradientOpacity=[0, 0, 5, 1], **segment)
        prop_of(drawn.view).GetProperty().SetTransferFunction2D(table)
        drawn.draw(light, UseTransfer2D=1, **segment)
        drawn.close()


def test_opacity_by_gradients():
    for source in bent_and_not(volume(ball())):
        draw_steep(source, FAINT, 0.1)
        draw_steep(source, OPAQUE, 1.0)
    labels = volume((ball() > 50).astype(numpy.uint8))
    source = FreeFormDeformation(Input=volume(ball()), Segmentation=labels, Strokes=STROKE)
    draw_steep(source, STEEP, 0.1, DrawSegment=1)


def test_segment():
    labels = volume((ball() > 50).astype(numpy.uint8))
    for strokes in ((), STROKE):
        source = FreeFormDeformation(Input=volume(ball()), Segmentation=labels,
                                     Strokes=list(strokes))
        drawn = Drawn(source)
        drawn.display.DrawSegment = 1
        drawn.draw("Half resolution")
        drawn.draw("Half resolution", ISOSURFACE)
        drawn.draw(None, AVERAGE)
        drawn.close()
        steep = Drawn(source, STEEP)
        steep.display.DrawSegment = 1
        for light in LIGHTS:
            steep.draw(light, CountSamples=1)
        steep.close()


def test_streamed():
    path = scratch("streamed.ome.zarr")
    shutil.rmtree(path, ignore_errors=True)
    brainshift.pyramid(volume(ball(side=80, radius=25.0)), path)
    for source in bent_and_not(OMEZarrReader(FileName=path, MemoryLimit=0.5)):
        for opacities, named in ((FAINT, {}), (STEEP, {"CountSamples": 1})):
            drawn = Drawn(source, opacities)
            for light in (None, "On the fly"):
                drawn.draw(light, CountSamples=0)
                state = brainshift.draw_detail(drawn.view, drawn.display)
                assert state["gpuLevel"] == 0 and state["gpuBricks"] > 0, state
                drawn.draw(light, **named)
            drawn.close()
        view = view_along((0.3, 0.2, -1), (40, 40, 40), 190.0, size=80)
        display = show_slices(source, view, ("Axial", "Coronal"), (40, 40, 40))
        state = brainshift.draw_detail(view, display)
        assert state["gpuLevel"] == 0 and state["gpuBricks"] > 0, state
        display.SlicePosition = [40, 40, 30]  # the last program is looked at by the next one
        picture(view)
        Delete(view)


def test_reference():
    hole = volume((ball(radius=3.0) > 50).astype(numpy.uint8))
    for source in bent_and_not(volume(ball())):
        for cavity in (None, hole):
            compare = CompareVolumes(Input=source, Reference=volume(ball(radius=7.0)),
                                     Cavity=cavity)
            drawn = Drawn(compare)
            for light in LIGHTS:
                drawn.draw(light, regions=cavity is not None,
                           CountSamples=int(cavity is not None))
            drawn.close()


def test_mask():
    mask = volume((ball() > 1).astype(numpy.uint8))
    drawn = Drawn(FreeFormDeformation(Input=volume(ball()), Mask=mask, Strokes=STROKE))
    drawn.draw()
    drawn.close()


def test_slices():
    x = ball()
    bent = FreeFormDeformation(Input=volume(x), Strokes=STROKE)
    two = FreeFormDeformation(Input=components(x, x), Strokes=STROKE)
    four = FreeFormDeformation(Input=components(x, x, x, x), Strokes=STROKE)
    hole = volume((ball(radius=3.0) > 50).astype(numpy.uint8))
    for source, named in (
            (volume(x), {}), (bent, {}), (four, {"MapScalars": 0}),
            (CompareVolumes(Input=two, Reference=volume(x)),
             {"MultiComponentsMapping": 1, "SliceComparison": "Wipe"}),
            (CompareVolumes(Input=bent, Reference=volume(x), Cavity=hole),
             {"SliceComparison": "Difference"})):
        view = view_along((0.3, 0.2, -1), MIDDLE, 90.0, size=40)
        display = show_slices(source, view, ("Axial", "Coronal"), MIDDLE)
        for name, value in named.items():
            setattr(display, name, value)
        for _ in range(2):
            picture(view)
        Delete(view)


def test_evidence():
    bent = FreeFormDeformation(Input=volume(ball()))
    fit = brainshift.fit(bent, pulls=[(MIDDLE, (16.0, 16.0, 18.0))])
    fit.filter.Evidence = 1
    both = CompareVolumes(Input=bent, Reference=volume(ball(radius=7.0)))
    for source, opacities in ((bent, FAINT), (bent, STEEP), (both, FAINT)):
        drawn = Drawn(source, opacities)
        for mode in (COMPOSITE, ISOSURFACE, SLICE):
            drawn.draw("Half resolution", mode, ShowEvidence=1)
        drawn.close()
    for source in (bent, both):
        view = view_along((0.3, 0.2, -1), MIDDLE, 90.0, size=40)
        display = show_slices(source, view, ("Axial",), MIDDLE)
        display.ShowEvidence = 1
        if source is both:
            display.SliceComparison = "Difference"
        for _ in range(2):
            picture(view)
        Delete(view)


def test_resection():
    labels, hole = (volume((ball(radius=radius) > 50).astype(numpy.uint8)) for radius in (9.0, 3.0))
    bent = FreeFormDeformation(Input=volume(ball()), Segmentation=labels, Strokes=STROKE)
    source = Resection(Input=bent, Tumour=labels, Cavity=hole)
    drawn = Drawn(source, first=MINIMUM)  # which is not cut, and each program is looked at once
    drawn.draw(None, MAXIMUM)
    for mode in (COMPOSITE, ISOSURFACE, SLICE):
        drawn.draw("Half resolution", mode)
    drawn.close()
    drawn = Drawn(source, STEEP)
    drawn.draw("On the fly", DrawSegment=1)
    drawn.close()
    drawn = Drawn(CompareVolumes(Input=source, Reference=volume(ball(radius=7.0))))
    drawn.draw("Half resolution")
    drawn.close()
    view = view_along((0.3, 0.2, -1), MIDDLE, 90.0, size=40)
    show_slices(source, view, ("Axial",), MIDDLE)
    for _ in range(2):
        picture(view)
    Delete(view)


def test_moving_picture():
    # While a stroke changes, a part of the picture is drawn with fewer pixels and enlarged.
    filter = FreeFormDeformation(Input=volume(ball()), Strokes=STROKE)
    drawn = Drawn(filter, OPAQUE, size=300)
    drawn.display.SampleDistance = 0.02  # so slow that a moving picture cannot have all pixels
    drawn.display.KeepPicture = 1
    drawn.display.BlendMode = COMPOSITE
    picture(drawn.view)
    for amount in (1, 2, 3):
        filter.Strokes = brainshift.soft((12, 13, 9), (0, 0, -amount), 4)
        drawn.view.SMProxy.InteractiveRender()
        picture(drawn.view)
    drawn.close()


def test_traces_and_selection():
    drawn = Drawn(volume(ball()), OPAQUE)
    sphere = Sphere(Center=(16, 16, 30), Radius=2.0)
    Show(sphere, drawn.view)
    SelectSurfaceCells(Rectangle=[0, 0, 39, 39], View=drawn.view)
    ClearSelection(sphere)
    traces = Show(PolyPointSource(Points=[16, 16, 30, 16, 16, 4]), drawn.view,
                  "GeometryRepresentation")
    traces.SetRepresentationType("Trace Points")
    drawn.draw()
    for _ in range(3):
        show_volume(volume(ball()), drawn.view, "Deformed Volume", COLORS, OPAQUE)
    drawn.draw()
    drawn.close()
    view = view_along((0.3, 0.2, -1), MIDDLE, 90.0, size=40)
    Show(PolyPointSource(Points=[16, 16, 30]), view,
         "GeometryRepresentation").SetRepresentationType("Trace Points")
    picture(view)
    picture(view)
    Delete(view)


#: Arrays that nothing is set of where their count is 0. Each program is drawn with a count above 0
#: too.
MAY_BE_EMPTY = {"clipPlanes[0]"}


def is_out_of_reach(name):
    """Whether no pipeline draws with a program: a filter that attaches segments makes a lattice."""
    return "_rest_" in name and "_segment" in name


def test_all_are_set():
    with open(LOG, encoding="utf-8") as log:
        listed, *drawn = [line.split() for line in log]
    unset = [line for line in drawn if set(line[1:]) - MAY_BE_EMPTY]
    assert not unset, f"drawn with uniforms that were not set: {unset}"
    missing = {name for name in listed[1:] if not is_out_of_reach(name)}
    missing -= {name for name, *empty in drawn if not empty}
    print(f"  {len(drawn)} programs, {len(listed) - 1} listed", flush=True)
    assert not missing, f"not drawn with all uniforms set: {sorted(missing)}"


run_tests(globals())
