# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled DICOM: a folder of slices of which one is spoiled, or a multi-frame file.

Slices are read by BrainShift and by pydicom, and compared. A case is good if both read the same
numbers at the same places, if BrainShift refuses the folder, or if it tells what it left out.
"""

import os
import shutil
import struct

import numpy
import pydicom
from dicom_testing import enhanced, numbered, read_again, write_slices
from files_cases import image_of, misplaced
from mutation import rotation

SYNTAXES = ["1.2.840.10008.1.2", "1.2.840.10008.1.2.1", "1.2.840.10008.1.2.1",
            "1.2.840.10008.1.2.2", "1.2.840.10008.1.2.1.99", "1.2.840.10008.1.2.5"]
RLE = SYNTAXES[-1]
LENGTHS = [0, 1, 2, 3, 7, 8, 12, 16, 255, 256, 0x7fff, 0xfffe, 0xffff, 0x10000, 0x7fffffff,
           0xfffffff0, 0xfffffffe, 0xffffffff]


def _write(random, path):
    """A good series in an empty folder; whether pydicom's reading of it can be compared."""
    voxels = numbered(3, random.randrange(2, 9), random.randrange(2, 9),
                      random.choice([numpy.uint8, numpy.int16, numpy.uint16]))
    axes = rotation(random)
    if random.random() < 0.2:
        frames = enhanced(voxels[None], axes=(axes[:, 0], axes[:, 1]))
        frames.save_as(os.path.join(path, "IM0001.dcm"), write_like_original=False)
        return False
    syntax = random.choice(SYNTAXES)
    plain = SYNTAXES[1] if syntax == RLE else syntax
    write_slices(path, voxels, axes=(axes[:, 0], axes[:, 1]), syntax=pydicom.uid.UID(plain))
    if syntax == RLE:
        for name in os.listdir(path):
            image = pydicom.dcmread(os.path.join(path, name))
            image.compress(pydicom.uid.RLELossless)
            image.save_as(os.path.join(path, name))
    return True


def _read(path):
    """The image, and how many series there are."""
    from paraview import simple
    proxy = simple.DICOMVolumeReader(FileName=path)
    try:
        proxy.UpdatePipeline()
        return image_of(proxy, "Intensity"), len(list(proxy.GetProperty("SeriesList")))
    finally:
        simple.Delete(proxy)


def spoiled(random, data):
    """The bytes of a DICOM file with one thing spoiled: a byte, a length, or the end."""
    change = random.random()
    place = random.randrange(132, len(data))
    if change < 0.4:
        return data[:place] + bytes([random.randrange(256)]) + data[place + 1:]
    if change < 0.8:
        kind = random.choice(["<H", "<I"])
        length = random.choice(LENGTHS) & (0xffff if kind == "<H" else 0xffffffff)
        return data[:place] + struct.pack(kind, length) + data[place + struct.calcsize(kind):]
    return data[:place] if change < 0.9 else data + bytes(random.randrange(1, 99))


def _compared(random, path, image):
    try:
        affine, voxels = read_again(path)
        bits = {(image.BitsStored, image.BitsAllocated) for image in (
            pydicom.dcmread(os.path.join(path, name)) for name in os.listdir(path))}
    except Exception:  # of many kinds: pydicom checks little before it uses it
        return "open"
    if any(stored != allocated for stored, allocated in bits):
        return "open"  # pydicom leaves bits that are not stored
    with numpy.errstate(all="ignore"):
        problem = misplaced(random, image, lambda index: (affine @ [*index, 1.0])[:3],
                            voxels.transpose(2, 1, 0)[..., None])
    return f"misplaced: {problem}" if problem else "same"


class Cases:
    """Reads spoiled series, one for each case."""

    def __init__(self, folder):
        self.folder = os.path.join(folder, "series")

    def run(self, random):
        """What became of one series: a word, and a sentence if it is a finding."""
        from brainshift_testing import messages
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        comparable = _write(random, self.folder)
        name = os.path.join(self.folder, random.choice(sorted(os.listdir(self.folder))))
        with open(name, "rb") as file:
            data = file.read()
        for _ in range(random.choice([0, 1, 1, 1, 2, 3])):
            data = spoiled(random, data) if len(data) > 133 else data
        with open(name, "wb") as file:
            file.write(data)
        with messages() as said:
            image, series = _read(self.folder)
        if image is None:
            return "refused" if "error" in said.text.lower() else "misplaced: no image and no error"
        if said.text or series > 1:
            return "told"
        if not comparable or image[2].shape[:3].count(3) == 0:
            return "taken"
        return _compared(random, self.folder, image)
