# SPDX-License-Identifier: BSD-3-Clause
# Proves that pvbatch on 2, 4 and 8 MPI ranks, and a pvserver of 2, give the numbers, pictures
# and picks of one process: filters to 1e-6, pictures to no more than ParaView's "Volume" differs.
import os

import numpy
from brainshift_testing import load_plugin, on_server, run_tests, scratch, server_finds_plugin
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
from paraview.simple import OpenDataFile  # noqa: E402 after the plugin
from ranks_testing import MPI, answers, answers_of_batch, batch, largest  # noqa: E402

FOLDER = scratch("ranks")
SERVER_FINDS_PLUGIN = server_finds_plugin()
LARGEST_NUMBER = 1e-6  # mm, or a voxel's unit
# mm, a voxel. A rank finds the surface of translucent tissue where its own part hides one half, not
# knowing what other ranks have before it.
LARGEST_PICK = 1.0
LARGEST_OF_TWO = 12 / 255  # of pictures of two volumes
LARGEST_OF_REFERENCE = 6 / 255  # 18 if samples began where a rank's part does


def files_of(folder):
    """All numbers of the images in a folder, whole, by file and array."""
    found = {}
    for name in ("bake", "field", "inverse"):
        image = OpenDataFile(os.path.join(folder, name + ".pvti"))
        image.UpdatePipeline()
        data = image.GetClientSideObject().GetOutputDataObject(0)
        for i in range(data.GetPointData().GetNumberOfArrays()):
            array = data.GetPointData().GetArray(i)
            found[f"{name} {array.GetName()}"] = vtk_to_numpy(array).astype(float)
    found["bake.nii"] = numpy.fromfile(os.path.join(folder, "bake.nii"), numpy.float32, offset=352)
    assert len(found["bake.nii"]) == 25 ** 3, "the first rank writes all of it"
    return found


def folder_of(ranks):
    return os.path.join(FOLDER, str(ranks))


def expected_answers():
    os.makedirs(folder_of(1), exist_ok=True)
    return answers(folder_of(1))


def assert_refused(found):
    """The first rank draws for one that refuses; the picture stays if the first refuses, too."""
    assert found["bytes one refuses"] == EXPECTED["bytes one refuses"]
    assert found["bytes none refuses"] < 0.8 * EXPECTED["bytes none refuses"]
    assert found["picture of a refused stroke"] == 0.0


EXPECTED = expected_answers()
EXPECTED_FILES = files_of(folder_of(1))


def assert_same(found, expected=EXPECTED):
    assert set(found) == set(expected), set(found) ^ set(expected)
    stock = numpy.max([largest(found[name], EXPECTED[name]) for name in ("stock", "stock large")])
    differences = {name: largest(numbers, EXPECTED[name]) for name, numbers in found.items()}
    print(differences, flush=True)
    for name, difference in differences.items():
        if name.startswith("bytes"):
            continue  # they are of one rank
        is_pick = name.startswith("volume") and name.endswith("picks")
        if name == "stock two":
            continue  # what "Volume" makes of two is its own affair
        of_picture = (LARGEST_OF_TWO if name.startswith("two") else
                      LARGEST_OF_REFERENCE if name.startswith("large reference") else stock)
        limit = (of_picture if EXPECTED[name].ndim == 3 else
                 LARGEST_PICK if is_pick else LARGEST_NUMBER)
        assert difference <= limit, (name, difference, limit)


def assert_same_files(folder):
    found = files_of(folder)
    assert set(found) == set(EXPECTED_FILES), set(found)
    for name, numbers in found.items():
        difference = largest(numbers, EXPECTED_FILES[name])
        assert difference <= LARGEST_NUMBER, (name, difference)


def test_one_process_has_something_to_compare():
    for name, numbers in EXPECTED.items():
        if numbers.ndim == 3:
            assert (numbers.max(axis=2) > 0.02).mean() > 0.1, name
    for name in ("volume picks", "slices picks"):
        seen = ~numpy.isnan(EXPECTED[name]).any(axis=1)
        assert seen.tolist() == [True, True, True, False], (name, EXPECTED[name])
    assert (EXPECTED["volume"] != EXPECTED["volume after a stroke"]).any()
    for name in ("letters not known", "letters"):
        assert (EXPECTED[name] != EXPECTED["no letters"]).any(), name
    assert EXPECTED["uploads"].tolist() == [1, 2], "a stroke sends no voxels"
    assert EXPECTED["bytes in memory unbent"] == 61 ** 3 * 4, EXPECTED["bytes in memory unbent"]


def test_two_ranks_of_pvbatch():
    found = answers_of_batch(2, folder_of(2))
    assert_same(found)
    assert_refused(found)
    assert_same_files(folder_of(2))


def test_four_ranks_of_pvbatch():
    found = answers_of_batch(4, folder_of(4))
    assert_same(found)
    assert_refused(found)
    assert_same_files(folder_of(4))
    # Not as before: boxes of equal work are others for other opacities.
    assert found["bytes again"] < EXPECTED["bytes again"], "the whole volume is given back"
    # A quarter, and 10 mm of 60 beyond. The bytes of a reference count images, too.
    for name, most in (("unbent", 0.55), ("bent", 0.75), ("reference", 0.65),
                       ("reference, moved", 0.65), ("reference, far", 0.65)):
        share = found[f"bytes {name}"][0] / EXPECTED[f"bytes {name}"][0]
        print(name, "share of the first rank", share, flush=True)
        assert 0.2 < share < most, (name, share)
    for name in ("unbent", "bent", "far"):
        assert_no_more_in_memory(found, name)


def assert_no_more_in_memory(found, name):
    """Memory has what the card has: the rank's part of ParaView's pipeline is within it."""
    memory, card = (found[f"bytes {where}{name}"][0] / EXPECTED[f"bytes {where}{name}"][0]
                    for where in ("in memory ", ""))
    print(name, "in memory", memory, "on the card", card, flush=True)
    assert 0.2 < memory < card + 0.01, (name, memory, card)


def test_eight_ranks_of_pvbatch():
    """The boxes of eight ranks are cut along all three axes."""
    found, _ = batch(8, folder_of(8))
    assert_same(found, {name: numbers for name, numbers in EXPECTED.items() if name in found})
    assert_same_files(folder_of(8))
    assert found["bytes unbent"][0] < 0.4 * EXPECTED["bytes unbent"][0], found["bytes unbent"]
    assert_no_more_in_memory(found, "unbent")


def test_a_server_of_two_ranks():
    of_both = {name for name in EXPECTED if "refuse" not in name and "fail" not in name}
    assert_same(on_server(answers, launcher=[*MPI, "2"], **SERVER_FINDS_PLUGIN), of_both)


run_tests(globals())
