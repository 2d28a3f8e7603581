# SPDX-License-Identifier: BSD-3-Clause
# Proves that DICOM files that are made to harm, each by a pattern of faults of other readers, are
# refused with a sentence that names the file, or read as if the pattern were not there.
import os
import random

from brainshift_testing import load_plugin, run_tests
from dicom_testing import folder
from hostile_files import PASSED_OVER, REFUSED, outcome, same_numbers

load_plugin()


def written(pattern, seed):
    path = os.path.join(folder("hostile"), "image.dcm")
    data = pattern(random.Random(seed), path)
    with open(path, "wb") as file:
        file.write(data)
    return path


def test_each_pattern_is_refused():
    for pattern in REFUSED:
        for seed in range(1 if "bomb" in pattern.__name__ else 8):
            path = written(pattern, seed)
            numbers, said = outcome(path)
            assert numbers is None and path in said, (pattern.__name__, seed, said)
        sentence = next(line for line in said.splitlines() if path in line)
        print(f"{pattern.__name__}: {sentence}")


def test_others_change_no_number():
    for pattern in PASSED_OVER:
        for seed in range(8):
            path = written(pattern, seed)
            numbers, said = outcome(path)
            isSame = numbers is not None and same_numbers(path, numbers)
            assert isSame, (pattern.__name__, seed, said)


run_tests(globals())
