# SPDX-License-Identifier: BSD-3-Clause
# Proves that the comparison Local similarity tints a slice by one minus the squared correlation of
# the baked volume and the reference within a window, as found here from their voxels. Equal and
# inverted volumes, flat tissue and the cavity stay grey, and places without a reference are dark.
# A shift by a few mm is seen at edges. The map follows a stroke while nothing but the lattice is
# sent.
import numpy
from brainshift_testing import data, load_plugin, output, picture, run_tests, volume, voxels
from slices_testing import flat_view, pixel_positions, show_slices, trilinear

load_plugin()
import brainshift  # noqa: E402 after the plugin
from compare_testing import HALF, MIDDLE, STROKE, Pair, compared_picture, smooth  # noqa: E402
from paraview.simple import (  # noqa: E402
    BakeDeformation, CompareVolumes, Delete, FreeFormDeformation, NIFTIVolumeReader)

WAY = "Local similarity"
TINT = 0.7  # share of its colour that a pixel has at most
LEVEL = 1.0 / 255.0
ENOUGH = 1.5 * LEVEL  # a share of greys and a colour map's entry round otherwise
WINDOW = 12.0  # mm, the default
FLAT, SURE = 0.03, 0.08  # standard deviations, share of the range of greys: see compare-volumes.md
JUDGED = (slice(2, None, 5),) * 2  # every fifth pixel along a side
LATTICE_BYTES = 19 ** 3 * 3 * 4


def tint_of(image, colors="Red and green"):
    """How strong the tint of each pixel is, 0 to 1: what one colour has and another lacks."""
    strong, weak = (0, 1) if colors == "Red and green" else (2, 0)
    return (image[:, :, strong] - image[:, :, weak]) / TINT


def whole_window(diameter=WINDOW):
    """Places all over a round window (mm from its middle, right and up), with weights that fall
    to 0 at its edge."""
    right, up = numpy.meshgrid(*[diameter / 2 * numpy.linspace(-1, 1, 17)] * 2)
    weights = numpy.clip(1 - (right ** 2 + up ** 2) / (diameter / 2) ** 2, 0, 1) ** 2
    kept = weights > 0
    return numpy.stack([right[kept], up[kept]], axis=1), weights[kept]


def sampled_window(diameter=WINDOW):
    """The places that stand for it: a spiral of 24 that is denser in the middle."""
    number = numpy.arange(24)
    weights = numpy.sqrt(1 - (number + 0.5) / 24)
    distance = diameter / 2 * numpy.sqrt(1 - weights)
    angle = number * numpy.pi * (3 - numpy.sqrt(5))
    return numpy.stack([distance * numpy.cos(angle), distance * numpy.sin(angle)], axis=1), weights


def smoothstep(low, high, value):
    share = numpy.clip((value - low) / (high - low), 0, 1)
    return share * share * (3 - 2 * share)


def tint_expected(pixels, read, window):
    """The tint of each pixel of an axial slice, and the share of its window that counts. `read`:
    gives the shares of both volumes at places, and where they count."""
    offsets, weights = window
    sums = 0.0
    for (a, b), weight in zip(offsets, weights):
        own, other, counts = read(pixels + numpy.array((a, b, 0.0)))
        terms = (numpy.ones_like(own), own, other, own * own, other * other, own * other)
        sums = sums + weight * numpy.where(counts, numpy.stack(terms), 0.0)
    share = sums[0] / weights.sum()
    own, other, own2, other2, both = sums[1:] / numpy.maximum(sums[0], 1e-9)
    own2, other2 = (numpy.maximum(v, 0) for v in (own2 - own ** 2, other2 - other ** 2))
    squared = (both - own * other) ** 2 / ((own2 + 1e-6) * (other2 + 1e-6))
    varied = smoothstep(FLAT, SURE, numpy.sqrt(numpy.maximum(own2, other2)))
    known = smoothstep(0.5, 0.75, share)
    return known * varied * (1 - numpy.minimum(squared, 1)), share


