# SPDX-License-Identifier: BSD-3-Clause
# Proves that one head as NIfTI, NRRD, MetaImage, DICOM, MINC2 and FreeSurfer file, its voxels in
# one of three orders, gives the same four views and the same letters: not one pixel differs. That
# a format's readers place voxels of all 48 orders is proved with numbers, by the tests of Filters.
import head_files
import nibabel
import numpy
import volume_files
from brainshift_testing import load_plugin, picture, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

WIDTH, HEIGHT = 180, 150
SLICES = ("axial", "coronal", "sagittal")
VOXELS, AFFINE = head_files.head()
WRITERS = head_files.writers()
FREESURFER = "MGZ by nibabel"


def lay_out():
    """Four views that show nothing, but keep what tells that they are four views."""
    first = simple.OpenDataFile(WRITERS["NIfTI by nibabel"](VOXELS, AFFINE))
    for view in brainshift.four_views(first).values():
        view.ViewSize = [WIDTH, HEIGHT]
        simple.Hide(first, view)


def four_pictures(name, letters=True):
    """The four views of a file, by name."""
    source = simple.OpenDataFile(name)
    views = brainshift.four_views(source)
    pictures = {}
    for key, view in views.items():
        if key in SLICES:
            simple.GetDisplayProperties(source, view).OrientationMarks = int(letters)
        else:
            view.CameraPosition, view.CameraFocalPoint = (0, 0, 1), (0, 0, 0)
            simple.ResetCamera(view)
        pictures[key] = picture(view)
    assert len(simple.GetRenderViews()) == len(views), "views of another file"
    simple.Delete(source)
    return pictures


def differing(found, expected):
    """How many pixels of each view differ."""
    return {key: int((found[key] != expected[key]).any(axis=2).sum()) for key in expected}


def assert_all_the_same(affine, orders_of):
    """Files of the writers, each in its orders of axes, show what one NIfTI file shows."""
    expected = four_pictures(WRITERS["NIfTI by nibabel"](VOXELS, affine))
    for kind, orders in orders_of.items():
        for order in orders:
            turned = head_files.reordered(VOXELS, affine, head_files.ORDERS[order])
            name = WRITERS[kind](*turned)
            found = differing(four_pictures(name), expected)
            print(kind, order, found, flush=True)
            assert not any(found.values()), (kind, order, found)


def test_there_is_something_to_compare():
    for affine in (AFFINE, head_files.OBLIQUE):
        name = WRITERS["NIfTI by nibabel"](VOXELS, affine)
        shown, without = four_pictures(name), four_pictures(name, letters=False)
        for key, image in shown.items():
            assert (image.max(axis=2) > 0.2).mean() > 0.15, key
            letters = (image != without[key]).any(axis=2)
            assert letters.any() == (key in SLICES), key
            if key in SLICES:
                edges = (letters[:20], letters[-20:], letters[:, :20], letters[:, -20:])
                assert all(edge.any() for edge in edges), key
        again = differing(four_pictures(name), shown)
        assert not any(again.values()), again


def test_every_format_gives_the_same_views():
    names = list(head_files.ORDERS)  # in turn, so that the two writers of a format differ
    orders_of = {kind: [names[i % len(names)]] for i, kind in enumerate(WRITERS)}
    assert_all_the_same(AFFINE, {**orders_of, "NIfTI by nibabel": names})


def test_a_tilted_scan_looks_the_same_too():
    kinds = [kind for kind in WRITERS if kind != FREESURFER]
    assert_all_the_same(head_files.OBLIQUE, {kind: ["to the left"] for kind in kinds})


def stated_by(name):
    """The affine of a FreeSurfer file from its own numbers, without further rounding."""
    header = nibabel.load(name).header
    affine = numpy.eye(4)
    affine[:3, :3] = header["Mdc"].T.astype(float) * header["delta"].astype(float)
    affine[:3, 3] = header["Pxyz_c"] - affine[:3, :3] @ (numpy.array(header["dims"][:3]) / 2.0)
    return affine


def test_a_tilted_scan_of_freesurfer():
    """Its float32 directions put the head 1e-6 mm elsewhere. Rays then start elsewhere, and up to
    54 of 27000 pixels of the 3D view differ. So it is compared with a head at that very place."""
    turned, affine = head_files.reordered(
        VOXELS, head_files.OBLIQUE, head_files.ORDERS["to the left"])
    name = WRITERS[FREESURFER](turned, affine)
    stated = stated_by(name)
    assert 0 < numpy.abs(stated - affine).max() < 1e-4, stated - affine
    found = differing(
        four_pictures(name), four_pictures(WRITERS["NRRD by hand"](turned, stated)))
    assert not any(found.values()), found


def test_a_head_that_is_turned_over_is_seen():
    """What a reader would show that takes one axis the wrong way."""
    write = WRITERS["NRRD by hand"]
    expected = four_pictures(write(VOXELS, AFFINE))
    for axis, views in enumerate((("axial", "coronal", "volume"), ("axial", "sagittal", "volume"),
                                  ("coronal", "sagittal", "volume"))):
        found = differing(four_pictures(write(numpy.flip(VOXELS, axis), AFFINE)), expected)
        assert all(found[view] > 1000 for view in views), (axis, found)


def test_sides_that_are_not_known_are_seen_in_the_letters_alone():
    def write(space):
        content = volume_files.nrrd(VOXELS, AFFINE, space)
        return volume_files.write(scratch("space.nrrd"), content)

    for letters in (True, False):
        expected = four_pictures(write("right-anterior-superior"), letters)
        found = differing(four_pictures(write("scanner-xyz"), letters), expected)
        assert [found[key] > 0 for key in SLICES] == [letters] * 3, (letters, found)
        assert found["volume"] == 0, found


lay_out()
run_tests(globals())
