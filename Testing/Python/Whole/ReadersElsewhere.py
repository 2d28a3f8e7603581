# SPDX-License-Identifier: BSD-3-Clause
# Proves that what reads volumes, series, fields, transforms and landmarks gives the same on a
# pvserver, on one of 2 ranks, and on 2 and 3 ranks of pvbatch, as in one process: each voxel once,
# each point once, series to choose, files written once, and errors that end on all ranks.
import os

import nibabel
import numpy
from brainshift_testing import (assert_says, load_plugin, messages, on_server, run_tests, scratch,
                                server_finds_plugin)

load_plugin()
import readers_testing  # noqa: E402 after the plugin
from ranks_testing import MPI, batch  # noqa: E402

FOLDER = readers_testing.write_files(scratch("readers"))
NEAR = 2e-4  # mm: places are rounded to 1e-5, and FreeSurfer has float32


def here():
    return readers_testing.answers(FOLDER)


def refusals():
    with messages():
        return readers_testing.refusals(FOLDER)


EXPECTED = here()


def assert_same(found):
    assert set(found) == set(EXPECTED), set(found) ^ set(EXPECTED)
    for name, expected in EXPECTED.items():
        assert found[name].shape == expected.shape, (name, found[name].shape, expected.shape)
        difference = numpy.abs(found[name] - expected).max() if expected.size else 0.0
        assert difference < NEAR, (name, difference)


def assert_refused(refused):
    points, sentences = refused
    assert points == [0] * len(points), points
    for sentence in sentences:
        assert_says(sentence, "missing", "does not exist")


def test_one_process_reads_what_others_wrote():
    image = nibabel.load(os.path.join(FOLDER, "volume.nii"))
    index = numpy.indices(image.shape).reshape(3, -1).T
    places = index @ image.affine[:3, :3].T + image.affine[:3, 3]
    known = numpy.c_[places, numpy.asarray(image.dataobj).reshape(-1, 1)]
    known = known[numpy.argsort(known[:, 3])]
    names = [name for name in EXPECTED if name.startswith(("volume.", "written "))
             and not name.endswith("told")]
    assert len(names) == 9, names
    for name in names:
        found = EXPECTED[name][numpy.argsort(EXPECTED[name][:, 3])]
        assert numpy.abs(found - known).max() < 1e-3, name
    assert EXPECTED["landmarks"] == 32 and EXPECTED["times"].tolist() == [0.0, 10.0]
    assert EXPECTED["later"][:, 3].min() == 500 and EXPECTED["other series"][:, 3].min() == 2000
    assert numpy.abs(EXPECTED["mapped"] - readers_testing.POINTS).max() > 1.0
    assert EXPECTED["stopped"]
    assert EXPECTED["files of the series"] == nibabel.as_closest_canonical(image).shape[2]
    assert_refused(refusals())


def test_ranks_of_pvbatch():
    for ranks in (2, 3):
        found, said = batch(ranks, FOLDER, readers_testing.__file__,
                            expected=["entry '0/"])
        assert_same(found)
        assert said.count("sheared.nrrd is sheared") == 1, "the first rank speaks for all"


def read_and_refused():
    return here(), refusals()


def test_a_server():
    found, refused = on_server(read_and_refused, **server_finds_plugin())
    assert_same(found)
    assert_refused(refused)


def test_a_server_of_two_ranks():
    found, refused = on_server(
        read_and_refused, launcher=[*MPI, "2"], **server_finds_plugin())
    assert_same(found)
    assert_refused(refused)


run_tests(globals())
