# SPDX-License-Identifier: BSD-3-Clause
# Proves that volumes leave for other programs with their places, axes, types and numbers: nibabel
# and ITK find each voxel within 1e-3 mm of where it lay, and our reader finds the same image.
import os
import subprocess

import nibabel
import numpy
from brainshift_testing import (assert_says, ball, load_plugin, messages, output, run_tests,
                                scratch, volume, voxels)
from saving_testing import assert_fails, assert_nothing_left, full_disk
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkStringArray, vtkUnsignedCharArray

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import servermanager  # noqa: E402
from paraview.simple import (  # noqa: E402
    BakeDeformation, DeformationField, FreeFormDeformation, NIFTIVolumeReader, NRRDVolumeReader,
    OpenDataFile, SaveData)

FORMATS = (".nii", ".nii.gz", ".mha", ".mhd", ".nrrd")
TYPES = (numpy.uint8, numpy.int16, numpy.uint16, numpy.float32)
LPS = numpy.diag((-1.0, -1.0, 1.0, 1.0))
ALONG = numpy.eye(3)
OBLIQUE = numpy.array(((0.8, -0.36, 0.48), (0.6, 0.48, -0.64), (0.0, 0.8, 0.6)))
MIRRORED = OBLIQUE @ numpy.diag((1.0, -1.0, 1.0))
UPSIDE_DOWN = numpy.diag((1.0, -1.0, -1.0))  # a half turn, which leaves a quaternion without w
GRIDS = {"along": ALONG, "oblique": OBLIQUE, "mirrored": MIRRORED, "turned": UPSIDE_DOWN}
SHAPE = (4, 5, 6)
NOT_KNOWN = "world axes of the input are unknown"


def numbers(dtype, components=1):
    """Voxels [z, y, x], each with a number of its own, some of them high."""
    count = int(numpy.prod(SHAPE)) * components
    top = 250 if dtype == numpy.uint8 else 32000
    values = numpy.linspace(-top if numpy.dtype(dtype).kind in "if" else 0, top, count)
    shape = SHAPE if components == 1 else SHAPE + (components,)
    return (values if dtype == numpy.float32 else numpy.rint(values)).astype(dtype).reshape(shape)


def source_of(array, direction=OBLIQUE, world="RAS"):
    source = volume(array, origin=(-90.5, 12.25, -300.75), spacing=(0.7, 1.1, 2.5),
                    direction=direction.ravel())
    name_world(source, world)
    return source


def name_world(source, world):
    if world:
        word = vtkStringArray()
        word.SetName("WorldAxes")
        word.InsertNextValue(world)
        output(source).GetFieldData().AddArray(word)
        source.MarkModified(source.SMProxy)
        source.UpdatePipeline()


def affine_of(image):
    matrix = image.GetIndexToPhysicalMatrix()
    return numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])


def assert_places(affine, right, case):
    for corner in numpy.ndindex(2, 2, 2):
        index = numpy.append(numpy.array(corner) * (numpy.array(SHAPE[::-1]) - 1), 1.0)
        error = numpy.linalg.norm((affine @ index - right @ index)[:3])
        assert error <= 1e-3, (case, corner, error)


def header_of(name):
    """Fields and numbers of a MetaImage or NRRD file, read here from its bytes."""
    with open(name, "rb") as file:
        contents = file.read()
    is_nrrd = contents.startswith(b"NRRD")
    mark = b"\n\n" if is_nrrd else b"ElementDataFile = LOCAL\n"
    end = contents.index(mark) + len(mark)
    lines = contents[:end].decode().splitlines()
    parts = (line.split(":" if is_nrrd else "=", 1) for line in lines if not line.startswith("#"))
    return {part[0].strip(): part[1].strip() for part in parts if len(part) == 2}, contents[end:]


def converted(name):
    """What ITK reads in a file, as nibabel reads it from the NIfTI file that ITK makes of it."""
    made = scratch("converted.nii")
    subprocess.run([os.environ["BRAINSHIFT_CONVERT_IMAGE"], "3", name, made], check=True,
                   stdout=subprocess.DEVNULL)
    return nibabel.load(made)


def test_nibabel_finds_the_same_voxels_at_the_same_places():
    for kind, direction in GRIDS.items():
        for dtype in TYPES:
            array = numbers(dtype)
            source = source_of(array, direction)
            for ending in (".nii", ".nii.gz"):
                case = (kind, dtype, ending)
                name = scratch("volume" + ending)
                brainshift.save_volume(source, name)
                found = nibabel.load(name)
                assert found.header["sform_code"] == 1 and found.header["qform_code"] == 1
                assert found.get_data_dtype() == dtype, case
                for affine in (found.get_sform(), found.get_qform()):
                    assert_places(affine, affine_of(output(source)), case)
                assert (numpy.asarray(found.dataobj) == array.transpose()).all(), case