class Judged(Pair):
    """The bent volume and its reference, read here where the test likes."""

    def __init__(self, strokes=STROKE):
        super().__init__()
        self.bent.Strokes = strokes
        self.baked_voxels = voxels(BakeDeformation(Input=self.bent))

    def read(self, places):
        own, within = trilinear(self.baked_voxels, places)
        other, inside = trilinear(self.voxels, (self.unturned(places) - self.origin) / self.spacing)
        low, high = float(self.voxels.min()), float(self.voxels.max())
        return numpy.clip(own / 100, 0, 1), (other - low) / (high - low), within & inside


def judged_pixels():
    return pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, HALF)[JUDGED]


def judged(image):
    return tint_of(image)[JUDGED]


def assert_near(found, expected, where, mean, largest):
    apart = numpy.abs(found - expected)[where]
    print(f"  mean {apart.mean():.4f}, largest {apart.max():.4f}", flush=True)
    assert apart.mean() < mean and apart.max() < largest, (apart.mean(), apart.max())


def test_the_tint_is_what_the_baked_volume_says():
    pixels = judged_pixels()
    # Without a bend, colours of 8 bits are left, and samples that lie so near the edge of the
    # reference that rounding decides whether they count. A bake has voxels 1 mm apart and is
    # straight in between; where both volumes hardly vary, a correlation feels that.
    for strokes, mean, largest in (((), 0.003, 0.05), (STROKE, 0.01, 0.25)):
        pair = Judged(strokes)
        for diameter in (WINDOW, 8.0):
            image = compared_picture(pair.compare, WAY, SimilarityWindow=diameter)
            expected, share = tint_expected(pixels, pair.read, sampled_window(diameter))
            assert 0.1 < expected.mean() < 0.9 and numpy.ptp(expected) > 0.6, expected.mean()
            assert_near(judged(image), expected, share >= 0.0, mean, largest)
            unknown = share < 0.5 - 1e-3
            assert unknown.any() and (judged(image)[unknown] == 0).all(), "too little is known"
            # The whole window, which the samples stand for.
            whole, share = tint_expected(pixels, pair.read, whole_window(diameter))
            assert_near(judged(image), whole, share > 0.99, 0.03, 0.25)


def test_tissue_stays_to_be_seen():
    pair = Judged()
    own = pair.baked_share()
    known = pair.read(pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, HALF))[2]
    for colors, tinted, grey in (("Red and green", 0, 1), ("Blue and orange", 2, 0)):
        image = compared_picture(pair.compare, WAY, ComparisonColors=colors)
        tint = TINT * tint_of(image, colors)
        expected = own * (1 - tint)
        assert_near(image[:, :, grey], expected, known, 0.01, 0.1)
        assert_near(image[:, :, tinted], expected + tint, known, 0.01, 0.1)
    red, blue = (tint_of(compared_picture(pair.compare, WAY, ComparisonColors=colors), colors)
                 for colors in ("Red and green", "Blue and orange"))
    assert numpy.abs(red - blue).max() < 3.1 * LEVEL / TINT


def test_equal_and_inverted_volumes_agree():
    own = smooth(2)
    bent = FreeFormDeformation(Input=volume(own), Strokes=STROKE)
    baked = voxels(BakeDeformation(Input=bent, Interpolation="Linear"))
    plain = compared_picture(bent, "None")
    for name, reference in (("equal", baked), ("inverted", 100 - baked),
                            ("darker", 0.3 * baked + 20)):
        compare = CompareVolumes(Input=bent, Reference=volume(reference.astype(numpy.float32)))
        image = compared_picture(compare, WAY, ReferenceRange=[0.0, 100.0])
        tint = tint_of(image)
        # The voxels of a bake lie 1 mm apart; between them it is not what bends in between.
        assert tint.mean() < 0.01 and tint.max() < 0.1, (name, tint.mean(), tint.max())
        assert numpy.abs(image[:, :, 1] - plain[:, :, 1]).max() < TINT * tint.max() + 2 * LEVEL
    unbent = volume(own)
    for reference in (own.copy(), 100 - own):
        compare = CompareVolumes(Input=unbent, Reference=volume(reference))
        assert tint_of(compared_picture(compare, WAY)).max() <= 2 * LEVEL, "not even a level"


