# SPDX-License-Identifier: BSD-3-Clause
# Proves that ambient occlusion is what its formula says, computed here from picked positions: none
# on a plane, more in a groove than on a ridge, less in translucent tissue, the same after bending
# as after baking, and the same at any step. A part of a picture equals the whole, and pictures
# without occlusion stay the same.
import os

import brainshift_testing as testing
import numpy
from brainshift_testing import on_screen, volume

testing.load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (BakeDeformation, CompareVolumes, Delete,  # noqa: E402
                             FreeFormDeformation, SaveScreenshot)
from skipping_testing import assert_same  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

SIDE = 49
MIDDLE = (24.0, 24.0, 24.0)
ASLANT = (0.25, 0.35, -1.0)
DISTANCE = 90.0
WAVE = 14.0  # mm from ridge to ridge
RADIUS = 5.0  # mm, of occlusion
STEP = 0.5  # mm
WHITE = [0, 1, 1, 1, 100, 1, 1, 1]
SURFACE = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0]
TRANSLUCENT = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 0.15, 0.5, 0, 100, 0.15, 0.5, 0]
LEVEL = 1.0  # of 255
STROKE = brainshift.soft((24.0, 24.0, 26.0), (0.0, 0.0, -5.0), 14.0)


def tissue(height):
    """A block below height(x, y); its upper face looks along z."""
    z, y, x = numpy.mgrid[0:SIDE, 0:SIDE, 0:SIDE].astype(float)
    inside = numpy.minimum(height(x, y) - z, 0.5 * SIDE - 4 - numpy.maximum(
        abs(x - MIDDLE[0]), abs(y - MIDDLE[1])))
    return (100.0 * numpy.clip(inside / 2 + 0.5, 0, 1)).astype(numpy.float32)


def waves(x, y):
    return 26.0 + 4.5 * numpy.cos(2 * numpy.pi * (x - MIDDLE[0]) / WAVE)


def bumps(x, y):
    return waves(x, y) + 2.0 * numpy.sin(0.5 * y) + 0.03 * (x - MIDDLE[0]) * (y - MIDDLE[1])


class Drawn:
    """Tissue of one colour in even light: all that changes its colour is occlusion."""

    def __init__(self, source, size=120, direction=ASLANT, radius=RADIUS, opacities=SURFACE,
                 **named):
        self.size = size
        self.view = testing.view_along(direction, MIDDLE, DISTANCE, size=size, **named)
        testing.use_headlight(self.view)
        self.display = testing.show_volume(source, self.view, "Deformed Volume", WHITE, opacities,
                                           shade=True)
        self.display.Ambient, self.display.Diffuse, self.display.Specular = 1.0, 0.0, 0.0
        self.display.SampleDistance = STEP
        self.display.OcclusionRadius = radius

    def picture(self, darkness=None, **properties):
        """Levels, 0 to 255, indexed [row from below, column]."""
        if darkness is not None:
            self.display.AmbientOcclusion = darkness
        for name, value in properties.items():
            setattr(self.display, name, value)
        self.view.SMProxy.StillRender()
        return on_screen(self.view)[:, :, 0]

    def hidden(self):
        """The share of light that is hidden, and where tissue is opaque."""
        plain, dark = self.picture(0.0), self.picture(1.0)
        return 1.0 - dark / numpy.maximum(plain, 1.0), plain == 255.0

    def hits(self):
        """First hits, mm, indexed [row, column, axis]; NaN where there is none."""
        nowhere = (numpy.nan,) * 3
        return numpy.array([[brainshift.pick(self.display, self.view, column, row) or nowhere
                             for column in range(self.size)] for row in range(self.size)])


# The formula, from positions alone ----------------------------------------------------------------


def unit(vectors):
    return vectors / numpy.linalg.norm(vectors, axis=-1, keepdims=True)


def taken(values, rows, columns):
    return values[rows.clip(0, len(values) - 1), columns.clip(0, values.shape[1] - 1)]


def leaning(hits, towards_eye, rows, columns):
    way = taken(hits, rows, columns) - hits
    distance = numpy.linalg.norm(way, axis=-1)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        lift = ((way * towards_eye).sum(axis=-1) - STEP) / distance
    near = numpy.clip(2 - distance / RADIUS, 0, 1)
    missing = numpy.isnan(distance)
    lift = numpy.where(distance == 0, -numpy.inf, lift)
    return numpy.where(missing, -1.0, lift), numpy.where(missing, 0.0, near)


def hidden_by(one, two):
    near = one[1] * two[1]
    pit = numpy.clip(2 * numpy.minimum(one[0], two[0]) - 1, 0, 1)
    groove = numpy.maximum(0.5 * (one[0] + two[0]), 0)
    return near * groove + (1 - near) * pit


