# SPDX-License-Identifier: BSD-3-Clause
# Proves that NRRD files of four dimensions as ITK writes them open at their places and times, that
# those of old segmentations open layer by layer, and that displacement fields with vectors last or
# in RAS mean what the file says.
import os
import subprocess

import nibabel
import numpy
from brainshift_testing import load_plugin, messages, run_tests, scratch
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

RANDOM = numpy.random.default_rng(5)
TURN = numpy.array(((0.96, -0.28, 0), (0.28, 0.96, 0), (0, 0, 1)))
SIZES, ORIGIN = numpy.array((2.0, 1.5, 3.0)), (-20.0, 30.0, -7.0)  # RAS


def affine():
    found = numpy.eye(4)
    found[:3, :3], found[:3, 3] = TURN * SIZES, ORIGIN
    return found


def four():
    """A NIfTI file of 4 times from 1 s on, 2.5 s apart."""
    voxels = RANDOM.integers(0, 3000, (7, 6, 5, 4)).astype(numpy.int16)
    image = nibabel.Nifti1Image(voxels, affine())
    image.header.set_zooms((*SIZES, 2.5))
    image.header.set_xyzt_units("mm", "sec")
    image.header["toffset"] = 1.0
    nibabel.save(image, scratch("four.nii.gz"))
    return scratch("four.nii.gz")


def read(kind, name, times):
    """Times, and at each of them the values and places of all voxels."""
    with messages() as heard:
        reader = kind(FileName=name)
        reader.UpdatePipeline()
        source = reader.GetClientSideObject()
        found = [numpy.array(reader.TimestepValues)]
        for time in times:
            source.UpdateTimeStep(time)
            image = source.GetOutputDataObject(0)
            axes = image.GetDirectionMatrix()
            matrix = numpy.array([[axes.GetElement(i, j) for j in range(3)] for i in range(3)])
            found += [vtk_to_numpy(image.GetPointData().GetScalars()).copy(), matrix,
                      numpy.array(image.GetOrigin()), numpy.array(image.GetSpacing())]
    return found, heard.text


def assert_same(one, other):
    for mine, theirs in zip(one, other, strict=True):
        assert numpy.abs(numpy.asarray(mine, float) - theirs).max() < 1e-4, (mine, theirs)