def test_itk_finds_the_same_voxels_at_the_same_places():
    for kind, direction in GRIDS.items():
        for dtype in TYPES:
            array = numbers(dtype)
            source = source_of(array, direction)
            for ending in (".mha", ".mhd", ".nrrd"):
                case = (kind, dtype, ending)
                name = scratch("volume" + ending)
                brainshift.save_volume(source, name)
                found = converted(name)
                assert_places(found.affine, affine_of(output(source)), case)
                assert (numpy.asarray(found.dataobj) == array.transpose()).all(), case


def test_text_headers_name_the_type_and_the_axes():
    names = {numpy.uint8: ("MET_UCHAR", "uint8"), numpy.int16: ("MET_SHORT", "int16"),
             numpy.uint16: ("MET_USHORT", "uint16"), numpy.float32: ("MET_FLOAT", "float"),
             numpy.int32: ("MET_INT", "int32"), numpy.float64: ("MET_DOUBLE", "double")}
    for dtype, (of_mha, of_nrrd) in names.items():
        array = numbers(dtype)
        source = source_of(array)
        for ending in (".mha", ".nrrd"):
            name = scratch("named" + ending)
            brainshift.save_volume(source, name)
            header, data = header_of(name)
            assert header["ElementType" if ending == ".mha" else "type"] == (
                of_mha if ending == ".mha" else of_nrrd)
            assert (numpy.frombuffer(data, dtype).reshape(SHAPE) == array).all(), (dtype, ending)
        assert header["space"] == "left-posterior-superior"
        assert header["space origin"] == "(90.5,-12.25,-300.75)"


def test_our_reader_finds_the_same_image():
    for kind, direction in GRIDS.items():
        for dtype in TYPES:
            source = source_of(numbers(dtype), direction)
            name = scratch("again.nii.gz")
            brainshift.save_volume(source, name)
            reader = NIFTIVolumeReader(FileName=name)
            found, right = output(reader), output(source)
            assert voxels(reader).dtype == dtype
            assert found.GetFieldData().GetAbstractArray("WorldAxes").GetValue(0) == "RAS"
            back = numpy.linalg.inv(affine_of(right)) @ affine_of(found)
            size = found.GetDimensions()
            z, y, x = numpy.meshgrid(*map(numpy.arange, reversed(size)), indexing="ij")
            index = (back @ numpy.stack([x, y, z, numpy.ones_like(x)]).reshape(4, -1))[:3]
            nearest = numpy.rint(index).astype(int)
            assert numpy.abs(index - nearest).max() < 1e-3, (kind, dtype)
            expected = voxels(source)[nearest[2], nearest[1], nearest[0]]
            assert (voxels(reader).ravel() == expected).all(), (kind, dtype)


def test_the_world_is_the_one_that_is_named():
    array = numbers(numpy.int16)
    for named, chosen in (("LPS", None), ("", "LPS"), ("RAS", "LPS")):
        source = source_of(array, world=named)
        for ending in (".nii", ".nrrd", ".mha"):
            name = scratch("world" + ending)
            with messages() as said:
                brainshift.save_volume(source, name, world=chosen)
            if named == "RAS":
                assert_says(said.text, "axes of the input are RAS, but World is LPS, which counts")
            else:
                assert not said.text, said.text
            found = nibabel.load(name) if ending == ".nii" else converted(name)
            assert_places(found.affine, LPS @ affine_of(output(source)), (named, chosen, ending))
    try:
        brainshift.save_volume(source, name, world="LAS")
    except ValueError as error:
        assert_says(str(error), "LAS", "RAS", "LPS")
    else:
        raise AssertionError("LAS is no world of ours")


def test_sides_that_are_not_known_stay_not_known_and_voxels_stay_in_place():
    source = source_of(numbers(numpy.int16), world="")
    for ending in FORMATS:
        name = scratch("sides" + ending)
        with messages() as said:
            brainshift.save_volume(source, name)
        assert_says(said.text, "sides" + ending, NOT_KNOWN, "RAS", "Set World")
        found = nibabel.load(name) if ".nii" in ending else converted(name)
        assert_places(found.affine, affine_of(output(source)), ending)
        with open(name, "rb") as file:
            says = b"sides of the patient not known" in file.read()
        assert says or ending == ".nii.gz", ending
        reader = OpenDataFile(name)
        assert output(reader).GetFieldData().GetAbstractArray("WorldAxes") is None, ending
        assert numpy.allclose(output(reader).GetCenter(), output(source).GetCenter(), atol=1e-3)


