# SPDX-License-Identifier: BSD-3-Clause
# Proves that clipping planes and cropping regions cut a bent volume where VTK cuts the baked
# volume. Empty-space skipping changes no bit of the picture.
import numpy
from brainshift_testing import (assert_says, load_plugin, look, messages, picture, run_tests,
                                show_volume, view_along, volume)

load_plugin()
from paraview.simple import Delete  # noqa: E402 after the plugin
from skipping_testing import (MIDDLE as LITTLE_MIDDLE, OBLIQUE, assert_same, bent,  # noqa: E402
                              curves, scattered)
from stock_testing import (COLORS, MAPPER_STEP, MIDDLE, OPACITIES, Bent, assert_alike,  # noqa: E402
                           assert_like_stock, mapper_picture, prop_of, shown_picture, smooth)
from vtkmodules.vtkCommonDataModel import vtkPlane  # noqa: E402

OPAQUE = [0, 0, 0.5, 0, 15, 0, 0.5, 0, 20, 1, 0.5, 0, 100, 1, 0.5, 0]
# VTK's names for sets of its 27 regions.
REGIONS = {"fence": 0x2EBFEBA, "inverted fence": 0x5140145, "cross": 0x0417410,
           "inverted cross": 0x7BE8BEF}


def planes_about(middle):
    """Two oblique planes (origin, normal) that leave a wedge."""
    return ((numpy.add(middle, (1.0, 0.0, 2.0)), (-0.3, -0.1, -1.0)),
            (numpy.add(middle, (-3.0, 2.0, 0.0)), (0.8, -0.5, 0.2)))


def add_planes(mapper, planes):
    mapper.RemoveAllClippingPlanes()
    for origin, normal in planes:
        plane = vtkPlane()
        plane.SetOrigin(*origin)
        plane.SetNormal(*(float(n) for n in normal))
        mapper.AddClippingPlane(plane)


def placed(display):
    display.Translation, display.Orientation = [4.0, -3.0, 5.0], [10.0, 25.0, -15.0]
    display.Scale, display.Origin = [1.1, 0.8, 0.9], [24.0, 20.0, 28.0]


def test_planes_cut_where_vtk_cuts_the_baked_volume():
    blobs = Bent(smooth())
    for opacities, kind in ((OPACITIES, "translucent"), (OPAQUE, "opaque")):
        for moved in (False, True):
            def cut(display, view):
                if moved:
                    placed(display)
                # VTK's first sample lies two steps behind a cut. Short steps show the cut.
                display.SampleDistance = MAPPER_STEP
                picture(view)  # the mapper is there after it
                add_planes(prop_of(view).GetMapper(), planes_about(MIDDLE))

            def cut_by_vtk(mapper, prop):
                if moved:
                    prop.SetPosition(4, -3, 5)
                    prop.SetOrientation(10, 25, -15)
                    prop.SetScale(1.1, 0.8, 0.9)
                    prop.SetOrigin(24, 20, 28)
                add_planes(mapper, planes_about(MIDDLE))

            named = {"opacities": opacities}
            assert_alike(f"{kind}{', placed' if moved else ''}",
                         shown_picture(blobs.filter, "Deformed Volume", cut, **named),
                         mapper_picture(blobs.baked, cut_by_vtk, **named),
                         mapper_picture(blobs.source, cut_by_vtk, **named), limit=0.01)


def test_a_plane_cuts_what_is_seen():
    # A box of one scalar is cut at 12.25 mm. Nothing is seen beyond.
    voxels = numpy.full((33, 33, 33), 100.0, numpy.float32)
    view = view_along((0, 0, -1), (16, 16, 16), 100.0, half_height=16.0, size=200)
    show_volume(volume(voxels), view, "Deformed Volume", COLORS, [0, 1, 0.5, 0, 100, 1, 0.5, 0])
    whole = picture(view)
    mapper = prop_of(view).GetMapper()
    add_planes(mapper, (((12.25, 0, 0), (1, 0, 0)),))
    cut = picture(view)
    edge = int(12.25 / 32.0 * 200)
    assert whole[100].all() and cut[100, edge + 2:-2].any(axis=1).all()
    assert not cut[100, :edge - 1].any()
    add_planes(mapper, (((0, 0, 40), (0, 0, 1)),))
    assert not picture(view).any(), "all of it lies on the side that goes"
    mapper.RemoveAllClippingPlanes()
    assert numpy.array_equal(picture(view), whole)
    Delete(view)


def test_too_many_planes_are_told():
    def cut(display, view):
        picture(view)
        add_planes(prop_of(view).GetMapper(), [((0, 0, -i), (0, 0, 1)) for i in range(17)])
    with messages() as said:
        assert shown_picture(volume(smooth()), "Deformed Volume", cut).any()
    assert_says(said.text, "17 clipping planes", "first 16")


def test_regions_crop_as_the_stock_volume_does():
    blobs = Bent(smooth())
    for name, flags in REGIONS.items():
        def crop(display, view):
            display.UseCropping = 1
            display.CroppingOrigin, display.CroppingScale = [20.0, 19.0, 21.0], [0.2, 0.15, 0.1]
            picture(view)
            prop_of(view).GetMapper().SetCroppingRegionFlags(flags)
        # Both lose up to a step at each edge of a region, and VTK's step is longer.
        assert_like_stock(name, blobs, crop, limit=0.015)


def test_skipping_changes_nothing_that_is_cut():
    source = volume(scattered())
    for amplitude in (0.0, 40.0):
        filter = bent(source, amplitude)
        view = view_along(OBLIQUE, LITTLE_MIDDLE, 70.0, size=100)
        for name in ("opaque", "translucent", "band"):
            look(view, OBLIQUE, LITTLE_MIDDLE, 70.0)
            display = show_volume(filter, view, "Deformed Volume", *curves(name), shade=True)
            display.UseCropping = 0
            picture(view)
            mapper = prop_of(view).GetMapper()
            add_planes(mapper, planes_about(LITTLE_MIDDLE))
            what = f"{amplitude:.0f} voxels, {name}, "
            assert_same(view, display, what + "planes", 0.003)
            display.BlendMode, display.IsosurfaceValues = 5, [0.5]
            assert_same(view, display, what + "planes, isosurface", 0.003)
            display.BlendMode = 0
            look(view, OBLIQUE, LITTLE_MIDDLE, 3.0)
            assert_same(view, display, what + "planes, eye inside", 0.003)
            # The eye is in tissue, with a cut between it and the rest.
            look(view, OBLIQUE, LITTLE_MIDDLE, 6.0)
            add_planes(mapper, ((LITTLE_MIDDLE, OBLIQUE),))
            assert_same(view, display, what + "a plane ahead", 0.003)
            look(view, OBLIQUE, LITTLE_MIDDLE, 70.0)
            mapper.RemoveAllClippingPlanes()
            display.UseCropping = 1
            display.CroppingOrigin, display.CroppingScale = [5.0, 6.0, 7.0], [0.5, 0.4, 0.4]
            mapper.SetCroppingRegionFlags(REGIONS["inverted cross"])
            assert_same(view, display, what + "regions", 0.003)
        Delete(view)
        Delete(filter)


run_tests(globals())
