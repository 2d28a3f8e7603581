# SPDX-License-Identifier: BSD-3-Clause
# Proves what several MPI ranks do where one of them fails alone, lacks voxels, or bends the volume
# in another way: none waits for ever, the first rank reports one sentence, and the picture is that
# of one process or stays as it was. Scripts that hand data over say why a server gets none.
import os

import numpy
import ranks_fail_testing
from brainshift_testing import (assert_says, load_plugin, on_server, run_tests, scratch,
                                server_finds_plugin)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402
from ranks_testing import run_batch  # noqa: E402

FOLDER = scratch("ranks fail")
LARGEST = 12 / 255  # of a picture: boxes of ranks meet at other rounding
LONGEST = 240  # s, for a few questions; a rank that waits for another never ends


def asked(*names):
    """What two ranks answer, and one process."""
    os.makedirs(FOLDER, exist_ok=True)
    name = scratch("answers.npz")
    said = run_batch(2, ranks_fail_testing.__file__, name, FOLDER, *names, timeout=LONGEST)
    print(said, flush=True)
    with numpy.load(name) as saved:
        return dict(saved)


def alone(*names):
    found = {}
    for name in names:
        ranks_fail_testing.QUESTIONS[name](found)
    return found


def assert_says_once(text, sentence):
    assert str(text).count(sentence) == 1, (sentence, str(text))


def assert_picture(found, expected, name):
    assert (expected[name].max(axis=2) > 0.02).mean() > 0.05, name
    difference = numpy.abs(found[name] - expected[name]).max()
    print(name, difference, flush=True)
    assert difference <= LARGEST, (name, difference)


def test_what_one_rank_lacks_ends_on_all():
    found = asked("trace", "fit", "electrodes", "file")
    for name in ("trace input", "fit input", "electrodes", "of a file"):
        assert_says_once(found[name], "MPI rank 1 of 2: an input failed, and that rank reported")
    assert_says_once(found["trace cortex"], "MPI rank 1 of 2: The volume has no point array")
    assert_says_once(found["fit volume"], "MPI rank 1 of 2: The volume's spacing is 1e+30")
    for name in ("trace input", "trace cortex", "fit input", "fit volume"):
        assert not str(found[name + " mended"]), (name, found[name + " mended"])
    for name in ("trace input", "trace cortex"):
        before, after = found[name + " counts"]
        assert before == 0 and after > 20, (name, before, after)
    assert not str(found["fit input problem"]) and not str(found["fit volume problem"])
    assert found["file counts"] == 0


def test_a_large_file_that_is_unpacked_by_all_is_told_once():
    found = asked("packed")
    for name in ("large.nrrd", "large.nii.gz"):
        assert_says_once(found[name], f"{name}: each of 2 MPI ranks unpacks the file")
        assert found[name + " points"] == 512 * 512 * (513 + 1), "both ranks have one layer"


def test_the_first_rank_tells_what_others_draw_coarser():
    lines = [line for line in str(asked("card")["card"]).splitlines() if "drawn coarser" in line]
    assert ["MPI rank 1 of 2: The deformed" in line for line in lines] == [False, True], lines


def test_contacts_count_once():
    expected, found = alone("electrodes"), asked("electrodes")
    assert len(expected["contacts"]) == 20 and expected["contacts in all"][0] == 20
    for name in ("contacts", "contacts in all"):
        assert found[name].shape == expected[name].shape, (name, found[name].shape)
        assert numpy.abs(found[name] - expected[name]).max() < 1e-6, name


def test_ranks_that_bend_in_other_ways_keep_the_picture():
    found, expected = asked("unlike", "no_lattice"), alone("unlike", "no_lattice")
    for name in ("unlike", "no lattice"):
        assert_says_once(found[name], "The MPI ranks bend the volume in different ways")
    assert not str(found["alike again"]), found["alike again"]
    assert found["picture of ranks that are unlike"] == 0.0
    assert found["picture of ranks without a lattice"] == 0.0
    for name in ("alike again picture", "lattice of all"):
        assert_picture(found, expected, name)


def test_a_volume_that_comes_back_is_cut_as_the_other():
    found, expected = asked("hidden"), alone("hidden")
    for name in expected:
        assert_picture(found, expected, name)


def test_another_halo_tries_parts_of_all_volumes():
    found = asked("halo")
    refused, again = found["bytes refused and with another halo"]
    assert_says_once(found["halo"], "The first rank draws the whole volume")
    print(refused, again, flush=True)
    # One volume is all in the box of the first rank, the other one in that of the second.
    assert again.sum() < 0.8 * refused.sum(), (refused, again)


def test_steps_of_parts_are_those_of_the_whole():
    found, expected = asked("step"), alone("step")
    sentence = str(expected["step"]).partition("Sample Distance is")[2].partition("\n")[0]
    assert "a ray of 106 mm" in sentence, expected["step"]
    assert_says_once(found["step"], sentence)
    assert_picture(found, expected, "short step")


def test_a_rank_without_voxels_takes_part():
    found, expected = asked("empty"), alone("empty")
    for rank in (0, 1):
        assert_picture(found, expected, f"empty {rank} picture")
    assert numpy.abs(found["empty 1 refined"] - expected["empty 1 refined"]).max() < 1e-6
    assert_says(str(found["empty 0 refusal"]), "first MPI rank", "no voxels")


def test_a_segment_between_two_parts_counts_once():
    found, expected = asked("look"), alone("look")
    assert numpy.abs(found["look Brain"] - expected["look Brain"]).max() < 1e-6, found


def refused(call, kind):
    try:
        call()
    except kind as error:
        return str(error)
    raise AssertionError("nothing was raised")


def on_a_server():
    """What scripts say that would hand data over."""
    volume = simple.Wavelet(WholeExtent=[-10, 10] * 3)
    rows = [(4.0 * i - 8.0, 4.0 * j - 6.0, 8.0) for j in range(4) for i in range(5)]
    found = brainshift.electrodes(rows, volume, threshold=150.0)
    found.save(scratch("contacts.csv"))
    triangle = numpy.eye(3), [(0, 1, 2)]
    result = brainshift.resecting.Resection()
    return [refused(lambda: found.save(scratch("contacts.mrk.json")), OSError),
            refused(lambda: brainshift.electrodes(rows, triangle), ValueError),
            refused(lambda: result.save(scratch("map.nii")), OSError)]


def test_a_server_gets_no_data_from_here():
    for sentence, word in zip(on_server(on_a_server, **server_finds_plugin()),
                              ("Save another kind of file", "give a ParaView source",
                               "Disconnect from the server")):
        assert_says(sentence, "server", word)
    assert os.path.getsize(scratch("contacts.csv")) > 100


run_tests(globals())
