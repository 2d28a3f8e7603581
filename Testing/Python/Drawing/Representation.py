# SPDX-License-Identifier: BSD-3-Clause
# Proves that "Deformed Volume" shows what ParaView's "Volume" shows of the baked volume, and that
# surfaces in front of it, inside it and behind it are hidden or seen correctly. Voxels that are
# infinite are not drawn, as NaN is not, in the volume and in slices.
import numpy
from brainshift_testing import (SIZE, ball, data, load_plugin, mean_difference,
                                object_pixels, picture, run_tests, show_volume,
                                structural_similarity, use_headlight, view_along, volume, voxels)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from slices_testing import show_slices  # noqa: E402
from paraview.simple import (  # noqa: E402
    BakeDeformation, Delete, FreeFormDeformation, Hide, OpenDataFile, Show, Sphere)

HEAD_COLORS = [0, 0, 0, 0, 120, 0.8, 0.5, 0.4, 300, 1, 0.9, 0.8, 512, 1, 1, 1]
HEAD_OPACITIES = [0, 0, 0.5, 0, 70, 0, 0.5, 0, 200, 0.3, 0.5, 0, 512, 0.8, 0.5, 0]
HEAD_VIEWS = {"back": ((0.4, 1, -0.4), (0, 0, 1)), "side": ((-1, 0.3, -0.2), (0, 0, 1)),
              "top": ((0.1, 0.2, -1), (0, 1, 0))}
LARGEST_DIFFERENCE = 0.02  # of full scale, over the object's pixels
# Shading shows the finest detail of the skin. Baking blurs it, and VTK's steps are twice as long.
# That alone makes an undeformed head differ by 1 % from VTK's picture.
SMALLEST_SIMILARITY = {False: 0.99, True: 0.92}

BALL_COLORS = [0, 0, 1, 0, 100, 0, 1, 0]
BALL_OPACITIES = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0]
MIDDLE = (16.0, 16.0, 16.0)
HALF = SIZE // 2


