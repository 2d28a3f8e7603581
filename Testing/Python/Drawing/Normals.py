# SPDX-License-Identifier: BSD-3-Clause
# Proves that light falls on the bent surface as it falls on the surface of the baked volume: the
# normals differ by less than 3 degrees on average. A red, a green and a blue light along the
# three axes show the whole normal in one picture: the pixel is (|x|, |y|, |z|). Proves, too, that
# the glints of several lights on a ball are those of Phong's formula.
import numpy
from brainshift_testing import (ball, load_plugin, picture, run_tests, show_volume, view_along,
                                volume, voxels)
from vtkmodules.vtkRenderingCore import vtkLight

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import BakeDeformation, Delete, FreeFormDeformation  # noqa: E402

SIZE = 140           # edge of the picture, pixels
PIXELS_APART = 3     # of those whose normals are compared
LARGEST_ANGLE = 3.0  # mean, degrees
SHINE, POWER = 0.8, 6.0  # of the material with glints
SIDE = 49
MIDDLE = (24.0, 24.0, 24.0)
COLORS = [0, 1, 1, 1, 100, 1, 1, 1]
SURFACE = [0, 0, 0.5, 0, 49.9, 0, 0.5, 0, 50, 1, 0.5, 0, 100, 1, 0.5, 0]


def bent(source):
    return FreeFormDeformation(Input=source, Strokes=(
        brainshift.stamp((24, 24, 40), MIDDLE, -9.0, major=26.0, minor=20.0)
        + brainshift.stamp((10, 24, 26), MIDDLE, 9.0, major=24.0, minor=20.0)))


def light_scene(view, lights):
    """Lights a view from some directions, each with its colour, and by nothing else."""
    view.UseLight = 0
    view.SMProxy.StillRender()
    renderer = view.GetClientSideObject().GetRenderer()
    renderer.GetLights().RemoveAllItems()
    for towards, color in lights:
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(*towards)
        light.SetFocalPoint(0, 0, 0)
        light.SetDiffuseColor(*color)
        light.SetSpecularColor(*color)
        renderer.AddLight(light)


def sampled(values, positions):
    """Values [z, y, x, ...] at positions (x, y, z) in voxels, linear between voxels."""
    low = numpy.floor(positions).astype(int)
    within = positions - low
    result = 0.0
    for corner in numpy.ndindex(2, 2, 2):
        weight = numpy.prod(numpy.where(corner, within, 1.0 - within), axis=1)
        x, y, z = (low + corner).T
        result = result + weight[:, None] * values[z, y, x]
    return result


def gradient(intensity):
    """Gradient (x, y, z) of voxels [z, y, x]."""
    return numpy.stack(numpy.gradient(intensity.astype(float))[::-1], axis=-1)


def mean_angle(left, right):
    """Mean angle (degrees) between directions known up to the signs of their components."""
    left, right = (numpy.abs(v) / numpy.linalg.norm(v, axis=1)[:, None] for v in (left, right))
    return float(numpy.degrees(numpy.arccos((left * right).sum(axis=1).clip(-1, 1))).mean())


class Surface:
    """What one view shows of the bent blob: positions (voxels) and normals drawn there."""

    def __init__(self, filter, direction, normals):
        view = view_along(direction, MIDDLE, 110.0, size=SIZE)
        display = show_volume(filter, view, "Deformed Volume", COLORS, SURFACE, shade=True)
        display.VolumeNormalTexture = normals
        display.SampleDistance = 0.1  # mm: the sample drawn is where the pick says
        display.Ambient, display.Diffuse, display.Specular = 0.0, 1.0, 0.0
        light_scene(view, [(axis, axis) for axis in numpy.eye(3)])
        image = picture(view)
        found = []
        for row in range(0, SIZE, PIXELS_APART):
            for column in range(0, SIZE, PIXELS_APART):
                position = brainshift.pick(display, view, column, row)
                if position is not None:
                    found.append(numpy.concatenate([position, image[row, column]]))
        Delete(view)
        self.positions, self.normals = numpy.hsplit(numpy.array(found), [3])