def test_four_dimensions_as_itk_writes_them():
    original = four()
    times = (1.0, 3.5, 6.0, 8.5)
    right, _ = read(simple.NIFTIVolumeReader, original, times)
    assert numpy.allclose(right[0], times)
    by_itk = scratch("by_itk.nrrd")
    done = subprocess.run([os.path.join(os.path.dirname(os.environ["BRAINSHIFT_CONVERT_IMAGE"]),
                                        "MultiplyImages"), "4", original, "1", by_itk],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found, heard = read(simple.NRRDVolumeReader, by_itk, times)
    assert "names no space" in heard and "sides of the patient" in heard, heard
    assert_same(found, right)
    with open(by_itk, "rb") as file:
        stored = file.read()
    for space in ("left-posterior-superior-time", "LPST"):
        named = scratch("named.nrrd")
        with open(named, "wb") as file:
            file.write(stored.replace(b"space dimension: 4", b"space: " + space.encode()))
        found, heard = read(simple.NRRDVolumeReader, named, times)
        assert "sides" not in heard, heard
        assert_same(found, right)


def old_segmentation(layers):
    """As 3D Slicer before 4.11 writes segments by ITK: along the last of four axes of space, with a
    colour by default. `layers`: [segment, z, y, x]."""
    sides = " ".join(map(str, reversed(layers.shape)))
    lines = ["NRRD0004", "type: unsigned char", "dimension: 4", "space dimension: 4",
             f"sizes: {sides}", "space directions: (-2,0,0,0) (0,-1.5,0,0) (0,0,3,0) (0,0,0,1)",
             "kinds: domain domain domain domain", "encoding: raw", "space origin: (20,-30,-7,0)",
             *(line for i in range(len(layers)) for line in (
                 f"Segment{i}_ID:=s{i}", f"Segment{i}_Name:=part {i}",
                 f"Segment{i}_DefaultColor:=0 {i} 1"))]
    name = scratch(f"old{len(layers)}.seg.nrrd")
    with open(name, "wb") as file:
        file.write(("\n".join(lines) + "\n\n").encode() + layers.tobytes())
    return name


def test_segments_along_a_fourth_axis_of_space():
    """No times, sides that are known, and a layer for each segment, as 3D Slicer reads them."""
    layers = RANDOM.integers(0, 2, (2, 4, 5, 6)).astype(numpy.uint8)
    with messages() as heard:
        reader = simple.NRRDVolumeReader(FileName=old_segmentation(layers))
        reader.UpdatePipeline()
    assert "has 2 layers of segments" in heard.text and "part 1" in heard.text, heard.text
    assert "left and right" not in heard.text, heard.text
    assert len(reader.TimestepValues) <= 1
    assert list(reader.GetProperty("LayerList")) == ["1: part 0", "2: part 1"]
    for i, layer in enumerate(layers):
        reader.Layer = f"{i + 1}"
        reader.UpdatePipeline()
        image = reader.GetClientSideObject().GetOutputDataObject(0)
        shown = vtk_to_numpy(image.GetPointData().GetScalars())
        assert numpy.array_equal(shown, layer.ravel())
        assert image.GetOrigin() == (-20.0, 30.0, -7.0) and image.GetSpacing() == (2, 1.5, 3)
        fields = image.GetFieldData()
        assert fields.GetAbstractArray("WorldAxes").GetValue(0) == "RAS"
        assert vtk_to_numpy(fields.GetArray("LabelColors")).tolist() == [[0, 255 * i, 255]]
        assert fields.GetAbstractArray("LabelNames").GetValue(0) == f"part {i}"
    with messages() as heard:
        reader = simple.NRRDVolumeReader(FileName=old_segmentation(layers[:1]))
        reader.UpdatePipeline()
    assert not heard.text, heard.text


def header(**fields):
    lines = {"type": "float", "dimension": "4", "endian": "little", "encoding": "raw",
             **{name.replace("_", " "): value for name, value in fields.items()}}
    return "NRRD0005\n" + "".join(f"{name}: {value}\n" for name, value in lines.items()) + "\n"


def write_field(name, vectors, isLast, space, **fields):
    """Vectors [z, y, x, 3], RAS, in a space of the axes that `space` has."""
    signs = {"right-anterior-superior": (1, 1, 1), "left-anterior-superior": (-1, 1, 1),
             "left-posterior-superior": (-1, -1, 1)}[space]
    steps = ["(" + ",".join(map(str, signs * (TURN * SIZES)[:, i])) + ")" for i in range(3)]
    origin = "(" + ",".join(map(str, numpy.array(signs) * ORIGIN)) + ")"
    sides = [str(side) for side in vectors.shape[2::-1]]
    stored = (vectors * signs).astype("<f4")
    kinds = ["domain"] * 3
    for words, word in ((sides, "3"), (steps, "none"), (kinds, "vector")):
        words.insert(3 if isLast else 0, word)
    lines = {"space": space, "sizes": " ".join(sides), "space directions": " ".join(steps),
             "kinds": " ".join(kinds), "space origin": origin}
    lines.update({word.replace("_", " "): value for word, value in fields.items()})
    with open(scratch(name), "wb") as file:
        file.write(header(**lines).encode())
        file.write((numpy.moveaxis(stored, 3, 0) if isLast else stored).tobytes())
    return scratch(name)


def refusal(name):
    try:
        brainshift.read_transform(name)
    except OSError as problem:
        return str(problem)
    return ""


def test_vectors_last_and_in_ras():
    vectors = RANDOM.uniform(-4, 4, (5, 6, 7, 3)).astype(numpy.float32).astype(float)
    z, y, x = numpy.mgrid[:5, :6, :7]
    places = numpy.stack((x, y, z), axis=-1).reshape(-1, 3) @ (TURN * SIZES).T + ORIGIN
    right = places + vectors.reshape(-1, 3)
    frame = "(1,0,0) (0,1,0) (0,0,1)"
    for space in ("left-posterior-superior", "right-anterior-superior", "left-anterior-superior"):
        fields = {} if space.startswith("left-p") else {"measurement_frame": frame}
        for isLast in (False, True):
            name = write_field("other.nrrd", vectors, isLast, space, **fields)
            found = brainshift.read_transform(name).map(places)
            assert numpy.abs(found - right).max() < 1e-3, (space, isLast)
    name = write_field("other.nrrd", vectors, False, "right-anterior-superior")
    assert "add the line measurement frame: (1,0,0) (0,1,0)" in refusal(name), refusal(name)
    name = write_field("other.nrrd", vectors, True, "left-posterior-superior",
                       kinds="domain domain domain ???")
    assert "may be 3 times" in refusal(name), refusal(name)
    name = write_field("other.nrrd", vectors, False, "right-anterior-superior",
                       measurement_frame="(0,1,0) (1,0,0) (0,0,1)")
    assert "measurement frame" in refusal(name), refusal(name)


run_tests(globals())
