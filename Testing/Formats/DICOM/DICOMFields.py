# SPDX-License-Identifier: BSD-3-Clause
# Proves that each attribute of DICOM does what the lists in README.md say of it: another value
# changes what is read or said, is refused by name, or changes nothing.
import os
import shutil

import fields_walk
import numpy
import pydicom
from brainshift_testing import load_plugin, run_tests, scratch
from dicom_testing import CORONAL, enhanced, numbered, plain_header, set_pixels, write_slices
from pydicom.sequence import Sequence

load_plugin()

BIG_ENDIAN = pydicom.uid.ExplicitVRBigEndian


def empty_folder():
    path = scratch("walk")
    shutil.rmtree(path, ignore_errors=True)
    os.makedirs(path)
    return path


def named_uid(image, text):
    """UIDs that are the same in each run, as fields_walk compares sentences."""
    image.SOPInstanceUID = image.file_meta.MediaStorageSOPInstanceUID = "1.2.3." + text


def slices(change=None, count=3, start=0, **options):
    """Writes some slices. change(image, index)."""
    def write():
        def named(image, index):
            named_uid(image, str(index))
            if change:
                change(image, index)
        return write_slices(empty_folder(), numbered(count, start=start), change=named, **options)
    return write


def times(change=None, count=2):
    """Writes `count` images at each of two positions. change(image, time)."""
    def write():
        path = empty_folder()
        for t in range(count):
            def named(image, index, t=t):
                named_uid(image, f"{t}.{index}")
                if change:
                    change(image, t)
            write_slices(path, numbered(2, start=1000 * t), change=named, start=1 + 100 * t)
        return path
    return write


def one(image):
    """Writes one file: what a function without arguments makes."""
    def write():
        path = empty_folder()
        made = image()
        named_uid(made, "7")
        made.save_as(os.path.join(path, "walk.dcm"), write_like_original=False)
        return path
    return write


def frames(change=None, moments=((1, 0.0),), voxels=None, **options):
    """Writes an enhanced file. change(image)."""
    def make():
        made = enhanced(numbered(3)[None] if voxels is None else voxels, moments, **options)
        if change:
            change(made)
        return made
    return one(make)


def nuclear(change=None):
    """Writes an old multi-frame file of nuclear medicine. change(image)."""
    def make():
        image = plain_header("1.2.840.10008.5.1.4.1.1.20")
        set_pixels(image, numbered(4))
        image.Modality, image.NumberOfFrames = "NM", 4
        image.PixelSpacing, image.SpacingBetweenSlices = [2, 2], "3"
        image.FrameIncrementPointer, image.SliceVector = 0x00540080, [1, 2, 3, 4]
        detector = pydicom.Dataset()
        detector.ImagePositionPatient = [-11, 22, 33]
        detector.ImageOrientationPatient = [1, 0, 0, 0, 1, 0]
        image.DetectorInformationSequence = Sequence([detector])
        if change:
            change(image)
        return image
    return one(make)


def put(**values):
    """A change that sets attributes of all images, or removes those that are None."""
    def change(image, _=None):
        for name, value in values.items():
            if value is None:
                delattr(image, name)
            else:
                setattr(image, name, value)
    return change


def raw(**values):
    """A change that writes text which pydicom would not."""
    def change(image, _=None):
        for name, value in values.items():
            tag = pydicom.datadict.tag_for_keyword(name)
            image[tag] = pydicom.dataelem.DataElement(tag, "LO", value)
    return change


def item(**values):
    """A data set."""
    made = pydicom.Dataset()
    put(**values)(made)
    return made


def both(*changes):
    def change(image, index=None):
        for each in changes:
            each(image, index)
    return change


def by_time(**values):
    """A change that gives the images of each time one of two values."""
    return lambda image, t: put(**{name: pair[t] for name, pair in values.items()})(image)


def in_frames(sequence, **values):
    """A change that gives each frame its own value: values are functions of the frame."""
    def change(image, _=None):
        for i, group in enumerate(image.PerFrameFunctionalGroupsSequence):
            if sequence not in group:
                setattr(group, sequence, Sequence([pydicom.Dataset()]))
            put(**{name: value(i) for name, value in values.items()})(group[sequence][0])
    return change


