# SPDX-License-Identifier: BSD-3-Clause
# Proves that Deformed Slices on 2, 4 and 8 MPI ranks of pvbatch, and on a pvserver of 2, are the
# pictures of one process, with the tissue that it finds under its pixels, although each rank has
# only the voxels of its part.
import numpy
from brainshift_testing import load_plugin, on_server, run_tests, scratch, server_finds_plugin

load_plugin()
import ranks_slices_testing  # noqa: E402 after the plugin
from ranks_testing import MPI, batch, largest  # noqa: E402

FOLDER = scratch("ranks_slices")
SERVER_FINDS_PLUGIN = server_finds_plugin()
# Levels of 255. Opaque planes are the same but for rounding of places in textures of other sizes;
# blended ones are rounded on each rank; those that volumes are blended with are volumes' affair.
LARGEST_OPAQUE, LARGEST_BLENDED, LARGEST_OF_VOLUMES = 1, 3, 12
LARGEST_FACT = 1e-6  # mm, or a voxel's unit


def expected_answers():
    """The answers of one process, and their names by question."""
    answers, names = {}, {}
    for question in dict.fromkeys(sum(ranks_slices_testing.QUESTIONS.values(), ())):
        found = {}
        question(found)
        names[question] = set(found)
        answers.update(found)
    return answers, names


EXPECTED, NAMES = expected_answers()


def levels_of(name):
    return (LARGEST_OF_VOLUMES if name.startswith(("scene", "beside")) else
            LARGEST_BLENDED if name.startswith("blended") else LARGEST_OPAQUE)


def assert_same(found, road):
    names = set().union(*(NAMES[question] for question in ranks_slices_testing.QUESTIONS[road]))
    assert set(found) == names, set(found) ^ names
    levels, numbers = {}, {}
    for name in found:
        if EXPECTED[name].ndim == 3:
            levels[name] = round(255 * largest(found[name], EXPECTED[name]))
        elif not name.startswith("bytes"):  # they are of one rank
            numbers[name] = largest(found[name], EXPECTED[name])
    print({name: level for name, level in levels.items() if level}, flush=True)
    print({name: number for name, number in numbers.items() if number}, flush=True)
    assert all(level <= levels_of(name) for name, level in levels.items()), levels
    assert all(number <= LARGEST_FACT for number in numbers.values()), numbers


def answers_of_batch(ranks):
    found, said = batch(ranks, FOLDER, ranks_slices_testing.__file__,
                        [line.format(ranks) for line in ranks_slices_testing.REFUSALS])
    sentence = f"The first of {ranks} MPI ranks holds and draws the whole volume: "
    reasons = {line.partition(sentence)[2].rstrip(". ") for line in said.splitlines()
               if sentence in line}
    asks = ranks_slices_testing.answer_whole in ranks_slices_testing.QUESTIONS[ranks]
    assert reasons <= set(ranks_slices_testing.REASONS), reasons
    assert (ranks_slices_testing.REASONS[1] in reasons) == asks, reasons
    assert found["bytes one refuses"] == EXPECTED["bytes one refuses"]
    return found


def test_one_process_has_something_to_compare():
    for name, numbers in EXPECTED.items():
        if numbers.ndim == 3:
            assert (numbers.max(axis=2) > 0.02).mean() > 0.03, name
    seen = EXPECTED["planes facts"][:, 3]
    assert 0.2 < seen.mean() < 0.9, seen.mean()
    assert EXPECTED["uploads"][0] == 1, "a stroke sends no voxels"


def test_two_ranks_of_pvbatch():
    found = answers_of_batch(2)
    assert_same(found, 2)
    for name, most in (("unbent", 0.73), ("none refuses", 0.6)):
        share = found[f"bytes {name}"][0] / EXPECTED[f"bytes {name}"][0]
        assert 0.5 < share < most, (name, share)


def test_four_ranks_of_pvbatch():
    found = answers_of_batch(4)
    assert_same(found, 4)
    for name, most in (("unbent", 0.55), ("bent", 0.75), ("none refuses", 0.36)):
        share = found[f"bytes {name}"][0] / EXPECTED[f"bytes {name}"][0]
        print(name, "share of the first rank", share, flush=True)
        assert 0.2 < share < most, (name, share)


def test_eight_ranks_of_pvbatch():
    found, _ = batch(8, FOLDER, ranks_slices_testing.__file__)
    assert_same(found, 8)
    share = found["bytes unbent"][0] / EXPECTED["bytes unbent"][0]
    assert 0.1 < share < 0.4, share


def test_a_server_of_two_ranks():
    answers = on_server(lambda: ranks_slices_testing.answers("server"), launcher=[*MPI, "2"],
                        **SERVER_FINDS_PLUGIN)
    assert_same(answers, "server")


run_tests(globals())
