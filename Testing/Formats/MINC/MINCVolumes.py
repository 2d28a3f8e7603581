# SPDX-License-Identifier: BSD-3-Clause
# Proves that MINC2 volumes lie where nibabel puts them, in 48 orders of axes and tilted, that
# slices are rescaled as nibabel rescales them, and that time, labels and errors are told.
import h5py
import minc_files
import nibabel
import numpy
import volume_files
from brainshift_testing import (
    data, field, load_plugin, messages, output, run_tests, scratch, voxels)
from volume_places import assert_same_head, assert_same_places, matrix, opened, places

load_plugin()
from paraview import simple  # noqa: E402 after the plugin

SHAPE = (4, 5, 3)
AFFINE = list(volume_files.turns())[7]  # each axis leads along its axis of the world
READER = "MINCVolumeReader"


def test_minc_lies_where_nibabel_puts_it():
    farthest = 0.0
    for affine in volume_files.affines():
        name = minc_files.write(
            scratch("turned.mnc"), volume_files.numbered(SHAPE, "float32"), affine)
        judged = nibabel.load(name)
        assert numpy.abs(judged.affine - affine).max() < 1e-6, (judged.affine, affine)
        farthest = max(farthest, assert_same_places(name, READER, judged))
    print(f"MINC: farthest voxel {farthest} mm")


def test_slices_are_rescaled():
    """Whole numbers over the range of their type, by the least and largest value of their slice."""
    for kind in ("uint8", "int16", "uint16", "int32"):
        stored = volume_files.numbered(SHAPE, kind)
        ranges = [(-1.0, 2.0), (0.0, 100.0), (5.0, 6.0), (-1000.0, 0.0)]
        name = minc_files.write(scratch("scaled.mnc"), stored, numpy.eye(4), slice_ranges=ranges)
        limits = numpy.iinfo(kind)
        shares = (stored.astype(float) - limits.min) / (float(limits.max) - limits.min)
        low, high = (numpy.array(side).reshape(-1, 1, 1) for side in zip(*ranges))
        known = low + shares * (high - low)
        judged = numpy.asarray(nibabel.load(name).dataobj)
        assert numpy.allclose(judged, known, rtol=1e-6, atol=1e-6), kind
        source = opened(name, READER)
        shown = voxels(source).transpose(2, 1, 0)
        is_wide = kind == "int32"  # of more digits than float32 has
        assert shown.dtype == (numpy.float64 if is_wide else numpy.float32)
        rtol, atol = (1e-9, 1e-6) if is_wide else (1e-5, 1e-4)
        assert numpy.allclose(shown, known, rtol=rtol, atol=atol), (kind, shown, known)
        simple.Delete(source)


def with_limits(name, limits, along):
    """Gives a file image-min and image-max of these numbers along these axes."""
    with h5py.File(name, "r+") as file:
        image = file["minc-2.0/image/0"]
        for limit, numbers in zip(("image-min", "image-max"), limits):
            kept = dict(image[limit].attrs)
            del image[limit]
            made = image.create_dataset(limit, data=numbers)
            made.attrs.update({**kept, "dimorder": numpy.bytes_(along)})


def test_slices_of_each_time_are_rescaled():
    series = numpy.stack([volume_files.numbered(SHAPE, "int16") * 100 - 2000 * i for i in range(2)])
    shares = (series + 32768.0) / 65535.0
    random = numpy.random.default_rng(1)
    for along, sides in (("time,xspace", (2, 4)), ("time", (2,)), ("", ())):
        name = minc_files.write(scratch("times.mnc"), series, numpy.eye(4), times=(0.0, 1.0),
                                slice_ranges=[(0.0, 1.0)])
        low = random.uniform(-10.0, 10.0, sides)
        high = low + random.uniform(1.0, 50.0, sides)
        with_limits(name, (low, high), along)
        low, high = (numpy.reshape(limit, sides + (1,) * (4 - len(sides))) for limit in (low, high))
        known = low + shares * (high - low)
        source = opened(name, READER)
        for time in (1.0, 0.0):
            source.UpdatePipeline(time)
            shown = voxels(source).transpose(2, 1, 0)
            assert numpy.allclose(shown, known[int(time)], atol=1e-3), (along, time)
        simple.Delete(source)
    for along, sides in (("xspace", (4,)), ("xspace,time", (2, 4))):
        with_limits(name, (numpy.zeros(sides), numpy.ones(sides)), along)
        with messages() as said:
            assert output(simple.MINCVolumeReader(FileName=name)).GetNumberOfPoints() == 0
        assert f"has an image-min along {along}, which must be the first axes" in said.text


def test_types_of_whole_numbers_stay():
    for kind in ("int8", "uint8", "int16", "uint16", "int32", "uint32"):
        name = minc_files.write(scratch("whole.mnc"), volume_files.numbered(SHAPE, kind), AFFINE,
                                kind=minc_files.INTEGER)
        source = opened(name, READER)
        assert voxels(source).dtype == numpy.dtype(kind)
        assert sorted(voxels(source).ravel()) == list(range(1, 61))
        simple.Delete(source)