def test_the_array_can_be_chosen():
    source = source_of(numbers(numpy.int16))
    other = numbers(numpy.uint8)[::-1].copy()
    array = numpy_to_vtk(other.ravel(), deep=True)
    array.SetName("Labels")
    output(source).GetPointData().AddArray(array)
    name = scratch("chosen.nii")
    brainshift.save_volume(source, name, array="Labels")
    assert (numpy.asarray(nibabel.load(name).dataobj) == other.transpose()).all()
    brainshift.save_volume(source, name)
    assert nibabel.load(name).get_data_dtype() == numpy.int16
    assert_fails(lambda: brainshift.save_volume(source, name, array="Mask"),
                 "no point array Mask", "Intensity, Labels")


def test_colours_and_components():
    for components in (2, 3, 4):
        for dtype in (numpy.uint8, numpy.float32):
            array = numbers(dtype, components)
            source = source_of(array)
            name = scratch("components.nii")
            brainshift.save_volume(source, name)
            found = numpy.asarray(nibabel.load(name).dataobj)
            if found.dtype.names:  # colours
                found = numpy.stack([found[name] for name in found.dtype.names], axis=-1)
            right = array.transpose(2, 1, 0, 3)
            assert (found.reshape(right.shape) == right).all(), (components, dtype)
            for ending in (".nrrd", ".mha"):
                brainshift.save_volume(source, scratch("components" + ending))
                header, data = header_of(scratch("components" + ending))
                assert (numpy.frombuffer(data, dtype).reshape(array.shape) == array).all()
                if ending == ".mha":
                    assert header["ElementNumberOfChannels"] == str(components)
                else:
                    assert header["sizes"] == f"{components} 6 5 4", header
                    again = NRRDVolumeReader(FileName=scratch("components.nrrd"))
                    again.UpdatePipeline()
                    assert len(again.TimestepValues or []) == 0, (components, dtype)
                    found = again.PointData["Intensity"].GetNumberOfComponents()
                    assert found == components, (found, components, dtype)


def test_three_real_components_open_again_as_a_volume():
    array = numbers(numpy.float32, 3)
    for world in ("RAS", ""):
        source = source_of(array, world=world)
        for ending in FORMATS:
            name = scratch("three" + ending)
            for save in (brainshift.save_volume, lambda proxy, path: SaveData(path, proxy=proxy)):
                save(source, name)
                again = OpenDataFile(name)
                assert voxels(again).size == array.size, (name, again.SMProxy.GetXMLName())
                assert again.PointData.keys() == ["Intensity"], (name, again.SMProxy.GetXMLName())
                assert_refused_as_transform(name)
        with open(scratch("three.mha"), "rb") as file:
            assert (b"sides of the patient not known" in file.read()) == (not world)


def assert_refused_as_transform(name):
    try:
        brainshift.read_transform(name)
    except (ValueError, OSError):
        return
    raise AssertionError(name + " is no transform")


def test_what_the_file_does_not_hold_is_said():
    series = numpy.stack([numbers(numpy.int16) + 100 * t for t in range(3)], axis=-1)
    image = nibabel.Nifti1Image(series, numpy.eye(4))
    image.header.set_xyzt_units("mm", "sec")
    image.header["pixdim"][4] = 2.5
    nibabel.save(image, scratch("times.nii"))
    reader = NIFTIVolumeReader(FileName=scratch("times.nii"))
    reader.UpdatePipeline(2.5)
    labels = nibabel.Nifti1Image(numpy.ones((4, 5, 6), numpy.uint8), numpy.eye(4))
    labels.header["intent_code"] = 1002
    nibabel.save(labels, scratch("labels.nii"))
    marked = NIFTIVolumeReader(FileName=scratch("labels.nii"))
    with open(scratch("named.seg.nrrd"), "wb") as file:
        file.write(b"NRRD0004\ntype: uchar\ndimension: 3\nspace: LPS\nsizes: 2 2 2\n"
                   b"space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"
                   b"encoding: raw\nSegment0_ID:=a\nSegment0_Name:=vein\n\n" + bytes(8))
    named = NRRDVolumeReader(FileName=scratch("named.seg.nrrd"))
    for ending in (*FORMATS, ".seg.nrrd"):
        is_nifti = ".nii" in ending
        for source, words in (
                (reader, "The input has 3 times; the file has one of them"),
                (marked, "" if is_nifti else "That its values are labels is left out"),
                (named, "The names and colours of 1 label are left out")):
            name = scratch("left_out" + ending)
            with messages() as said:
                brainshift.save_volume(source, name)
            assert_says(said.text, words)
            assert bool(said.text) == bool(words), said.text
            if is_nifti:
                intent = nibabel.load(name).header["intent_code"]
                assert intent == (0 if source is reader else 1002), (name, intent)