def plates(shift):
    """Two halves, dark and bright, with an edge across x, and noise that no one should see."""
    z, y, x = numpy.mgrid[0:49, 0:49, 0:49]
    noise = numpy.random.default_rng(int(shift)).normal(0, 0.7, x.shape)
    return (20 + 60 / (1 + numpy.exp(-2 * (x - 16 - shift))) + noise).astype(numpy.float32)


def test_a_shift_is_seen_at_edges_only():
    tints = {}
    for shift in (0.0, 4.0):
        compare = CompareVolumes(Input=volume(plates(0)), Reference=volume(plates(shift)))
        tint = tint_of(compared_picture(compare, WAY))
        x = pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, HALF)[:, :, 0]
        tints[shift] = tint[numpy.abs(x - 18) < 2].mean()
        flat = (x < 8) | (x > 28)  # further than a window from both edges
        assert flat.any() and tint[flat].max() <= LEVEL, tint[flat].max()
    assert tints[0.0] < 0.05 and tints[4.0] > 0.35, tints


def test_it_is_the_same_at_all_contrasts_of_a_shift():
    pictures = []
    for reference in (plates(4.0), 100 - plates(4.0)):
        compare = CompareVolumes(Input=volume(plates(0)), Reference=volume(reference))
        pictures.append(tint_of(compared_picture(compare, WAY, ReferenceRange=[0.0, 100.0])))
    apart = numpy.abs(pictures[0] - pictures[1]).max()
    assert apart < 4.1 * LEVEL / TINT, apart  # two roundings in each picture, and of the sums


def test_the_window_lies_in_the_slice():
    """Volumes that change along one axis only have nothing to say in the slice across it."""
    cameras = {"Axial": 2, "Coronal": 1, "Sagittal": 0}
    waves = [numpy.broadcast_to(numpy.sin(0.9 * numpy.arange(33) + phase) * 40 + 50, (33,) * 3)
             for phase in (0.0, 1.6)]
    for axis in range(3):
        own, other = (volume(numpy.moveaxis(wave, 2, 2 - axis).astype(numpy.float32))
                      for wave in waves)
        compare = CompareVolumes(Input=own, Reference=other)
        for plane, across in cameras.items():
            view = flat_view(across, MIDDLE, HALF)
            display = show_slices(compare, view, (plane,), MIDDLE)
            display.SliceComparison = WAY
            tint = tint_of(picture(view))
            if across == axis:
                assert tint.max() == 0, (axis, plane, tint.max())
            else:
                assert tint.mean() > 0.5, (axis, plane, tint.mean())
            Delete(view)


