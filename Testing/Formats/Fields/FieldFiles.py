# SPDX-License-Identifier: BSD-3-Clause
# Proves that files keep lattices and dense fields, that File > Save Data has their formats, and
# that a field that is read back bends a volume as the strokes did.
import os

import numpy
from brainshift_testing import (assert_says, ball, load_plugin, messages, output, run_tests,
                                scratch, volume, voxels)
from saving_testing import assert_fails, assert_nothing_left, full_disk

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import servermanager  # noqa: E402
from paraview.simple import (  # noqa: E402
    BakeDeformation, DeformationField, DICOMVolumeReader, FreeFormDeformation, GetSources,
    OpenDataFile, SaveData)

MIDDLE = (16.0, 16.0, 16.0)
STAMP = brainshift.stamp(MIDDLE, (16.0, 16.0, 0.0), 4.0, major=15.0, minor=12.0)
TURNED = (0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 1.0)
FORMATS = (".nii", ".nii.gz", ".mha", ".mhd", ".nrrd")


def bent(strokes=STAMP, **properties):
    return FreeFormDeformation(Input=volume(ball()), Strokes=strokes, **properties)


def baked(filter):
    return voxels(BakeDeformation(Input=filter)).astype(float)


def test_lattices_come_back():
    for kernel in ("Catmull-Rom", "B-Spline"):
        name = scratch("lattice.vti")
        saved = bent(LatticeDimensions=[9, 10, 11], Kernel=kernel, Strength=0.8)
        brainshift.save_lattice(saved, name)
        loaded = bent(strokes=[])
        brainshift.load_lattice(loaded, name)
        assert list(loaded.LatticeDimensions) == [9, 10, 11] and loaded.Kernel == kernel
        assert numpy.abs(baked(loaded) - baked(saved)).max() < 1e-3
        assert numpy.abs(baked(loaded) - ball()).max() > 20.0
        loaded.Strokes = STAMP
        assert numpy.abs(baked(loaded) - baked(saved)).max() > 20.0, "strokes add to it"


def test_a_lattice_tells_of_its_mask():
    """Without the mask other tissue moves, and with it the picture is the same."""
    half = numpy.zeros(ball().shape, numpy.uint8)
    half[:, :, :16] = 1
    mask = {"Mask": volume(half), "MaskGrowth": 0.0, "Feather": 3.0}
    saved, name = bent(**mask), scratch("masked.vti")
    brainshift.save_lattice(saved, name)
    for settings, words in ((mask, ""), ({}, "This deformation has no mask"),
                            ({**mask, "Feather": 9.0}, "This deformation has a mask that lets")):
        loaded = bent(strokes=[], **settings)
        with messages() as said:
            brainshift.load_lattice(loaded, name)
            away = numpy.abs(baked(loaded) - baked(saved)).max()
        if words:
            assert away > 5.0, away
            assert_says(said.text, "The base lattice was drawn with a mask that lets", words)
        else:
            assert away < 1e-3 and "drawn with" not in said.text, (away, said.text)
    plain = scratch("plain.vti")
    brainshift.save_lattice(bent(), plain)
    with messages() as said:
        loaded = bent(strokes=[], **mask)
        brainshift.load_lattice(loaded, plain)
        loaded.UpdatePipeline()
    assert "drawn with" not in said.text, "a mask of one's own choice"


def test_dense_fields_come_back():
    expected = baked(bent())
    for ending in FORMATS:
        for direction in ("Forward", "Backward"):
            name = scratch(f"dense{ending}")
            brainshift.save_field(bent(), name, direction)
            loaded = bent(strokes=[], LatticeDimensions=[33, 33, 33])
            loaded.Lattice = brainshift.load_field(name)
            difference = numpy.abs(baked(loaded) - expected)
            assert difference.mean() < 0.3, (ending, direction, difference.mean())
            # The wrong direction gives another picture.
            wrong = "Forward" if direction == "Backward" else "Backward"
            loaded.Lattice = brainshift.load_field(name, direction=wrong)
            assert numpy.abs(baked(loaded) - expected).mean() > 1.0, (ending, direction)


def test_fields_lie_where_the_volume_lies():
    turned = volume(ball(), origin=(100.0, -50.0, 30.0), spacing=(1.0, 1.5, 2.0), direction=TURNED)
    filter = FreeFormDeformation(Input=turned, Strokes=brainshift.soft(
        output(turned).GetCenter(), (4, 3, 2), 14.0))
    for ending in FORMATS:
        name = scratch(f"turned{ending}")
        brainshift.save_field(filter, name, spacing=(2.0, 2.0, 2.0))
        reader = brainshift.load_field(name).Input
        saved = DeformationField(
            Input=filter, Direction="Backward", SampleGrid="Given Spacing", Spacing=[2, 2, 2])
        assert numpy.allclose(output(reader).GetBounds(), output(saved).GetBounds(), atol=1e-3)
        found, expected = voxels(reader, "Displacement"), voxels(saved, "Displacement")
        assert numpy.isclose(numpy.abs(found).max(), numpy.abs(expected).max(), rtol=1e-5)
        assert numpy.allclose(found.sum(axis=(0, 1, 2)), expected.sum(axis=(0, 1, 2)), rtol=1e-3)


