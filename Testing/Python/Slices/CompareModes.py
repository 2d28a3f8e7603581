# SPDX-License-Identifier: BSD-3-Clause
# Proves that each way in which Deformed Slices compares a bent volume with a reference shows what
# the baked volume and the voxels of the reference say. A cavity stays grey. Show of Compare
# Volumes shows one of them alone without sending a voxel. State files keep all of it.
import numpy
from brainshift_testing import (load_plugin, output, picture, run_tests, scratch, show_volume,
                                view_along, volume)
from paraview import simple
from slices_testing import color_grey, flat_view, pixel_positions, show_slices, trilinear
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

load_plugin()
import brainshift  # noqa: E402 after the plugin
from compare_testing import HALF, MIDDLE, Pair, compared_picture, smooth  # noqa: E402
from paraview.simple import CompareVolumes, Delete, FreeFormDeformation  # noqa: E402

LATTICE_BYTES = 19 ** 3 * 3 * 4
ENOUGH = 2.5 / 255.0
BAKED = 0.01  # mean difference from a baked volume, of full scale
LARGEST = 10  # of that: a bake is exact, and slices read the offset field, which is trilinear
WAYS = ("Two colours", "Checkerboard", "Difference", "Gradient", "Wipe", "Local similarity")
PIXEL_MM = 2 * HALF / 300


def is_grey(image):
    return numpy.ptp(image, axis=2) == 0


def assert_like(image, expected, where, mean=BAKED):
    apart = numpy.abs(image - expected)[where]
    assert apart.mean() < mean and apart.max() < LARGEST * mean, (apart.mean(), apart.max())


def test_gradient_is_green_over_grey():
    pair = Pair()
    own = pair.baked_share()
    grid = (pair.unturned() - pair.origin) / pair.spacing
    share, inside = pair.expected()
    shares = (pair.voxels - pair.voxels.min()) / (float(numpy.ptp(pair.voxels)))
    slopes = numpy.gradient(shares, *pair.spacing[::-1])
    slope = numpy.sqrt(sum(trilinear(s, grid)[0] ** 2 for s in slopes))  # share a mm
    deep = ((grid > 1) & (grid < 39)).all(axis=2)
    for full in (0.05, 0.2):
        green = numpy.clip(slope / full, 0.0, 1.0)
        image = compared_picture(pair.compare, "Gradient", FullGradient=full)
        assert 0.05 < green[deep].mean() < 0.95, green[deep].mean()
        for color in (0, 2):
            assert_like(image[:, :, color], own * (1 - green), deep)
        assert_like(image[:, :, 1], own + (1 - own) * green, deep)
        assert is_grey(image)[~inside].mean() > 0.95, "no reference, no green"


def test_other_ways_show_the_baked_volume():
    pair = Pair()
    own = pair.baked_share()
    share, inside = pair.expected()
    both = compared_picture(pair.compare, "Two colours")
    assert_like(both[:, :, 0], own, inside)
    assert_like(both[:, :, 1], share, inside)
    difference = compared_picture(pair.compare, "Difference")
    assert is_grey(difference).all()
    assert_like(difference[:, :, 0], 0.5 + 0.5 * (own - share), inside)


def assert_wiped(pair, image, greater, own, share, inside):
    """The volume where `greater` (mm beyond the line) is above 0, else the reference."""
    away = numpy.abs(greater) > 1.5 * PIXEL_MM
    assert_like(image[:, :, 0], own, inside & away & (greater > 0))
    assert_like(image[:, :, 0], share, inside & away & (greater < 0))
    line = numpy.abs(greater) < 0.25 * PIXEL_MM
    assert line.any() and not is_grey(image)[line].any(), "a line where they meet"
    assert is_grey(image)[away].all()
    assert numpy.abs(own - share)[inside & away].mean() > 0.1, "they must be told apart"


def test_wipe_divides_by_world_axes():
    pair = Pair()
    own, (share, inside) = pair.baked_share(), pair.expected()
    x = pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, HALF)[:, :, 0]
    for place in (13.05, 18.05):
        image = compared_picture(pair.compare, "Wipe", WipePosition=[place, 99.0, -99.0])
        assert_wiped(pair, image, x - place, own, share, inside)
    # Where the reference has no voxels, only its side is empty.
    nothing = ~inside & (x < 13.05) & ~numpy.roll(inside, (3, 3), (0, 1)) & ~numpy.roll(
        inside, (-3, -3), (0, 1))
    image = compared_picture(pair.compare, "Wipe", WipePosition=[13.05, 0, 0])
    assert nothing.any() and not image[nothing].any()


