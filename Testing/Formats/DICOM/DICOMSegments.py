# SPDX-License-Identifier: BSD-3-Clause
# Proves that segmentations of DICOM lie where dcmqi's label maps lie, voxel for voxel, with names,
# colours and coded terms; that no segment hides another one; and that what cannot be read is named.
import gzip
import os

import fields_walk
import numpy
import pydicom
from brainshift_testing import assert_says, data, load_plugin, messages, output, run_tests
from dicom_testing import (AXIAL, CORONAL, OBLIQUE, affine_of, assert_placed, folder, numbered,
                           read, scalars, write_slices)
from pydicom.sequence import Sequence
from segment_files import code, described, item, masks, segmentation

load_plugin()
from paraview.simple import DICOMVolumeReader  # noqa: E402 after the plugin


def written(image, name="segments"):
    path = os.path.join(folder(name), "segments.dcm")
    image.save_as(path, write_like_original=False)
    return path


def labels_of(reader):
    """Names, colours and terms of labels by their values."""
    fields = output(reader).GetFieldData()
    values, names, colors, terms = (
        fields.GetAbstractArray("Label" + word) for word in ("Values", "Names", "Colors", "Terms"))
    return {values.GetValue(i): (names.GetValue(i), colors.GetTuple3(i),
                                 terms.GetValue(i) if terms else "")
            for i in range(values.GetNumberOfTuples())}


def nrrd(name):
    """Voxels [slice, row, column] and the affine to RAS of a label map of dcmqi."""
    with open(data("dcmqi", name), "rb") as file:
        head, body = file.read().split(b"\n\n", 1)
    lines = dict(line.split(": ", 1) for line in head.decode().split("\n") if ": " in line)
    assert lines["space"] == "left-posterior-superior", lines
    affine = numpy.eye(4)
    for axis, step in enumerate(lines["space directions"].split()):
        affine[:3, axis] = numpy.fromstring(step.strip("()"), sep=",")
    affine[:3, 3] = numpy.fromstring(lines["space origin"].strip("()"), sep=",")
    sizes = [int(size) for size in lines["sizes"].split()]
    voxels = numpy.frombuffer(gzip.decompress(body), "<i2").reshape(sizes[::-1])
    return numpy.diag((-1.0, -1.0, 1.0, 1.0)) @ affine, voxels


def test_packed_livers_are_those_that_they_were_made_of():
    affine, voxels = nrrd("liver_spine_seg.nrrd")
    right = (voxels == 1).astype(numpy.uint8)
    for packing in ("rle", "j2k", "deflate"):
        reader, told = read(data("pydicom-data", f"liver_{packing}.dcm"))
        assert not told, told
        assert_placed(reader, affine, right, most=0)
        assert labels_of(reader) == {
            1: ("Liver", (221.0, 130.0, 101.0), "SRT^T-D0050^Tissue~SRT^T-62000^Liver~^^")}
        assert scalars(reader).dtype == numpy.uint8
        assert output(reader).GetFieldData().HasArray("IsLabelMap")


def test_segments_that_overlap_are_layers():
    path = data("dcmqi", "partial_overlaps.dcm")
    affine, first = nrrd("partial_overlaps-1.nrrd")
    reader, told = read(path)
    assert_says(told, "has 3 layers of segments; layer 1 is shown, without ORANGE, PURPLE",
                "Series chooses another one")
    assert_placed(reader, affine, first, most=0)
    names = labels_of(reader)
    assert {value: name for value, (name, *_) in names.items()} == {
        1: "GREEN", 4: "LIGHT_BLUE", 5: "DARK_BLUE"}
    assert names[1][1] == (128.0, 174.0, 128.0) and names[5][1] == (0.0, 151.0, 206.0)
    assert names[4][2] == ("SCT^49755003^Morphologically Altered Structure~"
                           "SCT^79654002^Edema~^^")
    series = list(reader.GetProperty("SeriesList"))[:3]
    assert [name.rsplit(", layer ", 1)[-1] for name in series] == [
        "1 of 3: GREEN, LIGHT_BLUE, DARK_BLUE", "2 of 3: ORANGE", "3 of 3: PURPLE"], series

    affine, second = nrrd("partial_overlaps-2.nrrd")
    chosen, _ = read(path, Series=series[1])
    assert_placed(chosen, affine, second, most=0)
    assert {value: name for value, (name, *_) in labels_of(chosen).items()} == {2: "ORANGE"}
    third, _ = read(path, Series=series[2])
    assert (scalars(third) == 3).sum() == 117 + 117 + 10509
    _, told = read(path, Series=series[2].replace("PURPLE", "PINK"))
    assert_says(told, "has no series", "has 3 layers")


