# SPDX-License-Identifier: BSD-3-Clause
# Proves that the pictures of 2, 4 and 8 MPI ranks of pvbatch and of a pvserver of 4 differ from
# those of one process by no more than those of ParaView's "Volume" do, each map and camera by
# itself: of tissue bent by 0, 8 and 30 mm, along oblique axes, with surfaces inside, before, behind
# and beside it; and that segments, a cavity, a tumour and evidence are drawn in parts as one
# process does.
import numpy
from brainshift_testing import load_plugin, on_server, run_tests, scratch, server_finds_plugin

load_plugin()
import ranks_drawing_testing  # noqa: E402 after the plugin
from ranks_testing import MPI, batch, largest  # noqa: E402

SERVER_FINDS_PLUGIN = server_finds_plugin()
# Levels of 255: what is right whatever "Volume" does, for each rank's bytes are rounded; and what
# is wrong whatever it does.
RIGHT, WRONG = 4, 12
EXPECTED = ranks_drawing_testing.answers()
BENT = [name for name in EXPECTED if name.startswith(tuple(ranks_drawing_testing.BENDS))]


def stock_of(name):
    """The picture of "Volume" that shows the same."""
    for bend in ranks_drawing_testing.BENDS:
        name = name.replace(bend, "stock")
    return name if name.startswith("stock") else "stock " + name


def assert_same(found):
    assert set(found) == set(EXPECTED), set(found) ^ set(EXPECTED)
    levels = {name: int(numpy.rint(255 * largest(found[name], EXPECTED[name])))
              for name in found}
    print(levels, flush=True)
    for name, level in levels.items():
        if not name.startswith("stock"):
            own = levels.get(stock_of(name), WRONG)
            assert level <= numpy.clip(own, RIGHT, WRONG), (name, level, own)


def test_one_process_has_something_to_compare():
    assert all(stock_of(name) in EXPECTED for name in BENT), BENT
    for name, pixels in EXPECTED.items():
        assert (pixels.max(axis=2) > 0.02).mean() > 0.04, name
    for one, other in (("0 mm opaque", "8 mm opaque"), ("8 mm opaque", "30 mm opaque"),
                       ("8 mm opaque", "with balls opaque"), ("evidence", "no evidence")):
        changed = (abs(EXPECTED[one] - EXPECTED[other]).max(axis=2) > 0.1).mean()
        assert changed > 0.005, (one, other, changed)


def of_batch(ranks):
    found, said = batch(ranks, scratch("ranks_drawing"), ranks_drawing_testing.__file__)
    assert "draws the whole volume" not in said, said
    assert_same(found)


def test_two_ranks_of_pvbatch():
    of_batch(2)


def test_four_ranks_of_pvbatch():
    of_batch(4)


def test_eight_ranks_of_pvbatch():
    of_batch(8)


def test_a_server_of_four_ranks():
    assert_same(on_server(ranks_drawing_testing.answers, launcher=[*MPI, "4"],
                          **SERVER_FINDS_PLUGIN))


run_tests(globals())
