# SPDX-License-Identifier: BSD-3-Clause
# Proves that a 2D transfer function of scalar and gradient acts on a bent volume as it acts on the
# baked volume in ParaView's "Volume", with the same steepness, number by number. Empty-space
# skipping stays exact.
import numpy
from brainshift_testing import (assert_says, load_plugin, messages, picture, run_tests,
                                show_volume, view_along, volume)

load_plugin()
from paraview.simple import Delete, GetTransferFunction2D  # noqa: E402 after the plugin
from skipping_testing import (MIDDLE as LITTLE_MIDDLE, OBLIQUE, assert_same, bent,  # noqa: E402
                              curves, scattered)
from steepness_testing import (grid_of_table, ramp, shell_table, steepness_of_ramp,  # noqa: E402
                               table_of, tabled)
from stock_testing import (Bent, assert_alike, assert_like_stock,  # noqa: E402
                           shown_picture, smooth)

FLAT = (0.6, 1.0, 1.5)  # mm, voxels of three different sides


def test_like_stock():
    for shade in (False, True):
        assert_like_stock(f"shell, {'lit' if shade else 'unlit'}", Bent(smooth()),
                          tabled(shell_table()), shade=shade, limit=0.012)
    assert_like_stock("shell, flat voxels", Bent(smooth(), spacing=(0.9, 1.0, 1.15)),
                      tabled(shell_table()), limit=0.012)


def test_like_stock_unbent():
    source = volume(smooth(), spacing=FLAT)
    images = [shown_picture(source, kind, tabled(shell_table()))
              for kind in ("Deformed Volume", "Volume")]
    plain = shown_picture(source, "Volume", lambda display, view: None)
    assert_alike("unbent, flat voxels", *images, plain, limit=0.012)


def test_steps_do_not_matter():
    # The table's opacities hold for VTK's step, whatever the step along our rays.
    source = volume(smooth())
    coarse, fine = (shown_picture(source, "Deformed Volume",
                                  tabled(shell_table(), SampleDistance=step))
                    for step in (0.4, 0.1))
    assert numpy.abs(coarse - fine).mean() < 0.001


def test_boxes_of_the_editor():
    # ParaView's own proxy, as its colour map editor fills it.
    def boxes(display, view):
        table = GetTransferFunction2D("Intensity", None, display, separate=True)
        table.OutputDimensions = [1024, 1024]
        table.Range = [0.0, 90.0, 0.0, 22.5]
        table.Boxes = [20.0, 2.0, 50.0, 12.0, 0.9, 0.3, 0.1, 0.2]
        display.TransferFunction2D = table
        display.UseTransfer2D = 1
    assert_like_stock("a box", Bent(smooth()), boxes, limit=0.012)


def seen_steepness(source, kind, focus):
    """Of the middle of a ramp, which a table shows as brightness, four times as large; scalars near
    the ends of the ramp are hidden."""
    scalar, steep = grid_of_table()
    bright = numpy.clip(4.0 * steep, 0.0, 1.0)
    opacity = numpy.where(abs(scalar - 0.5) < 0.1, 1.0, 0.0)
    view = view_along((0, 0, -1), focus, 150.0, size=41)
    display = show_volume(source, view, kind, [0, 0, 0, 0, 100, 1, 1, 1],
                          [0, 1, 0.5, 0, 100, 1, 0.5, 0])
    tabled(table_of(bright, bright, bright, opacity))(display, view)
    seen = picture(view)[20, 20, 0] / 4.0
    Delete(view)
    return seen


def test_steepness_is_that_of_vtk():
    shape = (21, 27, 33)
    for slopes in ((1.0, 0.4, -0.6), (0.1, 2.0, 0.3), (0.0, 0.0, -1.0)):
        source = volume(ramp(slopes, shape, FLAT), spacing=FLAT)
        focus = [0.5 * (n - 1) * side for n, side in zip(shape, FLAT)]
        expected = steepness_of_ramp(slopes, shape, FLAT)
        ours, stock = (seen_steepness(source, kind, focus)
                       for kind in ("Deformed Volume", "Volume"))
        print(f"  slopes {slopes}: {ours:.4f}, stock {stock:.4f}, expected {expected:.4f}")
        assert 0.05 < expected < 0.24
        assert abs(ours - expected) < 0.001 and abs(ours - stock) < 0.001


def band_table(**size):
    """Steep tissue in a narrow band of scalars: much to skip. A small table is interpolated."""
    scalar, steep = grid_of_table(**size)
    opacity = numpy.where((abs(scalar - 0.3) < 0.03) & (steep > 0.2), 0.6, 0.0)
    return table_of(1.0 - steep, scalar, steep, opacity)


def test_skipping_changes_nothing():
    for amplitude in (0.0, 40.0):
        filter = bent(volume(scattered()), amplitude)
        for name, table in (("band", band_table()),
                            ("small table", band_table(columns=24, rows=16))):
            for shade in (False, True):
                view = view_along(OBLIQUE, LITTLE_MIDDLE, 70.0, size=100)
                display = show_volume(filter, view, "Deformed Volume", *curves("band"),
                                      shade=shade)
                tabled(table)(display, view)
                assert_same(view, display, f"{amplitude:.0f} voxels, {name}", least_share=0.005)
                Delete(view)
        Delete(filter)


def test_maps_come_back():
    source = volume(smooth())
    plain = shown_picture(source, "Deformed Volume", lambda display, view: None)

    def and_back(display, view):
        tabled(shell_table())(display, view)
        picture(view)
        display.UseTransfer2D = 0
    assert numpy.array_equal(plain, shown_picture(source, "Deformed Volume", and_back))


def test_what_is_not_drawn_is_told():
    source = volume(smooth())
    four = volume(numpy.stack((smooth(),) * 4, axis=-1))

    def without_function(display, view):
        display.TransferFunction2D = None
    cases = (("no 2D transfer function", source, {}, without_function),
             ("Composite", source, {"BlendMode": 1}, tabled(shell_table())),
             ("colours", four, {"MapScalars": 0}, tabled(shell_table())))
    for word, shown, properties, configure in cases:
        def without(display, view):
            for name, value in properties.items():
                setattr(display, name, value)

        def with_table(display, view):
            without(display, view)
            configure(display, view)
            display.UseTransfer2D = 1
        plain = shown_picture(shown, "Deformed Volume", without)
        with messages() as said:
            image = shown_picture(shown, "Deformed Volume", with_table)
        assert_says(said.text, "Use 2D Transfer Function", word, "colour map and the opacity curve")
        assert numpy.array_equal(image, plain), word


def test_a_second_array_is_told():
    source = volume(smooth())

    def second(display, view):
        tabled(shell_table())(display, view)
        display.ColorArray2Name = ["POINTS", "Intensity"]
        display.UseGradientForTransfer2D = 0
    with messages() as said:
        image = shown_picture(source, "Deformed Volume", second)
    assert_says(said.text, "UseGradientForTransfer2D", "gradient", "second array")
    assert numpy.array_equal(
        image, shown_picture(source, "Deformed Volume", tabled(shell_table())))


run_tests(globals())
