# SPDX-License-Identifier: BSD-3-Clause
# Proves with readers of others that volumes of every format lie where their files say: 48 orders of
# axes and a tilted scan, judged by ITK (through elastix) and nibabel, and one head in all formats.
import gzip
import os
import subprocess

import nibabel
import numpy
import volume_files
from brainshift_testing import (
    assert_says, data, field, load_plugin, messages, output, run_tests, scratch, voxels)
from volume_places import (
    LARGEST_MM, assert_has_ras_axes, assert_same_head, assert_same_places, matrix, opened, places)
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
from paraview import simple  # noqa: E402 after the plugin

TRANSFORMIX = os.environ["BRAINSHIFT_TRANSFORMIX"]
SHAPE = (4, 5, 3)
HEAD = data("seg3d-utah", "seg3d_mr_t1.nii.gz")


def by_itk(name, image):
    """The file as ITK reads it, resampled onto the grid of an image by linear interpolation. A
    place that is wrong by 0.001 mm shows in the numbers."""
    lps = numpy.diag([-1.0, -1.0, 1.0, 1.0]) @ matrix(image)
    spacing = numpy.linalg.norm(lps[:3, :3], axis=0)
    parameters = volume_files.write(scratch("identity.txt"), "\n".join((
        '(Transform "TranslationTransform")', "(NumberOfParameters 3)",
        "(TransformParameters 0 0 0)", '(InitialTransformParametersFileName "NoInitialTransform")',
        '(HowToCombineTransforms "Compose")', "(FixedImageDimension 3)", "(MovingImageDimension 3)",
        '(FixedInternalImagePixelType "float")', '(MovingInternalImagePixelType "float")',
        "(Size " + " ".join(map(str, image.GetDimensions())) + ")", "(Index 0 0 0)",
        "(Spacing " + volume_files.words(spacing) + ")",
        "(Origin " + volume_files.words(lps[:3, 3]) + ")",
        "(Direction " + volume_files.words((lps[:3, :3] / spacing).T) + ")",
        '(UseDirectionCosines "true")', '(ResampleInterpolator "FinalLinearInterpolator")',
        '(Resampler "DefaultResampler")', "(DefaultPixelValue -1000)",
        '(ResultImageFormat "nii")', '(ResultImagePixelType "float")', "")).encode())
    folder = scratch("by_itk")
    os.makedirs(folder, exist_ok=True)
    run = subprocess.run([TRANSFORMIX, "-in", name, "-tp", parameters, "-out", folder],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert run.returncode == 0, run.stdout[-2000:]
    return nibabel.load(os.path.join(folder, "result.nii"))


def assert_itk_agrees(name, proxy_name):
    """ITK finds at the places of our voxels the numbers that we show there."""
    source = opened(name, proxy_name)
    judged = by_itk(name, output(source))
    assert numpy.abs(judged.affine - matrix(output(source))).max() < 1e-4, judged.affine
    difference = numpy.abs(numpy.asarray(judged.dataobj).T - voxels(source)).max()
    # From one voxel to the next the numbers differ by 1 or more, and voxels lie 2.25 mm apart.
    assert difference < LARGEST_MM / 2.25, (name, difference)
    assert_has_ras_axes(source, name)
    simple.Delete(source)
    return difference


def test_nrrd_and_meta_image_lie_where_itk_puts_them():
    for ending, make, proxy_name in (("nrrd", volume_files.nrrd, "NRRDVolumeReader"),
                                     ("mha", volume_files.meta_image, "MHAVolumeReader")):
        largest = 0.0
        for affine in volume_files.affines():
            name = volume_files.write(
                scratch(f"turned.{ending}"), make(volume_files.numbered(SHAPE), affine))
            largest = max(largest, assert_itk_agrees(name, proxy_name))
        print(f"{ending}: largest difference of numbers that differ by 1 a voxel: {largest}")


def test_freesurfer_lies_where_nibabel_puts_it():
    farthest = 0.0
    for i, affine in enumerate(volume_files.affines()):
        name = scratch(f"turned.{'mgz' if i % 2 else 'mgh'}")
        nibabel.MGHImage(volume_files.numbered(SHAPE), affine).to_filename(name)
        farthest = max(farthest, assert_same_places(name, "MGHVolumeReader", nibabel.load(name)))
    print(f"FreeSurfer: farthest corner {farthest} mm")


def test_spaces_of_nrrd():
    affine = volume_files.tilted(next(volume_files.turns()))
    expected = places(volume_files.numbered(SHAPE), affine)
    for space in ("right-anterior-superior", "left-anterior-superior", "left-posterior-superior",
                  "scanner-xyz"):
        name = volume_files.write(scratch("space.nrrd"), volume_files.nrrd(
            volume_files.numbered(SHAPE), affine, space))
        source = opened(name, "NRRDVolumeReader")
        found = places(voxels(source).transpose(2, 1, 0), matrix(output(source)))
        assert numpy.abs(found - expected).max() < LARGEST_MM, space
        known = output(source).GetFieldData().GetAbstractArray("WorldAxes") is not None
        assert known == (space != "scanner-xyz"), space


def head_in(kind):
    """The test's head in another format, as float32, its slices in another order."""
    image = nibabel.load(HEAD)
    voxels_of_head = numpy.asarray(image.dataobj).astype(numpy.float32)
    flipped = voxels_of_head.transpose(2, 0, 1)[::-1]
    order = numpy.zeros((4, 4))
    order[0, 1] = order[1, 2] = order[3, 3] = 1.0
    order[2, 0], order[2, 3] = -1.0, voxels_of_head.shape[2] - 1.0
    affine = image.affine @ order
    name = scratch(f"head.{kind}")
    if kind == "mgz":
        nibabel.MGHImage(flipped, affine).to_filename(name)
        return name
    make = volume_files.nrrd if kind == "nrrd" else volume_files.meta_image
    return volume_files.write(name, make(flipped, affine))


def bytes_read():
    """How many bytes this process has read of files so far."""
    with open("/proc/self/io", encoding="ascii") as counted:
        return int(counted.readline().split()[1])


def part_of(name, proxy_name, extent):
    """The voxels of an extent, and how many bytes were read for them."""
    proxy = opened(name, proxy_name)
    reader = proxy.GetClientSideObject()
    reader.UpdateInformation()
    before = bytes_read()
    reader.UpdateExtent(extent)
    read = bytes_read() - before
    image = reader.GetOutputDataObject(0)
    assert list(image.GetExtent()) == extent, image.GetExtent()
    simple.Delete(proxy)
    sides = numpy.subtract(extent[1::2], extent[::2]) + 1
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(*sides[::-1], -1), read


def test_a_part_of_a_raw_file_is_read_without_the_others():
    """For all ways in which axes may be turned: MPI ranks read their parts so."""
    numbers = volume_files.numbered((33, 40, 25))
    affines = volume_files.affines()
    for proxy_name, ending, make in (("NRRDVolumeReader", "nrrd", volume_files.nrrd),
                                     ("MHAVolumeReader", "mha", volume_files.meta_image),
                                     ("MGHVolumeReader", "mgh", None)):
        for affine in affines[::3]:
            name = scratch(f"part.{ending}")
            if make:
                volume_files.write(name, make(numbers, affine))
            else:
                nibabel.MGHImage(numbers, affine).to_filename(name)
            source = opened(name, proxy_name)
            whole = voxels(source)
            simple.Delete(source)
            part, read = part_of(name, proxy_name, [3, 9, 4, 20, 2, 11])
            assert (part[..., 0] == whole[2:12, 4:21, 3:10]).all(), (proxy_name, affine)
            assert read <= part.nbytes + 1024, (proxy_name, read, part.nbytes)


PACKED = (("NRRDVolumeReader", "nrrd"), ("MHAVolumeReader", "mha"), ("MGHVolumeReader", "mgz"))
BOXES = ([0, 24, 0, 39, 0, 30], [0, 24, 0, 39, 5, 11], [0, 24, 7, 20, 5, 5], [3, 9, 4, 20, 2, 11],
         [24, 24, 39, 39, 30, 30])


def packed_file(ending, numbers):
    """A file of gzip or zlib whose voxels lie as they are shown."""
    name = scratch(f"packed.{ending}")
    if ending == "mgz":
        nibabel.MGHImage(numbers, numpy.eye(4)).to_filename(name)
        return name
    made = (volume_files.nrrd(numbers, numpy.eye(4), encoding="gzip") if ending == "nrrd" else
            volume_files.meta_image(numbers, numpy.eye(4), packed=True))
    return volume_files.write(name, made)


def test_a_part_of_a_packed_file_is_unpacked_without_what_follows():
    """What lies after the part is not looked at; what lies before is unpacked and dropped."""
    numbers = volume_files.numbered((25, 40, 31))
    for proxy_name, ending in PACKED:
        name = packed_file(ending, numbers)
        for box in BOXES:
            part, _ = part_of(name, proxy_name, box)
            x, y, z = (slice(box[2 * i], box[2 * i + 1] + 1) for i in range(3))
            assert (part[..., 0] == numbers[x, y, z].T).all(), (proxy_name, box)
        with open(name, "r+b") as file:
            file.truncate(os.path.getsize(name) * 6 // 10)
        part, _ = part_of(name, proxy_name, BOXES[1])
        assert (part[..., 0] == numbers[:, :, 5:12].T).all(), proxy_name
        for box in (BOXES[0], BOXES[-1]):
            with messages() as said:
                opened(name, proxy_name).GetClientSideObject().UpdateExtent(box)
            assert_says(said.text, "has packed numbers that are damaged or too few")


def test_a_part_of_a_series():
    """Each rank keeps its part of all times where these are packed, or NIfTI."""
    numbers = numpy.random.default_rng(4).integers(0, 60000, (13, 9, 8, 4)).astype("uint16")
    colours = numpy.zeros((13, 9, 8), [(name, "u1") for name in "RGB"])
    for i, name in enumerate("RGB"):
        colours[name] = numbers[..., i] >> 8
    for affine in volume_files.affines()[::5]:
        for what, values, times in (("series", numbers, 4), ("colours", colours, 1),
                                    ("vectors", numbers[:, :, :, None, :3], 1)):
            for ending in ("nii", "nii.gz"):
                name = scratch(f"part of {what}.{ending}")
                nibabel.Nifti1Image(values, affine).to_filename(name)
                check_parts_of_times(name, "NIFTIVolumeReader", times, keeps=True)
        for ending in ("mgh", "mgz"):
            name = scratch(f"part.{ending}")
            nibabel.MGHImage(numbers.astype("float32"), affine).to_filename(name)
            check_parts_of_times(name, "MGHVolumeReader", 4, keeps=ending == "mgz")
    for times_last in (True, False):
        for encoding in ("raw", "gzip", "text"):
            name = series_of_nrrd(numbers, times_last, encoding)
            check_parts_of_times(name, "NRRDVolumeReader", 4, encoding != "raw" or not times_last)


def series_of_nrrd(numbers, times_last, encoding):
    """A file whose times are after the axes of space, or before them, side by side."""
    axes = [0, 1, 2, 3] if times_last else [3, 0, 1, 2]  # the fastest first
    space = ["(1,0,0)", "(0,1,0)", "(0,0,1)"]
    header = "\n".join((
        "NRRD0005", "type: ushort", "dimension: 4",
        "sizes: " + " ".join(str(numbers.shape[axis]) for axis in axes), "endian: little",
        f"encoding: {encoding}", "space: right-anterior-superior", "space origin: (0,0,0)",
        "space directions: " + " ".join((space + ["none"])[axis] for axis in axes),
        "kinds: " + " ".join((["domain"] * 3 + ["time"])[axis] for axis in axes), "", ""))
    data = numbers.transpose(axes[::-1])
    data = (" ".join(map(str, data.ravel())).encode() if encoding == "text" else
            gzip.compress(data.tobytes()) if encoding == "gzip" else data.tobytes())
    return volume_files.write(scratch("series.nrrd"), header.encode() + data)


def check_parts_of_times(name, proxy_name, times, keeps):
    """`keeps`: a later time of the same part reads nothing."""
    whole, part = (opened(name, proxy_name) for _ in range(2))
    reader = part.GetClientSideObject()
    reader.UpdateInformation()
    for box in ([3, 7, 2, 5, 1, 6], [0, 3, 0, 3, 0, 3], [5, 5, 6, 6, 5, 5]):
        for i, time in enumerate(list(part.TimestepValues)[:times] or [0.0]):
            whole.UpdatePipeline(time)
            before = bytes_read()
            reader.UpdateTimeStep(time, -1, 1, 0, box)
            read = bytes_read() - before
            assert i == 0 or not keeps or read < 1000, (name, box, time, read)
            expected, found = (of.GetOutputDataObject(0)
                               for of in (whole.GetClientSideObject(), reader))
            x, y, z = (slice(box[2 * i], box[2 * i + 1] + 1) for i in range(3))
            sides = expected.GetDimensions()
            expected = vtk_to_numpy(expected.GetPointData().GetScalars())
            expected = expected.reshape(*sides[::-1], -1)[z, y, x]
            found = vtk_to_numpy(found.GetPointData().GetScalars()).reshape(expected.shape)
            assert numpy.array_equal(found, expected), (name, box, time)
    assert times == 1 or len(part.TimestepValues) == times, (name, part.TimestepValues)
    for source in (whole, part):
        simple.Delete(source)


def test_a_part_of_tuples_and_of_a_later_time():
    tuples = numpy.arange(2 * 7 * 9 * 6 * 3, dtype="uint16").reshape(3, 6, 9, 7, 2)
    header = "\n".join((
        "NRRD0005", "type: ushort", "dimension: 5", "sizes: 2 7 9 6 3", "endian: little",
        "encoding: raw", "space: right-anterior-superior", "space origin: (0,0,0)",
        "space directions: none (1,0,0) (0,1,0) (0,0,1) none",
        "kinds: vector domain domain domain time", "", ""))
    name = volume_files.write(scratch("tuples.nrrd"), header.encode() + tuples.tobytes())
    part, read = part_of(name, "NRRDVolumeReader", [1, 4, 0, 8, 2, 4])
    assert (part == tuples[0, 2:5, :, 1:5]).all()
    assert read <= part.nbytes + 1024, read
    later = opened(name, "NRRDVolumeReader")
    later.UpdatePipeline(2.0)
    shown = vtk_to_numpy(output(later).GetPointData().GetScalars())
    assert (shown.reshape(6, 9, 7, 2) == tuples[2]).all()


def test_the_same_head_in_all_formats():
    first = opened(HEAD, "NIFTIVolumeReader")
    for kind, proxy_name in (("nrrd", "NRRDVolumeReader"), ("mha", "MHAVolumeReader"),
                             ("mgz", "MGHVolumeReader")):
        source = opened(head_in(kind), proxy_name)
        assert_same_head(source, first)
        simple.Delete(source)
        os.remove(scratch(f"head.{kind}"))


def test_a_field_opens_as_a_field():
    import brainshift
    bent = simple.FreeFormDeformation(Input=opened(HEAD, "NIFTIVolumeReader"),
                                      Strokes=brainshift.soft((-300, 20, 480), (5, 0, 0), 30.0))
    for ending in ("mha", "nrrd"):
        name = scratch(f"a_field.{ending}")
        brainshift.save_field(bent, name)
        opened(name, "DisplacementFieldReader")
        os.remove(name)


def test_segments_of_slicer():
    """Names, colours and terms as Slicer writes them, kept by Free-Form Deformation."""
    labels = numpy.zeros(SHAPE, "uint8")
    labels[1:3, 1:4, 1] = 7
    more = ["Segment0_ID:=Segment_1", "Segment0_Name:=tumour", "Segment0_LabelValue:=7",
            "Segment0_Color:=1 0.5 0", "Segment0_Layer:=0", "Segment0_Extent:=1 2 1 3 1 1",
            "Segment0_Tags:=Segmentation.Status:inprogress|TerminologyEntry:A list~SCT^1^Tissue~"
            "SCT^2^Mass~^^~Regions~^^~^^|",
            "Segment1_ID:=Segment_2", "Segment1_LabelValue:=9", "Segment1_Layer:=0",
            "Segment1_Tags:=TerminologyEntry:A list~SCT^1^Tissue~SCT^3^Skin~SCT^4^Left~Regions~"
            "SCT^5^Head~^^|"]
    name = volume_files.write(scratch("made.seg.nrrd"), volume_files.nrrd(
        labels, next(volume_files.turns()), more=more))
    source = opened(name, "NRRDVolumeReader")
    bent = simple.FreeFormDeformation(Input=source)
    for proxy in (source, bent):
        assert field(proxy, "LabelValues").tolist() == [7, 9]
        assert field(proxy, "LabelColors").tolist() == [[255, 128, 0], [255, 255, 255]]
        names = output(proxy).GetFieldData().GetAbstractArray("LabelNames")
        assert [names.GetValue(i) for i in range(2)] == ["tumour", "Segment_2"]
        terms = output(proxy).GetFieldData().GetAbstractArray("LabelTerms")
        assert [terms.GetValue(i) for i in range(2)] == [
            "SCT^1^Tissue~SCT^2^Mass~^^", "SCT^1^Tissue~SCT^3^Skin~SCT^4^Left~SCT^5^Head~^^"]
    assert set(numpy.unique(voxels(source))) == {0, 7}


VESSEL = "Gef\u00e4\u00df"
SEGMENTS = ({"ID": "a", "Name": "skull", "LabelValue": 1, "Layer": 0},
            {"ID": "b", "Name": VESSEL, "LabelValue": 1, "Layer": 2},
            {"ID": "c", "LabelValue": 4, "Layer": 2})


def overlapping():
    """A file of three layers, the second without a segment, and its layers."""
    layers = numpy.zeros((3, *SHAPE), "uint8")
    layers[0, 1:, :, :] = 1
    layers[2, :, 2:, :] = 1
    layers[2, :, :, 0] = 4
    return volume_files.write(scratch("layers.seg.nrrd"), volume_files.segmentation(
        layers, next(volume_files.turns()), SEGMENTS)), layers


def shown_layer(source):
    return voxels(source).transpose(2, 1, 0)


def test_layers_of_slicer():
    """Nobody has chosen: the first is shown, and a warning names what is left out."""
    name, layers = overlapping()
    with messages() as said:
        source = opened(name, "NRRDVolumeReader")
        assert (shown_layer(source) == layers[0]).all(), said.text
    assert "3 layers of segments" in said.text and f"without {VESSEL}, c" in said.text, said.text
    assert field(source, "LabelValues").tolist() == [1]
    offered = ["1: skull", "2: no segment", f"3: {VESSEL}, c"]
    assert list(source.GetProperty("LayerList")) == offered
    assert list(source.GetProperty("Layer").GetAvailable()) == offered


def test_names_of_a_layer_fit_a_list():
    """Of many names the first five, cut between letters."""
    long = 70 * "\u00e4"
    segments = [{"ID": "a", "Name": "a", "Layer": 0}] + [
        {"ID": f"b{i}", "Name": long, "LabelValue": i, "Layer": 1} for i in range(1, 8)]
    name = volume_files.write(scratch("long.seg.nrrd"), volume_files.segmentation(
        numpy.zeros((2, *SHAPE), "uint8"), next(volume_files.turns()), segments))
    source = opened(name, "NRRDVolumeReader")
    shown = source.GetProperty("LayerList")[1]
    assert shown == f"2: {long}, {29 * chr(0xe4)}... and others", shown


def test_a_chosen_layer():
    """By its name in the list, or by its number; with its own labels, and without a warning."""
    name, layers = overlapping()
    source = simple.NRRDVolumeReader(FileName=name)  # ParaView asks for the layers, and is warned
    with messages() as said:
        source.Layer = f"3: {VESSEL}, c"
        assert (shown_layer(source) == layers[2]).all()
        assert field(source, "LabelValues").tolist() == [1, 4]
        names = output(source).GetFieldData().GetAbstractArray("LabelNames")
        assert [names.GetValue(i) for i in range(2)] == [VESSEL, "c"]
        for layer in ("1", "2", "3: renamed since", "1: skull"):
            source.Layer = layer
            assert (shown_layer(source) == layers[int(layer[0]) - 1]).all(), layer
        source.Layer = "2"
        assert output(source).GetFieldData().GetAbstractArray("LabelNames") is None
    assert said.text == "", said.text


def test_a_layer_that_is_none():
    """It is refused by name, and what was shown stays until another one is chosen."""
    name, layers = overlapping()
    source = simple.NRRDVolumeReader(FileName=name, Layer="3")
    source.UpdatePipeline()
    for layer in ("4", "0", "-1", "1.5", "skull"):
        with messages() as said:
            source.Layer = layer
            source.UpdatePipeline()
        assert f"has 3 layers of segments; Layer is '{layer}'" in said.text, said.text
    source.Layer = "1"
    assert (shown_layer(source) == layers[0]).all()


def test_a_volume_without_layers_ignores_the_layer():
    numbered = volume_files.numbered((3, 4, 5))
    name = volume_files.write(scratch("plain.nrrd"), volume_files.nrrd(
        numbered, next(volume_files.turns())))
    with messages() as said:
        source = simple.NRRDVolumeReader(FileName=name, Layer="9")
        assert sorted(voxels(source).ravel()) == list(range(1, 61))
    assert said.text == "", said.text
    assert len(source.GetProperty("LayerList")) == 0


run_tests(globals())