class Head:
    """The MRI of a head, pressed in from above and from the right."""

    def __init__(self):
        self.volume = OpenDataFile(data("seg3d-utah", "seg3d_mr_t1.nii.gz"))
        self.volume.UpdatePipeline()
        bounds = numpy.array(self.volume.GetDataInformation().GetBounds()).reshape(3, 2)
        self.middle = bounds.mean(axis=1)
        # All strokes push inwards. Baking would cut off tissue that leaves the box.
        strokes = brainshift.stamp(self.surface_above(), self.middle, -20.0, major=80.0, minor=70.0)
        for x in bounds[0]:
            side = (x, self.middle[1], self.middle[2] + 20.0)
            strokes += brainshift.stamp(side, self.middle, -18.0, major=60.0, minor=60.0)
        back = (self.middle[0], bounds[1, 0], self.middle[2])
        strokes += brainshift.stamp(back, self.middle, -25.0, major=70.0, minor=70.0)
        self.filter = FreeFormDeformation(Input=self.volume, Strokes=strokes)
        self.baked = BakeDeformation(Input=self.filter)

    def surface_above(self):
        intensity = voxels(self.volume)
        column = intensity[:, intensity.shape[1] // 2, intensity.shape[2] // 2]
        z = int(numpy.flatnonzero(column > 100.0).max())
        low, high = self.volume.GetDataInformation().GetBounds()[4:]
        return (self.middle[0], self.middle[1], low + (high - low) * z / (len(column) - 1))

    def pictures(self, direction, up, shade):
        """Deformed, baked, and neither, from one place."""
        view = view_along(direction, self.middle, 480.0, up)
        use_headlight(view)
        shown = []
        for source, kind in ((self.filter, "Deformed Volume"), (self.baked, "Volume"),
                             (self.volume, "Volume")):
            display = show_volume(source, view, kind, HEAD_COLORS, HEAD_OPACITIES, shade=shade)
            shown.append((display, picture(view)))
            Hide(source, view)
        Delete(view)
        return [image for _, image in shown]


def test_looks_like_the_baked_volume():
    head = Head()
    controls = []
    for shade in (False, True):
        for name, (direction, up) in HEAD_VIEWS.items():
            deformed, baked, undeformed = head.pictures(direction, up, shade)
            share = object_pixels(baked).mean()
            difference = mean_difference(deformed, baked)
            similarity = structural_similarity(deformed, baked)
            control = mean_difference(undeformed, baked)
            control_similarity = structural_similarity(undeformed, baked)
            print(f"{name}{' shaded' if shade else ''}: differs by {100 * difference:.2f} %, SSIM "
                  f"{similarity:.4f}, object on {100 * share:.0f} % of the picture; undeformed "
                  f"{100 * control:.2f} %, SSIM {control_similarity:.4f}", flush=True)
            assert share > 0.1, (name, share)
            assert difference < LARGEST_DIFFERENCE, (name, shade, difference)
            assert similarity > SMALLEST_SIMILARITY[shade], (name, shade, similarity)
            controls.append(control / LARGEST_DIFFERENCE)
    assert min(controls) > 1.2 and max(controls) > 2, "the undeformed volume must be told apart"


def test_light_follows_the_bent_surface():
    # A smooth blob loses nothing by baking, so only the normals can differ.
    middle = (32.0, 32.0, 32.0)
    source = volume(ball(side=65, radius=20.0, edge=24.0))
    filter = FreeFormDeformation(Input=source, Strokes=(
        brainshift.stamp((32, 32, 52), middle, -10.0, major=34.0, minor=26.0)
        + brainshift.stamp((52, 32, 36), middle, -8.0, major=30.0, minor=24.0)))
    baked = BakeDeformation(Input=filter, Interpolation="Cubic")
    images = []
    for shown, kind in ((filter, "Deformed Volume"), (baked, "Volume"), (source, "Volume")):
        view = view_along((-0.6, 0.2, -1.0), middle, 180.0)
        use_headlight(view)
        show_volume(shown, view, kind, [0, 0, 0, 0, 100, 1, 1, 1],
                    [0, 0, 0.5, 0, 30, 0, 0.5, 0, 50, 0.5, 0.5, 0, 100, 0.8, 0.5, 0], shade=True)
        images.append(picture(view))
        Delete(view)
    deformed, expected, undeformed = images
    difference = mean_difference(deformed, expected)
    print(f"blob: differs by {100 * difference:.3f} %, undeformed by "
          f"{100 * mean_difference(undeformed, expected):.2f} %", flush=True)
    assert difference < 0.002, difference
    assert numpy.abs(deformed - expected).max() < 0.05
    assert mean_difference(undeformed, expected) > 0.02


def test_crops_as_the_stock_volume_does():
    source = volume(ball())
    images = []
    for kind, cropped in (("Volume", 1), ("Deformed Volume", 1), ("Deformed Volume", 0)):
        view = view_along((-0.5, 0.3, -1), MIDDLE, 100.0)
        display = show_volume(source, view, kind, BALL_COLORS, BALL_OPACITIES)
        display.UseCropping = cropped
        display.CroppingScale = [0.5, 1.0, 0.6]
        images.append(picture(view))
        Delete(view)
    stock, ours, whole = images
    assert mean_difference(ours, stock) < LARGEST_DIFFERENCE
    assert mean_difference(whole, stock) > 2 * LARGEST_DIFFERENCE


def ball_view(opacities=BALL_OPACITIES, strokes=()):
    """A green ball seen along -z, a red sphere, and the view."""
    filter = FreeFormDeformation(Input=volume(ball()), Strokes=list(strokes))
    view = view_along((0, 0, -1), MIDDLE, 100.0, half_height=16.0)
    show_volume(filter, view, "Deformed Volume", BALL_COLORS, opacities)
    sphere = Sphere(Radius=3.0, ThetaResolution=32, PhiResolution=32)
    display = Show(sphere, view)
    display.AmbientColor = display.DiffuseColor = [1.0, 0.0, 0.0]
    display.Ambient, display.Diffuse, display.Specular = 1.0, 0.0, 0.0
    return filter, sphere, view


def color_with_sphere_at(sphere, view, z, x=16.0):
    sphere.Center = [x, 16.0, z]
    column = int(HALF + (x - 16.0) / 16.0 * HALF)
    return picture(view)[HALF, column]


def test_opaque_tissue_hides_what_is_behind_it():
    _, sphere, view = ball_view()
    assert numpy.allclose(color_with_sphere_at(sphere, view, 30.0), (1, 0, 0), atol=0.01), "front"
    assert numpy.allclose(color_with_sphere_at(sphere, view, 16.0), (0, 1, 0), atol=0.01), "inside"
    assert numpy.allclose(color_with_sphere_at(sphere, view, 2.0), (0, 1, 0), atol=0.01), "behind"
    beside = color_with_sphere_at(sphere, view, 2.0, x=29.0)
    assert numpy.allclose(beside, (1, 0, 0), atol=0.01), "beside"


def test_translucent_tissue_is_counted_up_to_the_surface():
    # 5 % for each mm. 6 mm of tissue hide the sphere inside, and 18 mm the sphere behind.
    opacities = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 0.05, 0.5, 0, 100, 0.05, 0.5, 0]
    _, sphere, view = ball_view(opacities)
    for z, thickness in ((30.0, 0.0), (16.0, 6.0), (2.0, 18.0)):
        left = 0.95 ** thickness
        seen = color_with_sphere_at(sphere, view, z)
        assert numpy.allclose(seen, (left, 1 - left, 0), atol=0.03), (z, seen)