def test_frames_of_bits_lie_where_their_groups_say():
    """Slices 0, 1 and 4 of 5 in any order: those between are empty."""
    bits = masks(3)
    for axes in (AXIAL, CORONAL, OBLIQUE):
        path = written(segmentation([(2, 4, bits[0]), (2, 0, bits[1]), (2, 1, bits[2])], axes=axes,
                                    numbers=[1, 2]))
        right = numpy.zeros((5, 5, 7))
        right[4], right[0], right[1] = 2 * bits
        reader, told = read(path)
        assert not told, told
        assert_placed(reader, affine_of(axes), right, most=0)
        assert list(labels_of(reader)) == [1, 2]


def test_each_segment_is_in_the_first_layer_where_it_hides_none():
    a, b, c = numpy.zeros((3, 5, 7), numpy.uint8)
    a[:2], b[1:3], c[3:] = 1, 1, 1
    path = written(segmentation([(1, 0, a), (2, 0, b), (3, 0, c), (3, 1, a)]))
    series = list(read(path)[0].GetProperty("SeriesList"))
    assert [name.split(", layer ")[1] for name in series] == [
        "1 of 2: Part 1, Part 3", "2 of 2: Part 2"]
    right = numpy.stack([a + 3 * c, 3 * a])
    assert_placed(read(path, Series=series[0])[0], affine_of(), right, most=0)
    right = numpy.stack([2 * b, 0 * b])
    assert_placed(read(path, Series=series[1])[0], affine_of(), right, most=0)
    # By the name of the whole the first one is shown, with a warning.
    _, told = read(path, Series=series[0].split(", layer ")[0])
    assert_says(told, "layer 1 is shown, without Part 2")


def test_names_have_64_letters_however_many_bytes_those_are():
    image = segmentation([(1, 0, masks(1)[0])], numbers=[1, 2, 3])
    image.SpecificCharacterSet = "ISO_IR 192"
    for segment, name in zip(image.SegmentSequence, ("ä" * 60, "€" * 64, "ö" * 70)):
        segment.SegmentLabel = name
    reader, _ = read(written(image))
    assert [name for name, *_ in labels_of(reader).values()] == ["ä" * 60, "€" * 64, "ö" * 64]


def test_other_types_and_bits():
    values = numpy.random.default_rng(5).integers(0, 201, (2, 5, 7)).astype(numpy.uint8)
    path = written(segmentation([(1, 0, values[0]), (2, 0, values[1])], "FRACTIONAL"))
    reader, told = read(path)
    assert_says(told, "has 2 layers of segments; layer 1 is shown, without Part 2")
    assert_placed(reader, affine_of(), values[:1] / 200)
    assert not output(reader).GetFieldData().HasArray("IsLabelMap")
    series = list(reader.GetProperty("SeriesList"))
    assert_placed(read(path, Series=series[1])[0], affine_of(), values[1:] / 200)

    for bits, most in ((8, 255), (16, 40000)):
        pixels = numpy.random.default_rng(6).integers(0, most + 1, (3, 5, 7))
        image = segmentation([(None, place, pixels[i]) for i, place in enumerate((0, 3, 1))],
                             "LABELMAP", bits=bits, numbers=[1, 17])
        right = numpy.stack([pixels[0], pixels[2], 0 * pixels[0], pixels[1]])
        for colours in ("MONOCHROME2", "PALETTE COLOR"):
            image.PhotometricInterpretation = colours
            reader, told = read(written(image))
            assert not told, told
            assert_placed(reader, affine_of(), right, most=0)
            assert list(labels_of(reader)) == [1, 17]

    bytes_of = masks(2)  # some write a byte for each bit
    reader, _ = read(written(segmentation([(1, 0, bytes_of[0]), (1, 1, bytes_of[1])], bits=8)))
    assert_placed(reader, affine_of(), bytes_of, most=0)
    big = segmentation([(700, 0, bytes_of[0])], numbers=[700])
    reader, _ = read(written(big))
    assert scalars(reader).dtype == numpy.uint16
    assert_placed(reader, affine_of(), 700 * bytes_of[:1].astype(int), most=0)