def test_wipe_of_each_slice_of_a_flipped_volume():
    """Voxels that run against the world's axes do not turn the sides round."""
    values = smooth(5)
    flipped = volume(values[::-1, ::-1, ::-1].copy(), (32.0, 32.0, 32.0),
                     direction=(-1, 0, 0, 0, -1, 0, 0, 0, -1))
    other = smooth(6)
    compare = CompareVolumes(Input=flipped, Reference=volume(other))
    cameras = {"Axial": (2, (1, 0, 0), (0, 1, 0)), "Coronal": (1, (-1, 0, 0), (0, 0, 1)),
               "Sagittal": (0, (0, 1, 0), (0, 0, 1))}
    position = (15.05, 17.05, 99.0)
    for plane, (axis, right, up) in cameras.items():
        view = flat_view(axis, MIDDLE, HALF)
        display = show_slices(compare, view, (plane,), MIDDLE)
        display.SliceComparison = "Wipe"
        display.WipePosition = position
        pixels = pixel_positions(right, up, MIDDLE, HALF)
        own, inside = trilinear(values, pixels)
        share = trilinear(other, pixels)[0]
        across = 1 if plane == "Sagittal" else 0
        assert_wiped(None, picture(view), pixels[:, :, across] - position[across], own / 100,
                     share / 100, inside)
        Delete(view)


class WithCavity(Pair):
    """A cavity on a grid of its own, drawn in the reference before that is moved."""

    def __init__(self):
        super().__init__()
        side = 14
        z, y, x = numpy.mgrid[0:side, 0:side, 0:side]
        self.labels = (((x - 6.3) ** 2 + (y - 7.0) ** 2 + (z - 6.0) ** 2) < 16).astype(numpy.uint8)
        self.cavity_origin, self.cavity_step = numpy.array((9.0, 8.0, 6.0)), 1.7
        self.mask = volume(7 * self.labels, self.cavity_origin, (self.cavity_step,) * 3)
        self.compare.Cavity = self.mask

    def removed(self):
        """Which pixels lie in the cavity, and which too near to its edge to be told. The edge is
        where interpolation between its voxels passes a half."""
        share, _ = trilinear(
            self.labels, (self.unturned() - self.cavity_origin) / self.cavity_step)
        return share > 0.5, numpy.abs(share - 0.5) < 0.02


def test_the_cavity_is_ignored():
    pair = WithCavity()
    removed, unsure = pair.removed()
    removed, kept = removed & ~unsure, ~removed & ~unsure
    assert 0.02 < removed.mean() < 0.5, removed.mean()
    own = compared_picture(pair.bent, "None")[:, :, 0]
    cases = {"Two colours": own, "Gradient": own, "Difference": numpy.full_like(own, 0.5)}
    for way, grey in cases.items():
        image = compared_picture(pair.compare, way)
        pair.compare.Cavity = None
        without = compared_picture(pair.compare, way)
        pair.compare.Cavity = pair.mask
        assert is_grey(image)[removed].all(), way
        assert numpy.abs(image[:, :, 0] - grey)[removed].max() <= ENOUGH, way
        assert (image == without)[kept].all(), way
        assert (image != without)[removed].any(axis=1).mean() > 0.5, way
    image = compared_picture(pair.compare, "Two colours")
    pair.compare.CavityLabels = [3, 7]
    assert (compared_picture(pair.compare, "Two colours") == image).all()
    for way in ("Checkerboard", "Wipe"):
        image = compared_picture(pair.compare, way)
        pair.compare.Cavity = None
        assert (compared_picture(pair.compare, way) == image).all(), "no colours to leave out"
        pair.compare.Cavity = pair.mask


def test_show_one_alone():
    pair = WithCavity()
    share, inside = pair.expected()
    plain = compared_picture(pair.bent, "None")
    border = numpy.roll(inside, (2, 2), (0, 1)) != numpy.roll(inside, (-2, -2), (0, 1))
    for way in ("None",) + WAYS:
        pair.compare.Show = "Deformed"
        assert (compared_picture(pair.compare, way) == plain).all(), way
        pair.compare.Show = "Reference"
        image = compared_picture(pair.compare, way)
        assert is_grey(image).all(), "the ordinary colours"
        assert numpy.abs(image[:, :, 0] - share)[inside & ~border].max() < ENOUGH, way
        assert not image[~inside & ~border].any(), "where no reference is, nothing is"