def test_what_numbers_mean_is_said_if_it_is_left_out():
    source = source_of(numbers(numpy.int16))
    unit, mark = vtkStringArray(), vtkUnsignedCharArray()
    unit.SetName("Unit")
    unit.InsertNextValue("mm2/s")
    mark.SetName("SmallIsBright")
    mark.InsertNextValue(1)
    for array in (unit, mark):
        output(source).GetFieldData().AddArray(array)
    source.MarkModified(source.SMProxy)
    for ending in FORMATS:
        with messages() as said:
            brainshift.save_volume(source, scratch("meaning" + ending))
        assert_says(said.text, "The unit of its values, mm2/s, is left out. That small values are "
                    "bright (MONOCHROME1) is left out; a DICOM series would say it")


def test_long_numbers_are_shortened_or_refused():
    array = numbers(numpy.int16).astype(numpy.int64)
    name = scratch("long.nii.gz")
    with messages() as said:
        brainshift.save_volume(source_of(array), name)
    assert_says(said.text, "long long", "4 bytes")
    found = nibabel.load(name)
    assert found.get_data_dtype() == numpy.int32
    assert (numpy.asarray(found.dataobj) == array.transpose()).all()
    array[0, 0, 0] = 2 ** 40
    assert_fails(lambda: brainshift.save_volume(source_of(array), name), "long long", "1.09951e+12")


def test_what_cannot_be_written_says_so_and_keeps_the_old_file():
    noise = numpy.random.default_rng(7).random((16, 16, 16)).astype(numpy.float32)
    for ending in FORMATS:
        name = scratch("kept_volume" + ending)
        brainshift.save_volume(source_of(noise), name)
        with open(name, "rb") as file:
            old = file.read()
        for limit in (100, len(old) - 1):
            with full_disk(limit):
                assert_fails(lambda: brainshift.save_volume(source_of(noise), name),
                             "kept_volume" + ending, "cannot be written: ")
            with open(name, "rb") as file:
                assert file.read() == old, (ending, limit)
    assert_nothing_left(name)
    assert_fails(lambda: brainshift.save_volume(source_of(noise), scratch("no_folder/a.nrrd")),
                 "no_folder/a.nrrd cannot be written: ", "No such file")
    assert_fails(lambda: brainshift.save_volume(source_of(noise), scratch("a.img")),
                 "a.img", ".nii.gz")


def test_save_data_of_the_window_has_the_formats():
    bent = FreeFormDeformation(Input=volume(ball()), Strokes=brainshift.soft(
        (16.0, 16.0, 16.0), (4, 3, 2), 14.0))
    name_world(bent.Input, "RAS")
    baked = BakeDeformation(Input=bent)
    baked.UpdatePipeline()
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetWriterFactory()
    offered = factory.GetSupportedFileTypes(baked.SMProxy, 0)
    assert_says(offered, "Volume (BrainShift)", "*.nii.gz", "*.nrrd", "*.mha", "*.mhd")
    right = voxels(baked)
    assert numpy.abs(right - ball()).max() > 20.0
    for ending in FORMATS:
        name = scratch("save_data_volume" + ending)
        SaveData(name, proxy=baked)
        if ".nii" in ending:
            found = numpy.asarray(nibabel.load(name).dataobj).transpose()
        else:
            found = numpy.frombuffer(header_of(name)[1], numpy.float32).reshape(right.shape)
        assert (found == right).all(), ending
    colours = source_of(numbers(numpy.uint8, 3))
    SaveData(scratch("save_data_colours.nii"), proxy=colours)
    assert nibabel.load(scratch("save_data_colours.nii")).get_data_dtype().names, "no field"
    field = DeformationField(Input=bent, Direction="Backward")
    field.UpdatePipeline()
    for ending in (".nii", ".nii.gz"):
        name = scratch("save_data_field" + ending)
        SaveData(name, proxy=field)
        assert nibabel.load(name).header["intent_code"] == 1006, "a field stays a field"


run_tests(globals())