def test_the_check_for_overlaps_can_be_stopped():
    frames = [(segment, k, mask) for segment in (1, 2) for k, mask in enumerate(masks(3))]
    path = written(segmentation(frames))

    def read_stopped(stop_at):
        """How often progress comes before voxels are read, what the reader says, its points."""
        source = DICOMVolumeReader(FileName=path).GetClientSideObject()
        seen = []

        def count(*_):
            seen.append(source.GetProgress())
            if len(seen) == stop_at:
                source.SetAbortExecute(1)
        source.AddObserver("ProgressEvent", count)
        with messages() as told:
            source.Modified()
            source.UpdateInformation()
            before = len(seen)
            source.Update()
        return before, told.text, source.GetOutput().GetNumberOfPoints()

    count, told, points = read_stopped(None)
    assert count == 2 and not told and points == 3 * 35, (count, told, points)
    _, told, points = read_stopped(count)  # after the header, in the check
    assert_says(told, "was stopped. Nothing is shown")
    assert points == 0, points


def palette(image, colors, first=0, entries=None):
    """Gives an image the palette of `colors` [entry, red green blue]."""
    image.PhotometricInterpretation = "PALETTE COLOR"
    for i, name in enumerate(("Red", "Green", "Blue")):
        table = (257 * colors[:, i].astype("<u2")).tobytes()
        setattr(image, name + "PaletteColorLookupTableDescriptor",
                [len(colors) if entries is None else entries, first, 16])
        setattr(image, name + "PaletteColorLookupTableData", table)
        image[name + "PaletteColorLookupTableData"].VR = "OW"


def test_a_label_map_has_its_padding_where_no_frame_is():
    """As dcmqi writes what nobody classified."""
    pixels = numpy.random.default_rng(7).integers(0, 6, (2, 5, 7))
    image = segmentation([(None, 0, pixels[0]), (None, 2, pixels[1])], "LABELMAP",
                         numbers=[0, 1, 2])
    image.PixelPaddingValue = 5
    reader, told = read(written(image))
    assert_says(told, "marks voxels that are in no segment by 5 (PixelPaddingValue)",
                "slices without a frame have it, too")
    assert_placed(reader, affine_of(), numpy.stack([pixels[0], 0 * pixels[0] + 5, pixels[1]]),
                  most=0)
    image.PixelPaddingValue = 300
    refused(image, "has the PixelPaddingValue 300 among labels", "from 0 to 255")


def test_a_palette_colours_labels():
    """Those that have no colour of their own."""
    pixels = numpy.arange(35, dtype=numpy.uint8).reshape(5, 7) % 4
    for entries in (None, 9):
        image = segmentation([(None, 0, pixels), (None, 1, pixels)], "LABELMAP", numbers=[1, 2, 3])
        colors = numpy.array([[0, 0, 0], [250, 10, 20], [30, 240, 50], [60, 70, 230]])
        palette(image, colors, entries=entries)
        for segment in image.SegmentSequence[:2]:
            del segment.RecommendedDisplayCIELabValue
        reader, told = read(written(image))
        shown = [color for _, color, _ in labels_of(reader).values()]
        assert shown[2] not in ((60, 70, 230), (255, 255, 255)), shown
        if entries is None:
            assert not told, told
            assert shown[:2] == [(250, 10, 20), (30, 240, 50)], shown
        else:
            assert_says(told, "palette of 9 colours", "Its labels have no colours of it")
            assert shown[:2] == [(255, 255, 255)] * 2, shown