def shared(sequence, **values):
    """A change of a group that all frames share."""
    def change(image, _=None):
        group = image.SharedFunctionalGroupsSequence[0]
        if sequence not in group:
            setattr(group, sequence, Sequence([pydicom.Dataset()]))
        put(**values)(group[sequence][0])
    return change


def by(good, *changes, of=slices):
    """A good content, and changed ones."""
    return [of(good), *(of(both(good, change) if good else change) for change in changes)]


def plane():
    unplaced = put(ImagePositionPatient=None, ImageOrientationPatient=None)
    unmeasured = put(PixelSpacing=None)

    def located(image, i):
        put(ImagePositionPatient=[0, 0, i // 2], SliceLocation="4")(image)
    single = [slices(put(SliceThickness="3"), 1)]
    found = {
        "ImagePositionPatient": by(None, lambda image, i: put(
            ImagePositionPatient=[0, 0, i])(image), put(ImagePositionPatient=None)),
        "ImageOrientationPatient": by(None, put(ImageOrientationPatient=[
            str(number) for axis in CORONAL for number in axis]), put(ImageOrientationPatient=[
                2, 0, 0, 0, 2, 0]), put(ImageOrientationPatient=[1, 0, 0, .5, 1, 0])),
        "PixelSpacing": by(None, put(PixelSpacing=[3, 4]), put(PixelSpacing=None)),
        "ImagerPixelSpacing": by(unmeasured, put(ImagerPixelSpacing=[3, 4])),
        "PixelAspectRatio": by(unmeasured, put(PixelAspectRatio=[3, 1])),
        "SliceThickness": [*single, slices(put(SliceThickness="4"), 1),
                           slices(put(SliceThickness=None), 1)],
        "SpacingBetweenSlices": [
            *single, slices(put(SpacingBetweenSlices="4"), 1),
            *by(unplaced, put(SpacingBetweenSlices="4")),
            nuclear(put(SpacingBetweenSlices="-3"))],
        "SliceLocation": by(located, lambda image, i: put(SliceLocation=str(9 * i))(image)),
        "FrameOfReferenceUID": by(put(FrameOfReferenceUID="1.2"), lambda image, i: put(
            FrameOfReferenceUID=f"1.{i}")(image)),
        "AnatomicalOrientationType": by(put(AnatomicalOrientationType="BIPED"), put(
            AnatomicalOrientationType="QUADRUPED")),
        "VolumetricProperties": by(put(VolumetricProperties="VOLUME"), put(
            VolumetricProperties="DISTORTED"))}
    for name, value in (
            ("NominalScannedPixelSpacing", [5, 5]), ("GantryDetectorTilt", "12"),
            ("PatientPosition", "FFP"), ("PatientOrientation", ["R", "A"]), ("Laterality", "L"),
            ("ImageLaterality", "L"), ("TableHeight", "44"), ("PositionReferenceIndicator", "AC"),
            ("PixelSpacingCalibrationType", "FIDUCIAL"),
            ("EstimatedRadiographicMagnificationFactor", "1.5"),
            ("DistanceSourceToDetector", "900"), ("DistanceSourceToPatient", "500"),
            ("ReconstructionDiameter", "250"), ("DataCollectionDiameter", "500"),
            ("SequenceOfUltrasoundRegions", [item(PhysicalDeltaX=0.3)])):
        found[name] = by(None, put(**{name: value}))
    return found


def multi_frame():
    moved = {"ImagePositionPatient": lambda i: [0, 0, 9 * i]}

    found = {
        "NumberOfFrames": by(None, put(NumberOfFrames=5), raw(NumberOfFrames="x"), of=frames),
        "SharedFunctionalGroupsSequence": by(None, put(
            SharedFunctionalGroupsSequence=None), of=frames),
        "PerFrameFunctionalGroupsSequence": by(None, lambda image, _=None: (
            image.PerFrameFunctionalGroupsSequence.reverse()), of=frames),
        "PixelMeasuresSequence": by(
            None, shared("PixelMeasuresSequence", PixelSpacing=[3, 4]), in_frames(
                "PixelMeasuresSequence", PixelSpacing=lambda i: [3, 4]), of=frames),
        "PlanePositionSequence": by(
            None, in_frames("PlanePositionSequence", **moved), shared(
                "PlanePositionSequence", ImagePositionPatient=[0, 0, 1]), of=frames),
        "PlaneOrientationSequence": by(
            None, in_frames("PlaneOrientationSequence", ImageOrientationPatient=lambda i: [
                0, 1, 0, 0, 0, -1]), of=frames),
        "PixelValueTransformationSequence": by(
            None, in_frames("PixelValueTransformationSequence", RescaleSlope=lambda i: str(
                i + 1), RescaleIntercept=lambda i: "0"), of=frames),
        "StackID": by(None, in_frames(
            "FrameContentSequence", StackID=lambda i: str(i // 2)), of=frames),
        "PlanePositionVolumeSequence": by(None, in_frames(
            "PlanePositionVolumeSequence", ImagePositionVolume=lambda i: [0.0, 0.0, float(i)]),
            of=frames)}
    for name, value in (("DimensionOrganizationType", "3D"), ("ConcatenationUID", "1.2.9"),
                        ("InConcatenationNumber", 2), ("ConcatenationFrameOffsetNumber", 3),
                        ("DimensionIndexSequence", [item(DimensionIndexPointer=0x00209057)])):
        found[name] = by(None, put(**{name: value}), of=frames)
    for name in ("InStackPositionNumber", "DimensionIndexValues"):
        found[name] = by(None, in_frames("FrameContentSequence", **{name: lambda i: 3 - i}),
                         of=frames)
    return found


def frames_of_times():
    two = numbered(6).reshape(2, 3, 5, 6)
    timed = {"moments": ((1, 0.0), (2, 3.0)), "voxels": two}
    still = {"moments": ((1, 0.0), (2, 0.0)), "voxels": two}

    def of(change=None):
        return frames(change, **timed)

    def at_once(change=None):
        return frames(change, **still)

    return {
        "TemporalPositionIndex": [
            at_once(), at_once(in_frames("FrameContentSequence", TemporalPositionIndex=(
                lambda i: 2 - i // 3)))],
        "TemporalPositionTimeOffset": by(None, in_frames(
            "TemporalPositionSequence", TemporalPositionTimeOffset=lambda i: 7.0 * (i // 3)),
            of=of),
        "FrameAcquisitionDateTime": by(None, in_frames(
            "FrameContentSequence", FrameAcquisitionDateTime=lambda i: f"202402291015{i // 3}0"),
            of=of),
        "FrameReferenceDateTime": by(in_frames(
            "FrameContentSequence", FrameAcquisitionDateTime=lambda i: None), in_frames(
            "FrameContentSequence", FrameReferenceDateTime=lambda i: f"202402291015{i // 3}0"),
            of=at_once),
        "NominalCardiacTriggerDelayTime": by(None, in_frames(
            "CardiacSynchronizationSequence",
            NominalCardiacTriggerDelayTime=lambda i: 40.0 * (i // 3)), of=of),
        "EffectiveEchoTime": by(None, in_frames(
            "MREchoSequence", EffectiveEchoTime=lambda i: 5.0 + i // 3), of=at_once),
        "InversionTimes": by(None, in_frames(
            "MRModifierSequence", InversionTimes=lambda i: 700.0 + i // 3), of=at_once),
        "FrameType": by(None, in_frames(
            "MRImageFrameTypeSequence", FrameType=lambda i: f"ORIGINAL\\PRIMARY\\T{i // 3}"),
            of=of),
        "ComplexImageComponent": by(None, in_frames(
            "MRImageFrameTypeSequence", FrameType=lambda i: "ORIGINAL\\PRIMARY",
            ComplexImageComponent=lambda i: ("MAGNITUDE", "PHASE")[i // 3]), of=of)}


def old_multi_frame():
    found = {
        "SliceVector": by(None, put(SliceVector=[1, 2, 4, 3]), put(SliceVector=[4, 3, 2, 1]),
                          of=nuclear),
        "DetectorInformationSequence": by(None, put(DetectorInformationSequence=[item(
            ImagePositionPatient=[0, 0, 0], ImageOrientationPatient=[0, 1, 0, 0, 0, 1])]),
            of=nuclear),
        "GridFrameOffsetVector": by(put(FrameIncrementPointer=0x3004000c, GridFrameOffsetVector=[
            0, 2, 4, 6]), put(GridFrameOffsetVector=[0, 3, 6, 9]), of=nuclear)}
    for name, tag in (("EnergyWindowVector", 0x00540010), ("DetectorVector", 0x00540020),
                      ("PhaseVector", 0x00540030), ("RotationVector", 0x00540050),
                      ("RRIntervalVector", 0x00540060), ("TimeSlotVector", 0x00540070),
                      ("AngularViewVector", 0x00540090), ("TimeSliceVector", 0x00540100)):
        found[name] = by(put(FrameIncrementPointer=[tag, 0x00540080], **{name: [1] * 4}),
                         put(**{name: [1, 1, 2, 2]}), of=nuclear)
    found["FrameIncrementPointer"] = by(None, put(FrameIncrementPointer=0x00540050), of=nuclear)
    for name, tag, value in (("FrameTime", 0x00181063, "40"),
                             ("FrameTimeVector", 0x00181065, ["0", "40", "40", "40"])):
        found[name] = by(None, put(FrameIncrementPointer=tag, **{name: value}), of=nuclear)
    for name, value in (("NumberOfSlices", 7), ("NumberOfDetectors", 2),
                        ("SliceProgressionDirection", "APEX_TO_BASE")):
        found[name] = by(None, put(**{name: value}), of=nuclear)
    return found


def in_bytes(pixels, **values):
    """A change to slices of bytes without a sign."""
    def change(image, _=None):
        put(BitsAllocated=8, BitsStored=8, HighBit=7, PixelRepresentation=0, PixelData=pixels,
            **values)(image)
        image["PixelData"].VR = "OB"
    return change


colours = in_bytes(bytes(range(90)), SamplesPerPixel=3, PhotometricInterpretation="RGB",
                   PlanarConfiguration=0)


def palettes():
    """Changes of each column, and of what says how many colours there are."""
    columns = [color + "PaletteColorLookupTable" for color in ("Red", "Green", "Blue")]

    def table(first=0, other=None):
        def change(image, _=None):
            in_bytes(bytes(range(30)), PhotometricInterpretation="PALETTE COLOR")(image)
            for name in columns:
                data = bytes([0, 9, 0, 7]) if name == other else bytes([0, 1, 0, 2])
                put(**{name + "Descriptor": [2, first, 16], name + "Data": data})(image)
                image[name + "Data"].VR = "OW"
        return change

    good = slices(table())
    found = {name + "Descriptor": [good, slices(table(first=5))] for name in columns}
    found.update({name + "Data": [good, slices(table(other=name))] for name in columns})
    for name in columns:
        found["Segmented" + name + "Data"] = by(table(), put(**{
            "Segmented" + name + "Data": bytes(4)}))
    return found


def stored():
    def bits(count, high, sign=1):
        return put(BitsStored=count, HighBit=high, PixelRepresentation=sign)

    def floats(name, kind):
        def change(image, _):
            setattr(image, name, (numpy.arange(30) / 7.0).astype(kind).tobytes())
            image.BitsAllocated = 8 * numpy.dtype(kind).itemsize
            del image.PixelData
        return change

    def of(change=None):
        return slices(change, start=-40)
    found = {
        "Rows": by(None, put(Rows=4)), "Columns": by(None, put(Columns=4)),
        "SamplesPerPixel": by(None, put(SamplesPerPixel=3)),
        "PhotometricInterpretation": by(None, put(PhotometricInterpretation="MONOCHROME1")),
        "PresentationLUTShape": by(put(PresentationLUTShape="IDENTITY"), put(
            PresentationLUTShape="INVERSE")),
        "BitsAllocated": by(None, put(BitsAllocated=8, BitsStored=8, HighBit=7)),
        "BitsStored": [of(bits(12, 15)), of(bits(10, 15))],
        "HighBit": [of(bits(8, 7)), of(bits(8, 9))],
        "PixelRepresentation": [of(), of(put(PixelRepresentation=0))],
        "PixelPaddingValue": by(None, put(PixelPaddingValue=2000)),
        "PixelData": by(None, put(PixelData=bytes(60))),
        "TransferSyntaxUID": [slices(), slices(syntax=BIG_ENDIAN, change=put(PixelData=bytes(
            range(60))))],
        "FloatPixelData": by(None, floats("FloatPixelData", "<f4")),
        "DoubleFloatPixelData": by(None, floats("DoubleFloatPixelData", "<f8"))}
    for name, value in (
            ("PixelPaddingRangeLimit", -3),
            ("SmallestImagePixelValue", 5), ("LargestImagePixelValue", 9),
            ("LossyImageCompression", "01"),
            ("IconImageSequence", [item(Rows=2, Columns=2, BitsAllocated=8, PixelRepresentation=0,
                                        PixelData=bytes(4))])):
        found[name] = by(None, put(**{name: value}))
    found["PlanarConfiguration"] = by(colours, put(PlanarConfiguration=1))
    found.update(palettes())
    found["OverlayData"] = by(None, lambda image, _: image.add_new(0x60003000, "OW", bytes(4)))
    return found


def values():
    table = item(LUTDescriptor=[2, 0, 16], LUTData=bytes(4), ModalityLUTType="US")
    mapping = item(RealWorldValueSlope=2.5, RealWorldValueIntercept=0.0)
    plain = put(RescaleSlope="1", RescaleIntercept="0")

    def unit(name, kind):
        return lambda image, i: put(**{name: kind(i)})(image)
    found = {
        "RescaleSlope": by(plain, put(RescaleSlope="2"), put(RescaleSlope="0")),
        "RescaleIntercept": by(plain, put(RescaleIntercept="2")),
        "RescaleType": by(unit("RescaleType", lambda i: "HU"), unit(
            "RescaleType", lambda i: "HU" if i < 2 else "US")),
        "Units": by(unit("Units", lambda i: "BQML"), unit(
            "Units", lambda i: "BQML" if i < 2 else "CNTS")),
        "ModalityLUTSequence": by(None, put(ModalityLUTSequence=[table])),
        "RealWorldValueMappingSequence": by(None, put(RealWorldValueMappingSequence=[mapping])),
        "DoseGridScaling": by(put(DoseGridScaling="1"), put(DoseGridScaling="0.5")),
        "SegmentationType": by(put(SegmentationType="LABELMAP"), put(
            SegmentationType="FRACTIONAL"))}
    for name, value in (
            ("DoseUnits", "RELATIVE"), ("DoseType", "ERROR"), ("DecayCorrection", "ADMIN"),
            ("WindowCenter", "3"), ("WindowWidth", "4"), ("VOILUTFunction", "SIGMOID"),
            ("VOILUTSequence", [table]), ("PixelIntensityRelationship", "LOG"),
            ("PixelIntensityRelationshipSign", -1)):
        found[name] = by(None, put(**{name: value}))
    return found


def moments():
    dated = by_time(AcquisitionDate=("20240229", "20240229"),
                    AcquisitionTime=("101500", "101510"))
    found = {
        "TemporalPositionIdentifier": by(None, by_time(
            TemporalPositionIdentifier=("2", "1")), of=times),
        "TriggerTime": by(None, by_time(TriggerTime=("0", "40")), raw(
            TriggerTime="x"), of=times),
        "EchoNumbers": by(None, by_time(EchoNumbers=("2", "1")), of=times),
        "EchoTime": by(None, by_time(EchoTime=("20", "10")), of=times),
        "InversionTime": by(None, by_time(InversionTime=("20", "10")), of=times),
        "FlipAngle": by(None, by_time(FlipAngle=("20", "10")), of=times),
        "KVP": by(None, by_time(KVP=("140", "80")), of=times),
        "DiffusionBValue": by(None, by_time(DiffusionBValue=(1000.0, 0.0)), of=times),
        "AcquisitionDateTime": by(None, by_time(
            AcquisitionDateTime=("20240229101500", "20240229101520")), of=times),
        "AcquisitionDate": by(dated, by_time(AcquisitionDate=("20240228", "20240229")), of=times),
        "AcquisitionTime": by(dated, by_time(AcquisitionTime=("101500", "101520")), of=times),
        "ContentTime": by(None, by_time(ContentTime=("101500", "101520")), of=times),
        "ContentDate": by(by_time(ContentTime=("101500", "101520")), by_time(
            ContentDate=("20240228", "20240229")), of=times),
        "TemporalResolution": by(None, put(TemporalResolution="4000"), of=times),
        "RepetitionTime": by(None, put(RepetitionTime="2000"), of=times),
        "FrameReferenceTime": by(None, by_time(FrameReferenceTime=("500", "2500")), of=times),
        "InstanceNumber": by(None, by_time(InstanceNumber=("2", "1")), of=times)}
    for name, value in (
            ("NumberOfTemporalPositions", "9"), ("TimezoneOffsetFromUTC", "+0500"),
            ("ActualFrameDuration", "9"), ("AcquisitionNumber", "4"),
            ("AcquisitionDuration", 9.0), ("ImageIndex", 3), ("NumberOfTimeSlices", 3),
            ("SeriesTime", "120000"), ("HeartRate", "70"), ("NominalInterval", "800"),
            ("NumberOfAverages", "2")):
        found[name] = by(None, put(**{name: value}), of=times)
    return found


def names():
    def other(**values):
        return lambda image, i: put(**values)(image) if i == 2 else None
    found = {
        "SeriesInstanceUID": by(None, other(SeriesInstanceUID="1.2.3.4.6")),
        "SOPInstanceUID": [times(put(SOPInstanceUID="1.5")), times(by_time(
            SOPInstanceUID=("1.5", "1.6")))],
        "ImageType": by(None, other(ImageType=["DERIVED", "SECONDARY", "LOCALIZER"])),
        "SeriesDescription": by(None, put(SeriesDescription="Neck")),
        "SeriesNumber": by(None, put(SeriesNumber="9")),
        "Modality": by(None, put(Modality="PT")),
        "SeriesDate": by(None, put(SeriesDate="20230101")),
        "SpecificCharacterSet": by(put(SpecificCharacterSet="ISO_IR 100", SeriesDescription="Käse"),
                                   put(SpecificCharacterSet="ISO_IR 101"))}
    for name, value in (
            ("StudyInstanceUID", "1.2.3.5"), ("SOPClassUID", "1.2.840.10008.5.1.4.1.1.128"),
            ("BodyPartExamined", "HAND"), ("ProtocolName", "other"), ("SeriesType", "GATED"),
            ("PatientComments", "none"), ("BurnedInAnnotation", "YES"),
            ("ContrastBolusAgent", "Gd"), ("ConvolutionKernel", "B70")):
        found[name] = by(None, put(**{name: value}))
    return found


def read(write):
    return fields_walk.outcome_of("DICOMVolumeReader", write())


def test_each_attribute_of_the_plane_does_what_the_list_says():
    fields_walk.walk("DICOM", "Attributes of places", plane(), read)


def test_each_attribute_of_multi_frame_files_does_what_the_list_says():
    fields_walk.walk("DICOM", "Attributes of frames", {
        **multi_frame(), **frames_of_times(), **old_multi_frame()}, read)


def test_each_attribute_of_stored_numbers_does_what_the_list_says():
    fields_walk.walk("DICOM", "Attributes of stored numbers", stored(), read)


def test_each_attribute_of_values_does_what_the_list_says():
    fields_walk.walk("DICOM", "Attributes of values", values(), read)


def test_each_attribute_of_times_does_what_the_list_says():
    fields_walk.walk("DICOM", "Attributes of times", moments(), read)


def test_each_attribute_of_series_does_what_the_list_says():
    fields_walk.walk("DICOM", "Attributes of series", names(), read)


run_tests(globals())