def expected(drawn, hits):
    """Occlusion before the average of 4 by 4 pixels, and after it."""
    size, view = drawn.size, drawn.view
    eye, focus = numpy.array(view.CameraPosition), numpy.array(view.CameraFocalPoint)
    depth = (hits - eye) @ unit(focus - eye)
    pixel = 2 * numpy.tan(numpy.radians(view.CameraViewAngle / 2)) / size * depth
    towards_eye = unit(eye - hits)
    row, column = numpy.mgrid[0:size, 0:size]
    rank = 4.0 * (row % 4) + column % 4
    direction = unit(numpy.stack([numpy.ones_like(rank), (rank + 0.5) / 16], axis=-1))
    hidden = numpy.zeros((size, size))
    room_x, room_y = (numpy.minimum(at, size - 1 - at) for at in (column, row))
    for pair in range(4):
        share = 0.25 * ((pair + rank) % 4 + (rank * 5 / 16) % 1 + 0.5 / 16)
        reach = (0.15 + 0.85 * share) * numpy.nan_to_num(RADIUS / pixel)
        x, y = (numpy.floor(reach * direction[..., axis] + 0.5) for axis in (0, 1))
        x = numpy.clip(x, -room_x, room_x).astype(int)
        y = numpy.clip(y, -room_y, room_y).astype(int)
        hidden += 0.25 * hidden_by(leaning(hits, towards_eye, row + y, column + x),
                                   leaning(hits, towards_eye, row - y, column - x))
        across, up = direction[..., 0], direction[..., 1]
        direction = numpy.sqrt(0.5) * numpy.stack([across - up, across + up], axis=-1)
    rough = 3 * hidden / (1 + 3 * hidden)
    sums = numpy.zeros((2, size, size))
    for y in range(-2, 2):
        for x in range(-2, 2):
            apart = abs(taken(depth, row + y, column + x) - depth)
            weight = numpy.nan_to_num(numpy.maximum(1 - apart / (0.5 * RADIUS), 0))
            occlusion = numpy.nan_to_num(taken(rough, row + y, column + x))
            sums += weight * numpy.stack([occlusion, numpy.ones_like(weight)])
    return sums[0] / numpy.maximum(sums[1], 1e-9)


def test_numbers():
    bent = FreeFormDeformation(Input=volume(tissue(bumps)), Strokes=STROKE)
    # Of what lies behind a point, tissue as thick as the radius hides so much.
    for opacities, seen in ((SURFACE, 1.0), (TRANSLUCENT, 1.0 - 0.85 ** RADIUS)):
        drawn = Drawn(bent, size=64, opacities=opacities)
        hidden, _ = drawn.hidden()
        plain = drawn.picture(0.0)
        where = plain > 200
        surface = 2 * plain / 255 - 1  # half opaque tissue has none
        difference = abs(hidden - seen * surface * expected(drawn, drawn.hits()))[where] * 255
        print(f"  {where.sum()} pixels, {difference.max():.2f} levels at most, "
              f"{hidden[where].mean():.3f} of the light hidden, {hidden[where].max():.2f} at most")
        assert where.sum() > 1000 and hidden[where].max() > 0.3 * seen
        # A neighbour may be rounded to the next pixel, once in some thousand pairs.
        assert numpy.quantile(difference, 0.99) <= 2 * LEVEL
        assert difference.mean() < LEVEL


# What light does ----------------------------------------------------------------------------------


def test_a_plane_keeps_its_light():
    source = volume(tissue(lambda x, y: 26.0 + 0 * x))
    for direction in ((0.0, 0.0, -1.0), ASLANT, (0.9, 0.4, -1.0)):
        hidden, opaque = Drawn(source, direction=direction).hidden()
        print(f"  along {direction}: {hidden[opaque].max():.4f} of the light hidden at most")
        assert opaque.sum() > 1000
        assert hidden[opaque].max() <= 1.5 / 255


def test_a_groove_is_darker_than_a_ridge():
    for strokes in ((), STROKE):
        source = FreeFormDeformation(Input=volume(tissue(waves)), Strokes=strokes)
        drawn = Drawn(source, size=64)
        hidden, _ = drawn.hidden()
        hits = drawn.hits()
        phase = numpy.cos(2 * numpy.pi * (hits[..., 0] - MIDDLE[0]) / WAVE)
        inner = numpy.maximum(*(abs(hits[..., axis] - 24.0) for axis in (0, 1))) < 12.0
        ridge, groove = hidden[inner & (phase > 0.95)], hidden[inner & (phase < -0.95)]
        print(f"  ridges {ridge.mean():.3f}, grooves {groove.mean():.3f}")
        assert len(ridge) > 50 and len(groove) > 50
        assert groove.mean() > 0.15 and ridge.mean() < 0.02


def test_bent_as_baked():
    bent = FreeFormDeformation(Input=volume(tissue(bumps)), Strokes=STROKE)
    baked = BakeDeformation(Input=bent, Interpolation="Cubic")
    (one, opaque), (other, also) = Drawn(bent).hidden(), Drawn(baked).hidden()
    rest, _ = Drawn(bent.Input).hidden()
    both = opaque & also
    same, moved = abs(one - other)[both].mean(), abs(one - rest)[both].mean()
    print(f"  bent and baked differ by {same:.4f}, bent and at rest by {moved:.4f}")
    assert same < 0.01 and moved > 4 * same