def test_drawn_normals_are_those_of_the_baked_surface():
    blob = ball(side=SIDE, radius=13.0, edge=18.0)
    filter = bent(volume(blob))
    baked = gradient(voxels(BakeDeformation(Input=filter, Interpolation="Cubic")))
    z, y, x = numpy.mgrid[0:SIDE, 0:SIDE, 0:SIDE].astype(numpy.float32)
    # Where each voxel of the deformed frame comes from.
    rest = [voxels(BakeDeformation(Input=bent(volume(axis)))) for axis in (x, y, z)]
    rest = numpy.stack(rest, axis=-1)
    for direction in ((-0.6, 0.2, -1.0), (1.0, -0.4, -0.3)):
        for normals in ("Half resolution", "Full resolution", "On the fly"):
            shown = Surface(filter, direction, normals)
            expected = sampled(baked, shown.positions)
            unturned = sampled(gradient(blob), sampled(rest, shown.positions))
            angle = mean_angle(shown.normals, expected)
            without = mean_angle(unturned, expected)
            print(f"  {normals} along {direction}: {angle:.2f} degrees, without the turn "
                  f"{without:.2f}; {len(expected)} points", flush=True)
            assert len(expected) > 200
            assert angle < LARGEST_ANGLE, (normals, angle)
            assert without > 2 * LARGEST_ANGLE, ("the bend is too weak to tell", without)


def test_the_edge_of_what_is_known_is_lit():
    """A brain in NaN is as bright as one in 0 that is cut there by the colour map."""
    z, y, x = numpy.mgrid[0:SIDE, 0:SIDE, 0:SIDE].astype(numpy.float32) - MIDDLE[0]
    distance = numpy.sqrt(x * x + y * y + z * z)
    shown = []
    for outside in (None, numpy.nan, numpy.inf):
        head = 100.0 - 2.0 * distance
        if outside is not None:
            head[distance > 18.0] = outside
        for normals in ("Half resolution", "Full resolution", "On the fly"):
            view = view_along((0.0, 0.0, -1.0), MIDDLE, 110.0, size=SIZE)
            display = show_volume(volume(head.astype(numpy.float32)), view, "Deformed Volume",
                                  [0, 1, 1, 1, 100, 1, 1, 1],
                                  [0, 0, 0.5, 0, 63.9, 0, 0.5, 0, 64, 1, 0.5, 0, 100, 1, 0.5, 0],
                                  shade=True)
            display.VolumeNormalTexture = normals
            display.Ambient, display.Diffuse, display.Specular = 0.0, 1.0, 0.0
            light_scene(view, [((0.0, 0.0, 1.0), (1.0, 1.0, 1.0))])
            image = picture(view)[40:100, 40:100]
            shown.append((outside, normals, image.mean(), image.min()))
            Delete(view)
    for outside, normals, mean, least in shown:
        print(f"  {outside}, {normals}: mean {mean:.3f}, least {least:.3f}")
    right = min(mean for outside, _, mean, _ in shown if outside is None)
    for outside, normals, mean, least in shown:
        assert mean > 0.75 * right, (outside, normals, mean, right)


def glints(display, view, lights):
    """What a black ball shows in the light of some lights, and the formula's answer: one row each
    for some pixels."""
    eye = numpy.array(view.CameraPosition[:])
    image = picture(view)
    shown, expected = [], []
    for row in range(0, SIZE, PIXELS_APART):
        for column in range(0, SIZE, PIXELS_APART):
            position = brainshift.pick(display, view, column, row)
            if position is None:
                continue
            normal, towards_eye = (v / numpy.linalg.norm(v) for v in (
                numpy.array(position) - MIDDLE, eye - position))
            light = numpy.zeros(3)
            for towards, color in lights:
                towards = towards / numpy.linalg.norm(towards)
                mirrored = 2.0 * (normal @ towards) * normal - towards
                light += numpy.array(color) * max(mirrored @ towards_eye, 0.0) ** POWER
            shown.append(image[row, column])
            expected.append((SHINE * light).clip(0.0, 1.0))
    return numpy.array(shown), numpy.array(expected)


def test_each_light_has_its_glint():
    lights = [(numpy.array((0.5, 0.2, 1.0)), (1.0, 0.2, 0.0)),
              (numpy.array((-0.6, 0.4, 0.8)), (0.0, 0.5, 1.0))]
    view = view_along((0.1, -0.2, -1.0), MIDDLE, 110.0, size=SIZE)
    display = show_volume(volume(ball(side=SIDE, radius=13.0, edge=18.0)), view, "Deformed Volume",
                          [0, 0, 0, 0, 100, 0, 0, 0], SURFACE, shade=True)
    display.SampleDistance = 0.1
    display.Ambient, display.Diffuse = 0.0, 0.0
    display.Specular, display.SpecularPower = SHINE, POWER
    light_scene(view, lights)
    shown, expected = glints(display, view, lights)
    Delete(view)
    difference = numpy.abs(shown - expected).mean()
    print(f"  glints differ by {100 * difference:.2f} %; {len(shown)} points, brightest "
          f"{expected.max(axis=0)}", flush=True)
    assert len(shown) > 200 and (expected.max(axis=0) > 0.3).all()
    assert difference < 0.01, difference


run_tests(globals())