def test_the_cavity_is_grey_and_gaps_are_dark():
    side = 33
    z, y, x = numpy.mgrid[0:side, 0:side, 0:side]
    holed = smooth(3)
    holed[:, :, 24:] = numpy.nan
    values, labels = smooth(2), ((x - 10) ** 2 + (y - 16) ** 2 < 36).astype(numpy.uint8)
    compare = CompareVolumes(Input=volume(values), Reference=volume(holed), Cavity=volume(labels))
    image = compared_picture(compare, WAY)
    tint = tint_of(image)
    plain = compared_picture(volume(values), "None")
    places = pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, HALF)
    from_middle = numpy.hypot(places[:, :, 0] - 10, places[:, :, 1] - 16)
    for name, grey, share in (("cavity", from_middle < 5.4, 1.0),
                              ("no reference", places[:, :, 0] > 23.1, 0.5)):
        assert grey.mean() > 0.05, name
        assert tint[grey].max() == 0, name
        apart = numpy.abs(image - share * plain)[grey].max()
        assert apart <= ENOUGH, (name, apart)
    beyond = (from_middle > 7) & (places[:, :, 0] < 20)
    assert tint[beyond].mean() > 0.3, tint[beyond].mean()

    def read(at):
        (own, inside), (other, _) = trilinear(values, at), trilinear(holed, at)
        removed = trilinear(labels, at)[0] > 0.5
        return own / 100, other / 100, inside & ~removed & ~numpy.isnan(other)

    expected, _ = tint_expected(judged_pixels(), read, sampled_window())
    outside = beyond[JUDGED]
    # At the very edge of the cavity rounding decides on a sample: 6 % of the weight at most.
    assert_near(judged(image), expected, outside, 0.01, 0.1)


def test_it_follows_a_stroke():
    pair = Pair()
    view = flat_view(2, MIDDLE, HALF)
    display = show_slices(pair.compare, view, ("Axial",), MIDDLE)
    display.SliceComparison = WAY
    before = picture(view)
    sent = brainshift.counters(display)["bytesUploaded"]
    pair.bent.Strokes = brainshift.soft((16, 16, 16), (0, 5, 0), 12)
    after = picture(view)
    assert brainshift.counters(display)["bytesUploaded"] - sent == LATTICE_BYTES
    assert numpy.abs(tint_of(after) - tint_of(before)).mean() > 0.02
    Delete(view)


# A real head --------------------------------------------------------------------------------------

PUSHED = numpy.array((-340.0, 30.0, 505.0))  # RAS mm, in the brain below the cortex


def head_and_reference(noise):
    """A head, bent by hand; and what another scanner would see after the same bend."""
    head = NIFTIVolumeReader(FileName=data("seg3d-utah", "seg3d_mr_t1.nii.gz"))
    bent = FreeFormDeformation(Input=head, Strokes=brainshift.soft(PUSHED, (0, 0, -6), 40))
    baked = BakeDeformation(Input=bent)
    image, values = output(baked), voxels(baked).astype(float)
    top = numpy.percentile(values, 99.9)
    values = top - values + numpy.random.default_rng(4).normal(0, noise * top, values.shape)
    reference = volume(values.astype(numpy.float32), image.GetOrigin(), image.GetSpacing())
    return bent, CompareVolumes(Input=bent, Reference=reference), top


def head_picture(compare, top, comparison):
    view = flat_view(1, PUSHED, 70.0)
    display = show_slices(compare, view, ("Coronal",), PUSHED, 0.0, top)
    display.SliceComparison = comparison
    image = picture(view)
    Delete(view)
    return image


def test_a_head_with_another_contrast():
    bent, compare, top = head_and_reference(0.02)
    stroke = tuple(bent.Strokes)
    own = head_picture(compare, top, "None")[:, :, 0]
    pixels = pixel_positions((-1, 0, 0), (0, 0, 1), PUSHED, 70.0)
    away = numpy.linalg.norm(pixels - PUSHED, axis=2)
    agreeing = tint_of(head_picture(compare, top, WAY))
    bent.Strokes = ()
    apart = tint_of(head_picture(compare, top, WAY))
    bent.Strokes = stroke
    brain = own > 0.2
    near, far = brain & (away < 20), brain & (away > 45)
    figures = [float(tint[where].mean()) for tint in (agreeing, apart) for where in (near, far)]
    print("  bent and not, near and far:", figures, flush=True)
    assert near.sum() > 1000 and far.sum() > 1000
    assert figures[2] > 2 * figures[0] + 0.15, "where the bend is missing"
    assert abs(figures[3] - figures[1]) < 0.02, "where nothing moved"
    assert (tint_of(head_picture(compare, top, WAY)) == agreeing).all()


run_tests(globals())