def test_the_step_changes_little():
    bent = FreeFormDeformation(Input=volume(tissue(bumps)), Strokes=STROKE)
    for name, opacities in (("opaque", SURFACE), ("translucent", TRANSLUCENT)):
        drawn = Drawn(bent, opacities=opacities)
        hidden = {}
        for step in (STEP, STEP / 8):
            drawn.display.SampleDistance = step
            hidden[step], _ = drawn.hidden()
        seen = drawn.picture(0.0) > 128
        error = numpy.sqrt(((hidden[STEP] - hidden[STEP / 8])[seen] ** 2).mean())
        print(f"  {name}: {hidden[STEP][seen].mean():.3f} of the light hidden, error {error:.4f}")
        assert seen.sum() > 1000 and hidden[STEP][seen].mean() > 0.02
        assert error < 0.01, (name, error)


# Which pictures have it ---------------------------------------------------------------------------


def test_a_part_equals_the_whole():
    first = brainshift.soft((32.0, 30.0, 26.0), (0, 0, -1), 5.0)
    scene = FreeFormDeformation(Input=volume(tissue(bumps)), LatticeDimensions=(25, 25, 25),
                                Strokes=first)
    drawn = Drawn(scene, size=200, radius=23.0)  # far beyond the pixels that are cast
    plain = drawn.picture(0.0, KeepPicture=1)
    before = drawn.picture(1.0)
    for moving in (False, True):
        for amount in (1.0, 2.0, -1.5):
            bend = brainshift.soft((24.0, 22.0, 30.0), (0, 0, amount), 3.0)
            scene.Strokes = list(first) + list(bend)
            cast = brainshift.counters(drawn.display)["pixelsCast"]
            if moving:
                drawn.view.SMProxy.InteractiveRender()
                off = on_screen(drawn.view)[:, :, 0]
                assert (off[plain == 255] >= 250).mean() > 0.95, "a moving picture has no occlusion"
            part = drawn.picture()
            cast = brainshift.counters(drawn.display)["pixelsCast"] - cast
            whole = drawn.picture(CountSamples=1)
            drawn.picture(CountSamples=0)
            print(f"  {amount} mm, {cast} pixels cast, {(part != whole).sum()} differ", flush=True)
            assert cast < 0.6 * (1 + moving) * 200 * 200
            assert (part != before).sum() > 100
            assert (part == whole).all()
            before = part


def test_hovering_keeps_it():
    drawn = Drawn(volume(tissue(bumps)))
    drawn.picture(1.0, KeepPicture=1)
    still = drawn.picture()
    cast = brainshift.counters(drawn.display)["pixelsCast"]
    drawn.view.SMProxy.InteractiveRender()
    assert brainshift.counters(drawn.display)["pixelsCast"] == cast
    assert (on_screen(drawn.view)[:, :, 0] == still).all()


def test_skipping_changes_nothing():
    drawn = Drawn(FreeFormDeformation(Input=volume(tissue(bumps)), Strokes=STROKE))
    drawn.display.AmbientOcclusion = 1.0
    assert_same(drawn.view, drawn.display, "occluded")


def test_without_it_pictures_stay():
    source = volume(tissue(bumps))
    drawn = Drawn(source)
    assert drawn.display.Shade == 1
    for properties in ({}, {"Shade": 0}, {"Shade": 1, "BlendMode": 1}):
        plain, dark, again = (drawn.picture(darkness, **properties) for darkness in (0, 1, 0))
        assert (plain == again).all()
        assert (plain == dark).all() == bool(properties), properties
    picks = [[brainshift.pick(drawn.display, drawn.view, at, 60) for at in range(20, 100, 5)]
             for darkness in (0, 1) if drawn.picture(darkness, BlendMode=0) is not None]
    assert picks[0] == picks[1]
    moved = FreeFormDeformation(Input=source, Strokes=STROKE)
    compared = Drawn(CompareVolumes(Input=source, Reference=moved))
    assert (compared.picture(0.0) == compared.picture(1.0)).all()


def test_tiles():
    drawn = Drawn(volume(tissue(bumps)), size=152)
    drawn.picture(1.0)
    file = testing.scratch("occluded-tiles.png")
    SaveScreenshot(file, drawn.view, ImageResolution=[456, 456])
    reader = vtkPNGReader()
    reader.SetFileName(file)
    reader.Update()
    tiled = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    tiled = tiled.reshape(456, 456, -1)[:, :, 0].astype(float)
    os.remove(file)
    drawn.view.ViewSize = [456, 456]
    whole = drawn.picture()
    difference = abs(tiled - whole)
    print(f"  {(difference > 2).sum()} pixels of tiles differ, {difference.mean():.4f} levels")
    assert (difference > 2 * LEVEL).mean() < 1e-3
    Delete(drawn.view)


testing.run_tests(globals())