def test_colours_of_the_map():
    """Ways that mix grey values do not ask the colour map; what is shown alone does."""
    pair = Pair()
    share, inside = pair.expected()
    grey = {way: compared_picture(pair.compare, way)
            for way in ("Two colours", "Difference", "Gradient")}
    view = flat_view(2, MIDDLE, HALF)
    display = show_slices(pair.compare, view, ("Axial",), MIDDLE)
    colors = simple.GetColorTransferFunction("Intensity", display, separate=True)
    colors.RGBPoints = [0, 0, 0, 1, 100, 1, 0, 0]
    for way, image in grey.items():
        display.SliceComparison = way
        assert (picture(view) == image).all(), way
    display.SliceComparison = "Wipe"
    display.WipePosition = [99.0, 0.0, 0.0]  # all of it is on the reference's side
    wiped = picture(view)
    pair.compare.Show = "Reference"
    for image in (wiped, picture(view)):
        for color, expected in enumerate((share, 0 * share, 1 - share)):
            assert numpy.abs(image[:, :, color] - expected)[inside].max() < ENOUGH, color
    Delete(view)


def test_the_reference_alone_needs_no_tissue():
    holed = smooth(2)
    holed[:, 10:20, 10:20] = numpy.nan
    other = smooth(3)
    compare = CompareVolumes(Input=volume(holed), Reference=volume(other))
    share = trilinear(other, pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, HALF))[0] / 100
    assert not compared_picture(compare, "Two colours")[140, 140].any(), "no tissue, nothing"
    compare.Show = "Reference"
    assert numpy.abs(compared_picture(compare, "None")[:, :, 0] - share).max() < ENOUGH


def test_interpolation_is_the_same_for_both():
    """Flicker must show what differs, not how it was read."""
    values = smooth(4)
    compare = CompareVolumes(Input=volume(values), Reference=volume(values.copy()))
    for interpolation in ("Nearest", "Linear", "Cubic"):
        pictures = []
        for show in ("Deformed", "Reference"):
            compare.Show = show
            pictures.append(compared_picture(compare, "None", SliceInterpolation=interpolation))
        assert numpy.abs(pictures[0] - pictures[1]).max() <= 1.5 / 255, interpolation


STEPS = [0, 1, 0, 0, 4, 1, 0, 0, 5, 0, 1, 0, 12, 0, 1, 0, 13, 0, 0, 1, 17, 0, 0, 1]


def as_labels(source, marked=True):
    """The source, marked as a reader of label maps does."""
    mark = vtkUnsignedCharArray()
    mark.SetName("IsLabelMap")
    mark.InsertNextValue(1)
    if marked:
        output(source).GetFieldData().AddArray(mark)
        source.GetClientSideObject().Modified()
    return source


def green(image):
    """Pixels of values from 5 to 12 under the map STEPS."""
    return int(((image[:, :, 1] > image[:, :, 0]) & (image[:, :, 1] > image[:, :, 2])).sum())


def test_labels_of_a_reference_are_never_blended():
    """Between the labels 0 and 17 no pixel has the colour of 8, in slices nor in 3D."""
    own = smooth(2) * 0.17
    for marked in (False, True):
        labels = as_labels(volume((smooth(3) > 50) * numpy.uint8(17)), marked)
        compare = CompareVolumes(Input=volume(own), Reference=labels, Show="Reference")
        for interpolation in ("Nearest", "Linear", "Cubic"):
            view = flat_view(2, MIDDLE, HALF)
            display = show_slices(compare, view, ("Axial",), MIDDLE, 0.0, 17.0)
            display.LookupTable.RGBPoints = STEPS
            display.SliceInterpolation = interpolation
            image = picture(view)
            assert min((image[:, :, 0] == 1).sum(), (image[:, :, 2] == 1).sum()) > 1000
            blended = not marked and interpolation != "Nearest"
            assert (green(image) > 100) == blended, (marked, interpolation, green(image))
            Delete(view)
        view = view_along((0.2, 0.3, -1), MIDDLE, 90.0, half_height=20.0)
        view.MultiSamples = 0
        show_volume(compare, view, "Deformed Volume", STEPS, [0, 1, 0.5, 0, 17, 1, 0.5, 0])
        image = picture(view)
        assert (image[:, :, 0] > 0.9).sum() > 1000
        assert (green(image) > 100) != marked, (marked, green(image))
        Delete(view)


