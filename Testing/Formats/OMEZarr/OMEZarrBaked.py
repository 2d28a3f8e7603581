# SPDX-License-Identifier: BSD-3-Clause
# Proves that a bent store is baked into stores and files piece by piece, with the numbers of a bake
# of the whole, and that what is stopped is reported and leaves no half of a file.
import json
import os
import shutil

import numpy
import zarr
from brainshift_testing import assert_says, load_plugin, messages, output, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.roles import reader_of  # noqa: E402
from paraview import servermanager, simple  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

SIZE = (130, 140, 150)  # z, y, x
SMALL = 0.5  # MiB: pieces and parts of this test; the volume has 5


def values():
    """A ball with noise, and the lowest value at the end: int16."""
    z, y, x = numpy.meshgrid(*(numpy.arange(side) for side in SIZE), indexing="ij")
    away = (z - 65.0) ** 2 + (y - 70.0) ** 2 + (x - 75.0) ** 2
    noise = numpy.random.default_rng(5).integers(0, 90, SIZE)
    ball = (3000 * (away < 55 ** 2) + noise).astype("int16")
    ball[-1, -1, -1] = -321
    return ball


def store():
    path = scratch("bent.ome.zarr")
    if not os.path.exists(path):
        file = scratch("ball.nii")
        import nibabel
        nibabel.save(nibabel.Nifti1Image(values().T, numpy.diag((0.9, 1.1, 1.3, 1))), file)
        brainshift.pyramid(file, path)
    return path


def bent(**words):
    reader = simple.OMEZarrReader(FileName=store(), Level=0, **words)
    strokes = brainshift.soft((60, 70, 80), (12, -8, 9), 40.0)
    strokes += brainshift.soft((2, 2, 2), (5, 5, 5), 20.0)  # brings tissue from outside
    return simple.FreeFormDeformation(Input=reader, Strokes=strokes)


def baked(limit=SMALL, **words):
    return simple.BakeDeformation(Input=bent(), MemoryLimit=limit, **words)


def numbers_of(source):
    image = output(source)
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])


def whole(**words):
    numbers = numbers_of(baked(512.0, **words))
    assert (numbers != values()).sum() > 20000, "little moves"
    assert (numbers[:8, :8, :8] == -321).sum() > 5, "nothing comes from outside"
    return numbers


def target(name):
    path = scratch(name)
    if os.path.isdir(path):
        shutil.rmtree(path)
    elif os.path.exists(path):
        os.remove(path)
    return path


def run(writer):
    with messages() as said:
        writer.UpdatePipeline()
    writer.SMProxy.UpdatePropertyInformation()
    return writer.GetPropertyValue("Problem"), said.text


def test_into_a_store():
    for interpolation in ("Linear", "Cubic"):
        path = target("baked.ome.zarr")
        source = baked(Interpolation=interpolation)
        problem, _ = run(servermanager.writers.OMEZarrWriter(
            Input=source, FileName=path, MemoryLimit=SMALL))
        assert problem == "", problem
        found = zarr.open_array(os.path.join(path, "0"), mode="r")[...]
        assert numpy.array_equal(found, whole(Interpolation=interpolation)), interpolation
        own = source.GetClientSideObject()
        assert own.GetOutputDataObject(0).GetNumberOfPoints() < 0.6 * numpy.prod(SIZE)
    again = output(reader_of(path))
    before = output(simple.OMEZarrReader(FileName=store(), Level=0))
    assert numpy.allclose(again.GetBounds(), before.GetBounds())


def test_into_files():
    expected = whole()
    for ending in ("nii", "nii.gz", "nrrd", "mha"):
        name = target("baked." + ending)
        source = baked()
        problem, _ = run(servermanager.writers.MedicalVolumeWriter(
            Input=source, FileName=name, MemoryLimit=SMALL))
        assert problem == "", problem
        held = source.GetClientSideObject().GetOutputDataObject(0)
        assert held.GetNumberOfPoints() < 0.2 * numpy.prod(SIZE), held.GetDimensions()
        again = reader_of(name)
        assert numpy.array_equal(numbers_of(again), expected), ending
        assert numpy.allclose(output(again).GetBounds(), output(bent()).GetBounds()), ending
        at_once = target("whole." + ending)
        brainshift.save_volume(baked(512.0), at_once)
        if ending != "nii.gz":
            with open(name, "rb") as parts, open(at_once, "rb") as all_at_once:
                assert parts.read() == all_at_once.read(), ending


