# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases of one kind inside pvpython, for fuzz.py: worker.py KIND SEED FIRST END FOLDER.

It prints a line before and after each case, so that fuzz.py knows which one ended or blocked it.
"""

import random
import sys

from brainshift_testing import load_plugin

KINDS = {"files": "file_cases", "dicom": "dicom_cases", "frames": "frame_cases",
         "like": "like_cases", "properties": "property_cases", "fields": "field_cases",
         "points": "point_cases", "surfaces": "surface_cases", "transforms": "transform_cases"}


def main(kind, seed, first, end, folder):
    load_plugin()
    cases = __import__(KINDS[kind]).Cases(folder)
    for number in range(int(first), int(end)):
        print(f"case {number}", flush=True)
        result = cases.run(random.Random(f"{kind} {seed} {number}"))
        print(f"done {number} {result}", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