def test_the_world_of_a_saved_field_is_the_one_asked_for():
    """Half a turn about z leads from RAS to LPS: it reverses the sums along x and y."""
    middle = output(volume(ball())).GetCenter()
    filter = bent(brainshift.soft(middle, (4, 3, 2), 14.0))
    sums = {}
    for world in ("RAS", "LPS"):
        brainshift.save_field(filter, scratch("world.nrrd"), world=world)
        reader = brainshift.load_field(scratch("world.nrrd"), world="RAS").Input
        sums[world] = voxels(reader, "Displacement").sum(axis=(0, 1, 2))
        ends = numpy.array(output(reader).GetBounds()).reshape(3, 2).mean(axis=1)
        sign = 1 if world == "RAS" else -1
        assert numpy.allclose(ends, numpy.array(middle) * (sign, sign, 1)), (world, ends)
    assert numpy.abs(sums["RAS"]).min() > 100.0
    assert numpy.allclose(sums["LPS"], sums["RAS"] * (-1, -1, 1), rtol=1e-5), sums


def test_a_full_disk_keeps_the_old_file_and_says_so():
    for ending in FORMATS:
        name = scratch(f"kept{ending}")
        brainshift.save_field(bent(), name, "Forward")
        with open(name, "rb") as file:
            old = file.read()
        with full_disk(2000):
            told = assert_fails(lambda: brainshift.save_field(bent(), name, "Backward"),
                                f"kept{ending} was not written", "cannot be written: ")
        assert_says(told, f"kept{ending} cannot be written")
        with open(name, "rb") as file:
            assert file.read() == old, ending
    assert_nothing_left(name)


def test_save_data_of_the_window_has_the_formats():
    field = DeformationField(Input=bent(), Direction="Backward")
    field.UpdatePipeline()
    offered = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
    text = offered.GetSupportedFileTypes(field.SMProxy, 0)
    assert_says(text, "Displacement field (BrainShift)", "*.nii.gz", "*.nrrd", "*.mha")
    for ending in (".nii", ".nii.gz", ".mha", ".nrrd"):
        name = scratch(f"saved_data{ending}")
        if os.path.exists(name):
            os.remove(name)
        SaveData(name, proxy=field)
        assert os.path.getsize(name) > 1000, ending
        lattice = brainshift.load_field(name).Input
        assert numpy.allclose(numpy.abs(voxels(lattice, "Displacement")).max(),
                              numpy.abs(voxels(field, "Displacement")).max(), rtol=1e-5), ending


def fails(call, *words):
    """A call raises ValueError with these words, and leaves no source."""
    before = len(GetSources())
    with messages():
        try:
            call()
        except ValueError as error:
            assert_says(str(error), *words)
            assert "output window" not in str(error), error
        else:
            raise AssertionError(f"it must fail with {words}")
    assert len(GetSources()) == before


def test_a_file_that_is_none_raises_the_reason():
    """All functions that open a file say why they cannot."""
    plain = scratch("reason.mha")
    brainshift.save_volume(volume(ball()), plain, world="RAS")
    filter = bent()
    fails(lambda: brainshift.load_field(plain), "reason.mha", "1 component")
    fails(lambda: brainshift.load_field(scratch("missing.nrrd")), "missing.nrrd", "does not exist")
    fails(lambda: brainshift.load_lattice(filter, scratch("missing.vti")), "missing.vti",
          "does not exist")
    SaveData(scratch("plain.vti"), proxy=volume(ball()))
    fails(lambda: brainshift.load_lattice(filter, scratch("plain.vti")), "plain.vti",
          "no point array of 3 components")
    assert filter.Lattice is None and list(filter.LatticeDimensions) == [19, 19, 19]
    fails(lambda: brainshift.read_points(scratch("missing.csv")), "missing.csv")
    folder = scratch("sample/seg3d-utah")
    os.makedirs(folder, exist_ok=True)
    for name in ("seg3d_mr_t1.nii.gz", "seg3d_brainmask.nii.gz"):
        with open(os.path.join(folder, name), "w", encoding="ascii") as file:
            file.write("no volume")
    before = os.environ.get("BRAINSHIFT_DATA")
    os.environ["BRAINSHIFT_DATA"] = os.path.dirname(folder)
    fails(brainshift.open_sample, "seg3d_mr_t1.nii.gz")
    del os.environ["BRAINSHIFT_DATA"]
    if before is not None:
        os.environ["BRAINSHIFT_DATA"] = before
    with messages():
        series = DICOMVolumeReader(FileName=scratch("no-folder"))
        fails(lambda: brainshift.dicom_patient(series), "no-folder", "does not exist")


def test_a_field_without_numbers_somewhere_is_refused():
    image = numpy.zeros((9, 9, 9, 3), numpy.float32)
    image[:, :, :4] = numpy.nan
    header = ("ObjectType = Image\nNDims = 3\nDimSize = 9 9 9\nElementType = MET_FLOAT\n"
              "BinaryData = True\nElementNumberOfChannels = 3\nOffset = 0 0 0\n"
              "ElementSpacing = 8 8 8\nElementDataFile = LOCAL\n")
    name = scratch("gap.mha")
    with open(name, "wb") as file:
        file.write(header.encode() + image.tobytes())
    for direction in ("Forward", "Backward"):
        fails(lambda way=direction: brainshift.load_field(name, direction=way),
              "gap.mha has no finite number at 324 of 729 points, from -24 -64 0 to 0 0 64 mm")
    with messages() as said:
        OpenDataFile(name).UpdatePipeline()
    assert_says(said.text, "gap.mha has no finite number at 324 of 729 points")


def test_plain_volumes_are_no_fields():
    field = volume(ball())
    name = scratch("plain.mha")
    with messages() as said:
        try:
            brainshift.load_field(scratch("missing.mha"))
        except ValueError as error:
            assert_says(str(error), "missing.mha", "does not exist")
        else:
            raise AssertionError("there is no such file")
    assert_says(said.text, "missing.mha", "does not exist")
    with messages() as said:
        try:
            brainshift.save_field(field, name)
        except OSError as error:
            assert_says(str(error), "plain.mha")
        else:
            raise AssertionError("a plain volume has no field")
    assert_says(said.text, "carries no deformation")


run_tests(globals())
