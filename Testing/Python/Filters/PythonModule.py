# SPDX-License-Identifier: BSD-3-Clause
# Proves that the module brainshift writes strokes as documented, and that errors name what is
# wrong with an argument.
import math

import brainshift
from brainshift_testing import run_tests


def expect_refused(words, function, *arguments, **named):
    try:
        function(*arguments, **named)
    except ValueError as error:
        for word in words:
            assert word in str(error), (word, str(error))
    else:
        raise AssertionError(f"{function.__name__} accepts {arguments} {named}")


def test_strokes_are_fourteen_numbers():
    assert brainshift.move((1, 2, 3), (4, 5, 6)) == (
        0, 1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 0.5, 1)
    assert brainshift.move((1, 2, 3), (4, 5, 6), spacing=(7, 8, 9)) == (
        0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 0, 0.5, 1)
    assert brainshift.soft((1, 2, 3), (4, 5, 6), 20, sigma=0.3) == (
        1, 1, 2, 3, 4, 5, 6, 0, 0, 0, 20, 0, 0.3, 1)
    assert brainshift.NUMBERS_PER_STROKE == 14


def test_stamp_pulls_away_from_the_point_of_interest():
    stroke = brainshift.stamp((0, 0, 10), (0, 0, 0), 5, major=40, minor=20, sigma=0.4)
    assert stroke == (2, 0, 0, 10, 0, 0, 5, 0, 0, -1, 40, 20, 0.4, 1)
    push = brainshift.stamp((0, 0, 10), (0, 0, 0), -5)
    assert push[4:7] == (0, 0, -5)
    slanted = brainshift.stamp((3, 4, 0), (0, 0, 0), 10)
    assert all(math.isclose(a, b, abs_tol=1e-12) for a, b in zip(slanted[4:7], (6, 8, 0)))


def test_bad_arguments_are_named():
    expect_refused(["anchor", "2 numbers", "3"], brainshift.move, (1, 2), (0, 0, 1))
    expect_refused(["vector", "finite"], brainshift.move, (1, 2, 3), (0, 0, math.nan))
    expect_refused(["radius", "-5", "above 0 mm"], brainshift.soft, (1, 2, 3), (0, 0, 1), -5)
    expect_refused(["sigma", "0.0", "at least 0.001"],
                   brainshift.soft, (1, 2, 3), (0, 0, 1), 5, sigma=0)
    expect_refused(["major", "inf"], brainshift.stamp, (1, 2, 3), (0, 0, 0), 5, major=math.inf)
    expect_refused(["minor", "0.0"], brainshift.stamp, (1, 2, 3), (0, 0, 0), 5, minor=0)
    expect_refused(["toward", "differ"], brainshift.stamp, (1, 2, 3), (1, 2, 3), 5)
    expect_refused(["amount"], brainshift.stamp, (1, 2, 3), (0, 0, 0), math.nan)


run_tests(globals())