def test_a_scan_beside_labels_stays_smooth():
    """The reference of a label map is read as it is without one."""
    pictures = []
    for marked in (False, True):
        compare = CompareVolumes(Input=as_labels(volume(smooth(2)), marked),
                                 Reference=volume(smooth(3)), Show="Reference")
        pictures.append(compared_picture(compare, "None", SliceInterpolation="Cubic"))
    assert (pictures[0] == pictures[1]).all()


def test_show_sends_no_voxel():
    pair = WithCavity()
    view = flat_view(2, MIDDLE, HALF)
    display = show_slices(pair.compare, view, ("Axial",), MIDDLE)
    display.SliceComparison = "Two colours"
    pictures = {"Both": picture(view)}
    assert brainshift.counters(display)["volumeUploads"] == 3, "volume, reference, cavity"
    for show in ("Reference", "Deformed"):
        pair.compare.Show = show
        pictures[show] = picture(view)
    before = brainshift.counters(display)
    for show in ("Both", "Reference", "Deformed", "Both"):
        pair.compare.Show = show
        assert (picture(view) == pictures[show]).all(), show
    after = brainshift.counters(display)
    assert after["bytesUploaded"] == before["bytesUploaded"], "Show uploads"
    assert after["programsCompiled"] == before["programsCompiled"], "Show compiles"
    pair.bent.Strokes = brainshift.soft((16, 16, 16), (0, 5, 0), 12)
    picture(view)
    sent = brainshift.counters(display)["bytesUploaded"] - after["bytesUploaded"]
    assert sent == LATTICE_BYTES, sent
    Delete(view)


# State files --------------------------------------------------------------------------------------


def make_scene():
    wavelet = simple.Wavelet()
    bent = FreeFormDeformation(Input=wavelet, Strokes=brainshift.soft((0, 0, 0), (3, 0, 0), 9))
    cavity = simple.Calculator(Input=wavelet, Function="coordsX*coordsX+coordsY*coordsY<9",
                               ResultArrayName="hole")
    compare = CompareVolumes(registrationName="Compared", Input=bent, Reference=wavelet,
                             Cavity=cavity, CavityLabels=[1, 5],
                             ReferenceTranslation=[1.1, 2.2, 0.0])
    view = view_along((0, 0, -1), (0, 0, 0), 60, half_height=9)
    display = show_slices(compare, view, ("Axial",), (0, 0, 0.5))
    color_grey(display, view, 40, 280, "RTData")
    display.SliceComparison = "Gradient"
    display.FullGradient = 0.25
    display.WipePosition = [1.5, -2.5, 3.5]
    return compare, display, view


def pictures_of(compare, display, view):
    """As it is, wiped, and the other volume alone."""
    pictures = [picture(view)]
    display.SliceComparison = "Wipe"
    pictures.append(picture(view))
    compare.Show = "Both"
    pictures.append(picture(view))
    return pictures


def test_a_state_file_keeps_the_comparison():
    for show in ("Both", "Reference"):
        simple.ResetSession()
        load_plugin()
        compare, display, view = make_scene()
        compare.Show = show
        picture(view)
        name = scratch("CompareModes.pvsm")
        simple.SaveState(name)
        before = pictures_of(compare, display, view)
        simple.ResetSession()
        load_plugin()
        simple.LoadState(name)
        compare = simple.FindSource("Compared")
        view = simple.GetActiveViewOrCreate("RenderView")
        view.UseFXAA = 0
        display = simple.GetDisplayProperties(compare, view)
        assert compare.Show == show and list(compare.CavityLabels) == [1, 5]
        assert compare.Cavity is not None
        assert display.SliceComparison == "Gradient" and display.FullGradient == 0.25
        assert list(display.WipePosition) == [1.5, -2.5, 3.5]
        after = pictures_of(compare, display, view)
        for was, now in zip(before, after):
            assert (was == now).all(), show
        assert is_grey(before[0]).all() == (show != "Both"), "one alone is grey"
        assert (before[0] != before[2]).any()


run_tests(globals())
