# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled files that a written DICOM series is to be like.

A case is good if BrainShift refuses the file with a sentence that names it and writes nothing, or
writes a series whose patient and study are what pydicom reads in the file. Either way a bent volume
and a series that was written before must stay.
"""

import filecmp
import os
import shutil

import numpy
import pydicom
from brainshift_testing import ball, data, volume
from dicom_cases import SYNTAXES, spoiled
from dicom_testing import MR, plain_header, set_pixels
from scene import array_of

#: Attributes that a series takes from the file, one of each type.
KEPT = ["SpecificCharacterSet", "StudyDate", "StudyTime", "AccessionNumber", "Modality",
        "StudyDescription", "PatientName", "PatientID", "PatientBirthDate", "PatientAge",
        "PatientWeight", "ScanningSequence", "PatientPosition", "StudyInstanceUID", "StudyID",
        "FrameOfReferenceUID", "WindowCenter"]
MADE = ("FrameOfReferenceUID", "ScanningSequence")  # where the file has none


def _scan(name, syntax):
    """A file of a scan with few pixels: no reader of attributes goes on to them."""
    image = plain_header(MR, pydicom.uid.UID(syntax))
    image.SpecificCharacterSet = "ISO_IR 192"
    image.PatientName, image.PatientID, image.PatientAge = "Müller^Anna", "4711", "054Y"
    image.StudyID, image.StudyDate, image.StudyTime = "7", "20240229", "101500"
    image.ScanningSequence, image.PatientPosition = "SE", "HFS"
    image.FrameOfReferenceUID, image.WindowCenter = "1.2.3.4.5.6", ["40", "400"]
    image.ReferencedStudySequence = [pydicom.Dataset()]
    image.ReferencedStudySequence[0].ReferencedSOPInstanceUID = "1.2.3.7"
    image.private_block(0x0029, "MAKER", create=True).add_new(1, "OB", b"\1\2\3\4")
    set_pixels(image, numpy.zeros((2, 2), numpy.int16))
    image.save_as(name, write_like_original=False)


def _values(image):
    """Bytes of what a series takes, without what fills them up; None where there are none."""
    found = {}
    for keyword in KEPT:
        tag = pydicom.tag.Tag(keyword)
        value = image.get_item(tag).value if tag in image else None
        found[keyword] = value.rstrip(b" \0") if isinstance(value, bytes) else value
    return found


def _compared(name, folder, pixels):
    """What a written series and pydicom's reading of the file have to say of each other."""
    slices = [pydicom.dcmread(os.path.join(folder, file)) for file in sorted(os.listdir(folder))]
    stored = numpy.array([image.pixel_array for image in slices])
    if sorted(stored.ravel()) != sorted(pixels.ravel()):
        return "misplaced: the pixels are others"
    written = _values(slices[0])
    try:
        read = _values(pydicom.dcmread(name, stop_before_pixels=True, force=True))
    except Exception:  # of many kinds: pydicom checks little before it uses it
        return "accepted"
    for keyword, value in read.items():
        mine = written[keyword]
        if (value or b"") != (mine or b"") and not (keyword in MADE and not value):
            return f"misplaced: {keyword} is {mine!r} and not {value!r}"
    return "same"


def _files(folder):
    return sorted(os.path.join(folder, name) for name in os.listdir(folder))


class Cases:
    """Writes series like spoiled files, one for each case."""

    def __init__(self, folder):
        import brainshift
        from paraview import simple
        self.folder, self.series = os.path.join(folder, "written"), os.path.join(folder, "series")
        self.like = os.path.join(folder, "like.dcm")
        self.scans = [data("pydicom-data", "emri_small_jpeg_ls_lossless.dcm")]
        for syntax in sorted(set(SYNTAXES[:-1])):
            self.scans.append(os.path.join(folder, syntax + ".dcm"))
            _scan(self.scans[-1], syntax)
        self.pixels = numpy.arange(24, dtype=numpy.int16).reshape(2, 3, 4)
        self.source = volume(self.pixels)
        self.bent = simple.FreeFormDeformation(
            Input=volume(ball(side=9, radius=3.0)),
            Strokes=brainshift.soft((4, 4, 4), (1, 0, 0), 3.0))
        brainshift.save_dicom(self.source, self.series, self.scans[-1], world="RAS")
        self.kept = os.path.join(folder, "kept")
        shutil.copytree(self.series, self.kept)
        self.before = list(self.bent.Strokes), array_of(self.bent)

    def run(self, random):
        """What became of one file: a word, and a sentence if it is a finding."""
        with open(random.choice(self.scans), "rb") as file:
            scan = file.read(4096)  # up to the pixels, and some of them
        for _ in range(random.choice([0, 1, 1, 1, 2, 3])):
            scan = spoiled(random, scan) if len(scan) > 132 else scan
        with open(self.like, "wb") as file:
            file.write(scan)
        shutil.rmtree(self.folder, ignore_errors=True)
        result = self._save(random.random() < 0.2)
        strokes, numbers = list(self.bent.Strokes), array_of(self.bent)
        if strokes != self.before[0] or not numpy.array_equal(numbers, self.before[1]):
            return "stuck: the bent volume is another one"
        if not all(map(filecmp.cmp, _files(self.series), _files(self.kept))):
            return "stuck: the series that was there is another one"
        return result

    def _save(self, is_over):
        """Writes a series, or tries to write it over the one that is there."""
        import brainshift
        from brainshift_testing import messages
        with messages() as said:
            try:
                brainshift.save_dicom(
                    self.source, self.series if is_over else self.folder, self.like, world="RAS")
            except OSError as error:
                names = "holds files already" if is_over else "Like is " + self.like
                if is_over and "Like is" in str(error) or names in str(error):
                    left = [name for name in os.listdir(os.path.dirname(self.folder))
                            if name.startswith(".part-") or name == "written"]
                    return f"stuck: {left} is left" if left else "refused"
                return f"misplaced: it was said {error}"
        if is_over:
            return "stuck: the series that was there was written over"
        return f"misplaced: {said.text}" if said.text else _compared(
            self.like, self.folder, self.pixels)