def test_time_becomes_steps():
    series = numpy.stack([volume_files.numbered(SHAPE, "float32") + 100 * i for i in range(3)])
    name = minc_files.write(scratch("series.mnc"), series, AFFINE, times=(2.0, 2.5))
    source = opened(name, READER)
    source.UpdatePipelineInformation()
    assert list(source.TimestepValues) == [2.0, 4.5, 7.0]
    for step, time in enumerate((2.0, 4.5, 7.0)):
        source.UpdatePipeline(time)
        image = source.GetClientSideObject().GetOutputDataObject(0)
        found = image.GetPointData().GetArray("Intensity").GetRange()
        assert found == (1.0 + 100 * step, 60.0 + 100 * step), found


def uneven(axis, positions, times=(0.0, 1.0)):
    """A series of three volumes with an uneven axis, opened; and what was said."""
    series = numpy.stack([volume_files.numbered(SHAPE, "float32") + 100 * i for i in range(3)])
    name = minc_files.write(scratch("uneven.mnc"), series, numpy.eye(4), times=times)
    minc_files.make_uneven(name, axis, positions)
    with messages() as said:
        source = simple.MINCVolumeReader(FileName=name)
        source.UpdatePipeline()
    return source, said.text


def test_uneven_times_are_those_of_the_file():
    source, said = uneven("time", (0.0, 2.5, 10.0))
    assert not said, said
    assert list(source.TimestepValues) == [0.0, 2.5, 10.0], source.TimestepValues
    for step, time in enumerate((0.0, 2.5, 10.0)):
        source.UpdatePipeline(time)
        image = source.GetClientSideObject().GetOutputDataObject(0)
        found = image.GetPointData().GetArray("Intensity").GetRange()
        assert found == (1.0 + 100 * step, 60.0 + 100 * step), found


def test_uneven_times_that_are_none_are_told():
    for positions in ((0.0, 5.0, 5.0), (4.0, 2.0, 1.0), (0.0, 1.0), (0.0, numpy.nan, 3.0),
                      (0.0, 1.0, numpy.inf)):
        source, said = uneven("time", positions)
        assert "has uneven times along time" in said, (positions, said)
        assert list(source.TimestepValues) == [0.0, 1.0, 2.0], source.TimestepValues


def test_an_uneven_axis_of_space_says_its_error():
    source, said = uneven("xspace", (0.0, 1.0, 2.0, 6.0))
    assert "has an uneven spacing along xspace" in said, said
    assert "even spacing 2 mm, up to 2 mm from its positions" in said, said
    assert output(source).GetSpacing()[0] == 2.0 and output(source).GetBounds()[1] == 6.0
    source, said = uneven("xspace", (-3.0, -1.0, 1.0, 3.0))  # even after all
    assert not said, said
    assert output(source).GetSpacing()[0] == 2.0 and output(source).GetBounds()[0] == -3.0
    for positions in ((0.0, 2.0, 1.0, 3.0), (0.0, numpy.nan, 1.0, 3.0)):
        source, said = uneven("xspace", positions)
        assert "has positions along xspace that neither grow nor fall" in said, said
    source, said = uneven("xspace", (0.0, 0.0, 0.0, 0.0))
    assert "but no list of its positions; it is shown with the even spacing 1" in said, said
    assert output(source).GetNumberOfPoints() == 60


def test_labels_are_named():
    name = minc_files.write(scratch("labels.mnc"), volume_files.numbered(SHAPE, "uint8"), AFFINE,
                            kind=minc_files.LABEL, labels=((3, "putamen"), (7, "thalamus")))
    source = opened(name, READER)
    assert field(source, "LabelValues").tolist() == [3, 7]
    names = output(source).GetFieldData().GetAbstractArray("LabelNames")
    assert [names.GetValue(i) for i in range(2)] == ["putamen", "thalamus"]


def test_the_same_head():
    first = opened(data("seg3d-utah", "seg3d_mr_t1.nii.gz"), "NIFTIVolumeReader")
    values = voxels(first).astype(numpy.float32).transpose(2, 1, 0)
    name = minc_files.write(scratch("head.mnc"), values, matrix(output(first)))
    assert_same_head(opened(name, READER), first)


def test_what_cannot_be_read_is_named():
    good = minc_files.write(scratch("good.mnc"), volume_files.numbered(SHAPE), AFFINE,
                            kind=minc_files.INTEGER)
    with open(good, "rb") as file:
        content = file.read()
    for name, bad, words in (("minc1", b"CDF\x01" + bytes(100), "is a MINC1 file"),
                             ("other", b"no MINC at all", "does not begin like an HDF5 file"),
                             ("cut", content[:len(content) // 2], "libminc cannot open it")):
        bad_file = volume_files.write(scratch(f"{name}.mnc"), bad)
        with messages() as said:
            source = simple.MINCVolumeReader(FileName=bad_file)
            source.UpdatePipeline()
        assert words in said.text, (name, said.text)
        assert output(source).GetNumberOfPoints() == 0
        simple.Delete(source)
    source = opened(good, READER)
    assert len(places(voxels(source).transpose(2, 1, 0), matrix(output(source)))) == 60


run_tests(globals())
