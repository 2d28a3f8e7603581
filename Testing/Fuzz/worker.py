# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases of one kind inside pvpython, for fuzz.py: worker.py KIND SEED FIRST END FOLDER [KEEP].

The cases are in KIND_cases.py. It prints a line before and after each case, so that fuzz.py knows
which one ended or blocked it. The files of each case are copied into the folder KEEP.
"""

import os
import random
import shutil
import sys

from brainshift_testing import load_plugin


def main(kind, seed, first, end, folder, keep=None):
    load_plugin()
    cases = __import__(f"{kind}_cases").Cases(folder)
    for number in range(int(first), int(end)):
        print(f"case {number}", flush=True)
        result = cases.run(random.Random(f"{kind} {seed} {number}"))
        print(f"done {number} {result}", flush=True)
        if keep:
            shutil.copytree(folder, os.path.join(keep, f"{kind}-{number}"), dirs_exist_ok=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
