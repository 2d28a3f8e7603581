# SPDX-License-Identifier: BSD-3-Clause
# Proves that each reader says a way out of what it refuses: of files that are empty, cut, or begin
# with other bytes, in each ending that a reader takes.
import re

from brainshift_testing import load_plugin, messages, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

#: What a file may begin with: each is known by one format and refused by all others.
BEGINNINGS = (b"", b"\0" * 400, b"NRRD0004\n", b"ObjectType = Image\n", b"CDF\1" + b"\0" * 40,
              b"\x89HDF\r\n\x1a\n" + b"\0" * 40, b"TRACK" + b"\0" * 995, b"mrtrix tracks\n",
              b"\xff\xff\xfe" + b"\n" * 20, b"<?xml version='1.0'?><GIFTI/>",
              b"PK\5\6" + b"\0" * 18, b"{}", b"x,y,z\n1,2\n",
              b"\0" * 128 + b"DICM", b"#Insight Transform File V1.0\n",
              b"MNI Tag Point File\n", b"MNI Transform File\n", b"type = 1\nnxforms = 1\n1 4 4\n")
READERS = {"DICOMVolumeReader": (".dcm",), "NIFTIVolumeReader": (".nii", ".nii.gz"),
           "NRRDVolumeReader": (".nrrd",), "MetaImageVolumeReader": (".mha",),
           "FreeSurferVolumeReader": (".mgh",), "MINC1VolumeReader": (".mnc",),
           "MINCVolumeReader": (".mnc",), "OMEZarrReader": (".zip",),
           "DisplacementFieldReader": (".nii", ".nrrd", ".mha"), "SurfaceReader": (".gii", ".pial"),
           "TractReader": (".trk", ".tck", ".trx"),
           "LandmarkReader": (".csv", ".mrk.json", ".fcsv", ".tag")}


#: Is built only where libminc is.
MAY_LACK = "MINCVolumeReader"
#: The part of a sentence that says what to do begins so.
ADVICE = re.compile(
    r"(?:; |\. )(?:choose|close|convert|copy|let|make|name|open|save|set|write) [^;.]",
    re.IGNORECASE)


def advice_in(sentence):
    """How often a sentence says what to do."""
    return len(ADVICE.findall(sentence))


def refusals(reader, ending):
    """(first bytes, what was said) of each file that is not read."""
    for begin in BEGINNINGS:
        name = scratch("refused" + ending)
        with open(name, "wb") as file:
            file.write(begin)
        with messages() as said:
            source = getattr(simple, reader)(FileName=name)
            source.UpdatePipeline()
            simple.Delete(source)
        if "error" in said.text.lower():
            yield begin, said.text[said.text.index(name) + len(name):]


def test_each_refusal_of_a_reader_says_a_way_out():
    silent, count = [], 0
    for reader, endings in READERS.items():
        for ending in endings if hasattr(simple, reader) or reader != MAY_LACK else ():
            for begin, sentence in refusals(reader, ending):
                count += 1
                if advice_in(sentence) != 1:
                    silent.append((reader, ending, begin[:12], sentence))
    print(f"{count} refusals")
    assert count > 200 and not silent, "\n".join(map(str, silent))


def test_refusals_of_transforms_say_a_way_out():
    silent = []
    for ending in (".tfm", ".txt", ".mat", ".h5", ".lta", ".xfm", ".nii.gz"):
        for begin in BEGINNINGS:
            name = scratch("refused" + ending)
            with open(name, "wb") as file:
                file.write(begin)
            try:
                brainshift.read_transform(name)
            except OSError as found:
                if advice_in(str(found)) != 1:
                    silent.append((ending, begin[:12], str(found)))
    assert not silent, "\n".join(map(str, silent))


def test_all_readers_of_volumes_are_asked():
    """A new one gets a line above."""
    names = [name for name in dir(simple) if name.endswith(("VolumeReader", "ZarrReader"))]
    ours = {name for name in names
            if getattr(simple, name)().SMProxy.GetVTKClassName() == "vtkVolumeFileReader"}
    ours -= {"BrainShiftDICOMVolumeReader"}  # that of DICOM once more, for File > Open
    assert ours <= set(READERS), ours - set(READERS)


run_tests(globals())