def test_a_deflated_file_is_read():
    bits = masks(2)
    image = segmentation([(1, 0, bits[0]), (1, 1, bits[1])])
    image.file_meta.TransferSyntaxUID = pydicom.uid.DeflatedExplicitVRLittleEndian
    reader, told = read(written(image))
    assert not told, told
    assert_placed(reader, affine_of(), bits, most=0)


def test_beside_images_the_images_are_shown_first():
    path = folder("beside")
    write_slices(path, numbered(2, 5, 7))
    bits = masks(9)
    segmentation([(1 + i, 0, frame) for i, frame in enumerate(bits)]).save_as(
        os.path.join(path, "0.dcm"), write_like_original=False)
    reader, told = read(path)
    assert not told, told
    series = list(reader.GetProperty("SeriesList"))
    assert_says(series[0], "CT, 7 x 5 x 2")
    assert_says(series[1], "SEG, 7 x 5 x 1")
    chosen, _ = read(path, Series=series[1])
    assert scalars(chosen).max() == 1
    assert len(chosen.GetProperty("SeriesList")) > 2


def refused(image, *words):
    reader, told = read(written(image))
    assert_says(told, *words)
    assert output(reader).GetNumberOfPoints() == 0, words


def changed(change, count=3, **options):
    bits = masks(count)
    image = segmentation([(1, i, frame) for i, frame in enumerate(bits)], **options)
    change(image)
    return image


def test_pictures_without_a_position_in_the_patient_are_refused():
    def no_positions(image):
        for group in image.PerFrameFunctionalGroupsSequence:
            del group.PlanePositionSequence

    def slide(image):
        no_positions(image)
        for group in image.PerFrameFunctionalGroupsSequence:
            group.PlanePositionSlideSequence = Sequence([item(XOffsetInSlideCoordinateSystem=1.0)])

    def tiled(image):
        no_positions(image)
        image.DimensionOrganizationType = "TILED_FULL"

    refused(changed(no_positions), "is a segmentation of a picture that has no position in the "
            "patient, such as an X-ray. Open it in the program that made it")
    for change in (slide, tiled):
        refused(changed(change), "has tiles of a slide under a microscope, which have no position "
                "in a patient. Open it in a viewer of slides")


def test_frames_on_no_grid_are_refused():
    def group(image, frame):
        return image.PerFrameFunctionalGroupsSequence[frame]

    def uneven(image):
        group(image, 2).PlanePositionSequence[0].ImagePositionPatient = [-11, 22, 39.2]

    def beside(image):
        group(image, 1).PlanePositionSequence[0].ImagePositionPatient = [-10.8, 22, 35.5]

    def turned(image):
        group(image, 1).PlaneOrientationSequence = Sequence([item(
            ImageOrientationPatient=[0.999, 0.0447, 0, -0.0447, 0.999, 0])])

    def finer(image):
        group(image, 1).PixelMeasuresSequence = Sequence([item(PixelSpacing=[0.9, 0.71])])

    def unplaced(image):
        del group(image, 1).PlanePositionSequence

    def twice(image):
        group(image, 2).PlanePositionSequence = group(image, 1).PlanePositionSequence

    def far(image):
        group(image, 2).PlanePositionSequence[0].ImagePositionPatient = [-11, 22, 1e7 + 33]

    refused(changed(uneven), "on no even grid: they are at least 2.5 mm apart",
            "of 0.1 that it may be")
    refused(changed(beside), "not above each other: frame 2 is 0.2 mm beside the normal")
    refused(changed(turned), "several orientations or pixel distances", "the corners of frame 2")
    refused(changed(finer), "several orientations or pixel distances", "the corners of frame 2")
    refused(changed(unplaced), "without a position in the patient", "frame 2")
    refused(changed(twice), "two frames of segment 1 at one position (frame 3 is the second)")
    refused(changed(far), "slices of 2.5 mm; it may have 65535")