def test_components_one_after_the_other():
    """NIfTI has all of the first component first: the file gets all at once."""
    calculator = simple.Calculator(Input=baked(), Function="iHat*Intensity+jHat*2*Intensity+kHat",
                                   ResultArrayName="Three")
    name = target("three.nii")
    problem, _ = run(servermanager.writers.MedicalVolumeWriter(
        Input=calculator, FileName=name, PointArray="Three", MemoryLimit=SMALL))
    assert problem == "", problem
    import nibabel
    found = numpy.asarray(nibabel.load(name).dataobj)
    assert numpy.array_equal(found[..., 0, 1].T, 2.0 * whole()), found.shape


def test_save_data():
    path = target("saved.ome.zarr")
    simple.SaveData(path, proxy=baked())
    assert numpy.array_equal(zarr.open_array(os.path.join(path, "0"), mode="r")[...], whole())


def test_stopped_in_a_bake():
    """Cancel while a piece is baked: the store is unfinished and says so, and can be continued."""
    path = target("stopped.ome.zarr")
    marker = os.path.join(path, "brainshift-unfinished.json")
    source = baked()
    own = source.GetClientSideObject()

    def stop(*_):
        own.SetAbortExecute(1 if os.path.exists(marker) else 0)
    tag = own.AddObserver("ProgressEvent", stop)
    words = {"Input": source, "FileName": path, "MemoryLimit": SMALL}
    problem, said = run(servermanager.writers.OMEZarrWriter(**words))
    assert_says(problem, "it was asked for", "stopped")
    assert problem in said, said
    assert os.path.exists(marker)
    own.RemoveObserver(tag)
    own.SetAbortExecute(0)
    own.Modified()
    problem, _ = run(servermanager.writers.OMEZarrWriter(**words))
    assert problem == "", problem
    assert numpy.array_equal(zarr.open_array(os.path.join(path, "0"), mode="r")[...], whole())


def damaged():
    """The store with one level alone, whose last chunk is cut off: nothing can stand for it."""
    path = target("damaged.ome.zarr")
    shutil.copytree(store(), path)
    name = os.path.join(path, ".zattrs")
    with open(name, encoding="utf-8") as file:
        attributes = json.load(file)
    del attributes["multiscales"][0]["datasets"][1:]
    del attributes["brainshift"]
    with open(name, "w", encoding="utf-8") as file:
        json.dump(attributes, file)
    for level in ("1", "2"):
        shutil.rmtree(os.path.join(path, level), ignore_errors=True)
    with open(os.path.join(path, "0", "2", "2", "2"), "r+b") as chunk:
        chunk.truncate(40)
    return path


def test_an_input_that_fails_at_its_end():
    """An error and not a bake that waits for ever."""
    reader = simple.OMEZarrReader(FileName=damaged(), Level=0)
    strokes = brainshift.soft((60, 70, 80), (12, -8, 9), 40.0)
    for words in ({}, {"MemoryLimit": SMALL}):
        bake = simple.BakeDeformation(
            Input=simple.FreeFormDeformation(Input=reader, Strokes=strokes), **words)
        for kind, name in (("OMEZarrWriter", "failed.ome.zarr"), ("MedicalVolumeWriter", "no.nii")):
            path = target(name)
            problem, said = run(getattr(servermanager.writers, kind)(
                Input=bake, FileName=path, MemoryLimit=SMALL))
            assert problem, (kind, words)
            assert_says(said, "0/2/2/2")
            assert kind == "OMEZarrWriter" or not os.path.exists(path)


def test_a_stopped_file_is_no_file():
    name = target("stopped.nii")
    source = baked()
    own = source.GetClientSideObject()
    reports = []

    def stop(*_):
        reports.append(own.GetProgress())
        own.SetAbortExecute(1 if len(reports) >= 40 else 0)
    own.AddObserver("ProgressEvent", stop)
    problem, said = run(servermanager.writers.MedicalVolumeWriter(
        Input=source, FileName=name, MemoryLimit=SMALL))
    assert_says(said, "stopped.nii")
    assert problem and not os.path.exists(name), problem
    assert not [left for left in os.listdir(scratch("")) if "stopped.nii" in left]


run_tests(globals())
