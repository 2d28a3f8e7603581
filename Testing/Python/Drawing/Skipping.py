# SPDX-License-Identifier: BSD-3-Clause
# Proves that empty-space skipping changes no bit of the picture, also for lattices that fold and
# after strokes that redo only a part of the field.
import numpy
from brainshift_testing import (ball, load_plugin, look, output, picture, run_tests, show_volume,
                                view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import Delete, FreeFormDeformation, Show, Sphere  # noqa: E402
from skipping_testing import (MIDDLE, OBLIQUE, OPACITIES, assert_same, bent,  # noqa: E402
                              curves, scattered)

SIZE = 100  # edge of a picture, pixels
ROTATION = (0.8, -0.48, 0.36, 0.6, 0.64, -0.48, 0.0, 0.6, 0.8)


def new_view(direction=OBLIQUE, distance=70.0, focus=MIDDLE, **named):
    return view_along(direction, focus, distance, size=SIZE, **named)


def test_random_lattices_and_opacities():
    source = volume(scattered())
    for amplitude in (0.0, 20.0, 40.0):
        filter = bent(source, amplitude)
        view = new_view()
        for name in OPACITIES:
            display = show_volume(filter, view, "Deformed Volume", *curves(name), shade=True)
            assert_same(view, display, f"{amplitude:.0f} voxels, {name}")
        Delete(view)
        Delete(filter)


def test_views():
    filter = bent(volume(scattered()), 6.0)
    for name in ("translucent", "band"):
        for projection, named in (("perspective", {}), ("parallel", {"half_height": 16.0})):
            view = new_view(**named)
            display = show_volume(filter, view, "Deformed Volume", *curves(name))
            for direction in ((0, 0, -1), (1, 0, 0), (0.3, -0.9, 0.4)):
                look(view, direction, MIDDLE, 70.0, up=(0.1, 0.2, 1))
                assert_same(view, display, f"{name}, {projection}, along {direction}")
            Delete(view)


def test_camera_inside():
    voxels = scattered()
    tissue = numpy.argwhere(voxels[1:-1, 1:-1, 1:-1])[:, ::-1] + 1.0
    places = [(MIDDLE, 0.5)] + [(focus.tolist(), distance) for focus in tissue[::120]
                                for distance in (0.2, 7.0)]
    source = volume(voxels)
    for filter in (bent(source, 2.0), bent(source, 20.0)):
        view = new_view()
        for name in ("translucent", "band"):
            display = show_volume(filter, view, "Deformed Volume", *curves(name))
            seen = 0
            for focus, distance in places:
                look(view, OBLIQUE, focus, distance)
                what = f"{name}, {distance} mm from {focus}"
                seen += assert_same(view, display, what, least_share=0.0) > 0.005
            assert seen > len(places) / 2, (name, seen)
        Delete(view)


def test_scalar_types():
    for kind in ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64",
                 "float32", "float64"):
        high = 100 if kind.endswith("int8") else 3000
        low = 0 if kind.startswith("u") else -high
        voxels = (low + scattered() * (high - low)).astype(kind)
        if kind.startswith("float"):
            voxels[3:6, 4:9, 5:15] = numpy.nan
            voxels[8, 8, 8] = numpy.inf
        cells = kind in ("uint8", "int32", "float64")
        filter = bent(volume(voxels, cells=cells), 6.0)
        view = new_view()
        display = show_volume(filter, view, "Deformed Volume", *curves("band", low, high),
                              association="CELLS" if cells else "POINTS")
        assert_same(view, display, f"{kind} {'in cells' if cells else 'on points'}")
        Delete(view)


def test_direction_matrix_and_odd_geometry():
    voxels = scattered()[:, :13, :18]
    source = volume(voxels, (3, -20, 5), (1.3, 0.7, 2.1), ROTATION)
    bounds = numpy.reshape(source.GetDataInformation().GetBounds(), (3, 2))
    middle = bounds.mean(axis=1)
    strokes = brainshift.soft(middle, (9, -5, 4), 25.0) + brainshift.soft(
        middle + (4, 6, -7), (-8, 7, 9), 18.0)
    filter = FreeFormDeformation(Input=source, Strokes=strokes)
    assert output(filter).GetDirectionMatrix().GetElement(0, 1) == -0.48
    view = new_view(focus=middle, distance=90.0)
    for name in OPACITIES:
        display = show_volume(filter, view, "Deformed Volume", *curves(name), shade=True)
        assert_same(view, display, name)
    Delete(view)


def test_a_surface_inside():
    filter = bent(volume(scattered()), 6.0)
    view = new_view()
    sphere = Show(Sphere(Center=(12, 9, 11), Radius=6.0), view)
    sphere.DiffuseColor = [1.0, 0.0, 0.0]
    for name in OPACITIES:
        display = show_volume(filter, view, "Deformed Volume", *curves(name))
        assert_same(view, display, name)


def test_strokes_one_by_one():
    side = 49  # so large that a stroke reaches a part of it
    focus = ((side - 1) / 2,) * 3
    random = numpy.random.default_rng(5)
    anchors = random.integers(14, side - 14, (6, 3))  # x, y, z
    voxels = numpy.zeros((side,) * 3, numpy.float32)  # little blocks, to be moved one by one
    for x, y, z in anchors:
        voxels[z - 1:z + 2, y - 1:y + 2, x - 1:x + 2] = 1.0
    source = volume(voxels)
    colours = curves("translucent")
    filter = FreeFormDeformation(Input=source, Samples=2)
    view = new_view(focus=focus, half_height=24.0)
    display = show_volume(filter, view, "Deformed Volume", *colours, shade=True)
    picture(view)
    strokes = ()
    for number, anchor in enumerate(anchors, 1):
        vector = random.uniform(4, 7, 3) * random.choice((-1, 1), 3)
        strokes += brainshift.soft(anchor, vector, random.uniform(7, 9))
        filter.Strokes = strokes
        assert_same(view, display, f"{number} strokes", 0.002)
        # Here only a part of each picture was redone. A new pipeline draws all of it.
        apart = new_view(focus=focus, half_height=24.0)
        fresh = FreeFormDeformation(Input=source, Samples=2, Strokes=strokes)
        show_volume(fresh, apart, "Deformed Volume", *colours, shade=True)
        differing = int((picture(apart) != picture(view)).any(axis=2).sum())
        assert differing == 0, (number, differing)
        Delete(apart)
        Delete(fresh)


def test_a_stroke_that_grows_out_of_its_bricks():
    # A ball inside its volume is drawn out step by step without folding. Empty bricks hold
    # tissue after the last step, and only bricks in reach of the stroke are redone.
    focus = (48.0, 48.0, 48.0)
    filter = FreeFormDeformation(Input=volume(ball(side=97, radius=14.0)))
    filter.Strokes = brainshift.soft((48, 48, 62), (0, 0, 0.5), 20.0)
    view = new_view((-1.0, 0.2, -0.1), distance=200.0, focus=focus)
    display = show_volume(filter, view, "Deformed Volume", [0, 0, 1, 0, 100, 0, 1, 0],
                          [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0])
    picture(view)
    for amount in (4.0, 7.0, 10.0):
        filter.Strokes = brainshift.soft((48, 48, 62), (0, 0, amount), 20.0)
        assert_same(view, display, f"{amount} mm")
    Delete(view)


run_tests(globals())