def test_small_shifts_and_odd_steps_are_said():
    def shifted(image):
        image.PerFrameFunctionalGroupsSequence[1].PlanePositionSequence[
            0].ImagePositionPatient = [-10.96, 22, 35.6]

    _, told = read(written(changed(shifted)))
    assert_says(told, "up to 0.04 mm beside the normal", "from even slices, where they are shown")

    def wide(image):
        image.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[
            0].SpacingBetweenSlices = "1.25"

    reader, told = read(written(changed(wide)))
    assert_says(told, "at least 2.5 mm apart and slices of 1.25 mm", "those between have no frame")
    assert output(reader).GetDimensions() == (7, 5, 5)

    def unsaid(image):
        del image.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0].SpacingBetweenSlices
        del image.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0].SliceThickness

    reader, told = read(written(changed(unsaid)))
    assert not told and output(reader).GetDimensions() == (7, 5, 3)
    _, told = read(written(changed(unsaid, 1)))
    assert_says(told, "has one slice and neither SpacingBetweenSlices nor SliceThickness")


def test_segments_that_do_not_fit_are_refused():
    def without(image):
        image.SegmentSequence = Sequence(list(image.SegmentSequence)[:0])

    def twice(image):
        image.SegmentSequence = Sequence(list(image.SegmentSequence) * 2)

    def unnumbered(image):
        del image.SegmentSequence[0].SegmentNumber

    def unreferenced(image):
        del image.PerFrameFunctionalGroupsSequence[1].SegmentIdentificationSequence

    def unknown(image):
        image.SegmentationType = "SURFACE"

    def part(image):
        image.InConcatenationNumber = 2
        image.ConcatenationUID = "1.2.3"

    def short(image):
        image.PixelData = image.PixelData[:12]

    def many(image):
        image.NumberOfFrames = 5

    def wide(image):
        image.Rows = image.Columns = 65535

    def padded(image):
        image.BitsAllocated, image.BitsStored, image.HighBit = 16, 12, 11

    refused(changed(without), "has a frame of segment 1 (ReferencedSegmentNumber of frame 1)",
            "none of the 0 that its SegmentSequence describes")
    refused(changed(twice), "two segments with the number 1 (SegmentNumber)")
    refused(changed(unnumbered), "segment without a number (SegmentNumber)")
    refused(changed(unreferenced), "has a frame of segment 0", "of frame 2")
    refused(changed(unknown), "the SegmentationType 'SURFACE'", "BINARY, FRACTIONAL or LABELMAP")
    refused(changed(part), "is part 2 of a segmentation", "Join them")
    refused(changed(short), "has 12 bytes of pixel data", "3 frames need 14")
    refused(changed(many), "announces 5 frames (NumberOfFrames) and describes 3")
    refused(changed(wide), "frames of 65535 x 65535 pixels", "8192 x 8192")
    refused(changed(padded), "pixels of 16 bits, of which 12 are stored", "BINARY has 1 or 8")


def test_numbers_that_do_not_fit_are_refused():
    pixels = numpy.full((1, 5, 7), 201, numpy.uint8)
    refused(segmentation([(1, 0, pixels[0])], "FRACTIONAL"), "has the number 201",
            "it may have 200")
    refused(segmentation([(1, 0, pixels[0])], bits=8), "has the number 201", "it may have 1")
    image = segmentation([(1, 0, pixels[0])], "FRACTIONAL")
    image.MaximumFractionalValue = 0
    refused(image, "fractions up to 0 (MaximumFractionalValue)", "from 1 to 255")


def written_walk(image):
    path = os.path.join(folder("segments-walk"), "walk.dcm")
    image.save_as(path, write_like_original=False)
    return path