def test_moved_tissue_hides_where_it_is_seen():
    _, sphere, view = ball_view(strokes=brainshift.soft(MIDDLE, (12, 0, 0), 500.0, sigma=50.0))
    left_behind = color_with_sphere_at(sphere, view, 2.0, x=12.0)
    assert numpy.allclose(left_behind, (1, 0, 0), atol=0.01), "nothing is there any more"
    arrived = color_with_sphere_at(sphere, view, 2.0, x=28.0)
    assert numpy.allclose(arrived, (0, 1, 0), atol=0.01), "tissue is there now"


def test_tissue_outside_the_box_is_drawn():
    filter, _, view = ball_view(strokes=brainshift.soft(MIDDLE, (0, 14, 0), 500.0, sigma=50.0))
    view.CameraParallelScale = 32.0
    image = picture(view)
    row = int(HALF + 20.0 / 32.0 * HALF)  # 20 mm above the middle; the box ends at 16
    assert numpy.allclose(image[row, HALF], (0, 1, 0), atol=0.01), image[row, HALF]
    filter.Strength = 0.0
    assert not picture(view)[row, HALF].any()


def test_what_is_no_number_is_not_drawn():
    # All that is drawn is opaque, so a driver that takes infinity for an end of the map shows it.
    for kind in ("Deformed Volume", "Deformed Slices"):
        seen = []
        for value in (50.0, numpy.nan, numpy.inf, -numpy.inf):
            voxels = numpy.full((33, 33, 33), 50.0, numpy.float32)
            voxels[:, :, 20:] = value
            view = view_along((0, 0, -1), MIDDLE, 100.0, half_height=20.0)
            source = volume(voxels)
            if kind == "Deformed Slices":
                show_slices(source, view)
            else:
                show_volume(source, view, kind, [0, 0, 1, 0, 100, 0, 1, 0],
                            [0, 1, 0.5, 0, 100, 1, 0.5, 0])
            seen.append(object_pixels(picture(view)).mean())
            Delete(view)
        whole, *unknown = seen
        print(f"  {kind}: {whole:.3f} of the picture, beside NaN and infinities {unknown}")
        assert 0.5 * whole < unknown[0] < 0.7 * whole, (kind, seen)
        assert unknown == unknown[:1] * 3, (kind, seen)


run_tests(globals())