def by(*changes, **options):
    """Writers of a good file and of changed ones."""
    return [lambda change=change: written_walk(changed(change, **options))
            for change in (lambda image: None, *changes)]


def of_segment(**values):
    def change(image):
        for name, value in values.items():
            setattr(image.SegmentSequence[0], name, value)
    return change


def renumbered(image):
    image.SegmentSequence[0].SegmentNumber = 2
    for group in image.PerFrameFunctionalGroupsSequence:
        group.SegmentIdentificationSequence[0].ReferencedSegmentNumber = 2


def two_segments(image):
    image.SegmentSequence.append(described(2))


def second(image):
    two_segments(image)
    image.PerFrameFunctionalGroupsSequence[1].SegmentIdentificationSequence = Sequence([item(
        ReferencedSegmentNumber=2)])


def modified(image):
    image.SegmentSequence[0].SegmentedPropertyTypeCodeSequence[
        0].SegmentedPropertyTypeModifierCodeSequence = code("SCT", "7771000", "Left")


def in_region(image):
    image.SegmentSequence[0].AnatomicRegionSequence = code("SCT", "69930009", "Pancreas")


def at_left_of_region(image):
    in_region(image)
    image.SegmentSequence[0].AnatomicRegionSequence[0].AnatomicRegionModifierSequence = code(
        "SCT", "7771000", "Left")


def put(**values):
    def change(image):
        for name, value in values.items():
            setattr(image, name, value)
    return change


def test_each_attribute_of_segments_does_what_the_list_says():
    names = by(of_segment(SegmentLabel="Other"))
    frames = by(lambda image: (second(image)))
    most = [lambda most=most: written_walk(changed(
        put(MaximumFractionalValue=most), kind="FRACTIONAL")) for most in (200, 100)]
    changes = {
        "SegmentSequence": by(two_segments), "SegmentNumber": by(renumbered),
        "SegmentLabel": names,
        "RecommendedDisplayCIELabValue": by(of_segment(
            RecommendedDisplayCIELabValue=[43803, 26565, 37722])),
        "SegmentedPropertyCategoryCodeSequence": by(of_segment(
            SegmentedPropertyCategoryCodeSequence=code("SCT", "1", "Other"))),
        "SegmentedPropertyTypeCodeSequence": by(of_segment(
            SegmentedPropertyTypeCodeSequence=code("SCT", "1", "Other"))),
        "SegmentedPropertyTypeModifierCodeSequence": by(modified),
        "AnatomicRegionSequence": by(in_region),
        "AnatomicRegionModifierSequence": by(at_left_of_region),
        "SegmentIdentificationSequence": frames, "ReferencedSegmentNumber": frames,
        "MaximumFractionalValue": most,
        "SegmentsOverlap": by(put(SegmentsOverlap="YES")),
        "SegmentationFractionalType": by(put(SegmentationFractionalType="OCCUPANCY")),
        "ReferencedSeriesSequence": by(put(ReferencedSeriesSequence=[item(
            SeriesInstanceUID="1.2.3")])),
        "DerivationImageSequence": by(lambda image: put(DerivationImageSequence=[item()])(
            image.PerFrameFunctionalGroupsSequence[0]))}
    for name, value in (("SegmentAlgorithmType", "AUTOMATIC"), ("SegmentAlgorithmName", "other"),
                        ("SegmentDescription", "other"), ("TrackingUID", "1.2.3")):
        changes[name] = by(of_segment(**{name: value}))
    fields_walk.walk("DICOM", "Attributes of segments", changes,
                     lambda write: fields_walk.outcome_of("DICOMVolumeReader", write()))


def test_names_are_read_in_their_characters():
    for characters, name in (("ISO_IR 100", "Läsion"), ("ISO_IR 192", "腫瘍")):
        image = changed(lambda made: None)
        image.SpecificCharacterSet = characters
        image.SegmentSequence[0].SegmentLabel = name
        reader, _ = read(written(image))
        assert labels_of(reader)[1][0] == name, labels_of(reader)


run_tests(globals())
