# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of the documentation from the head of the test data.

    ./brainshift python Examples/documentation_pictures.py FOLDER [--width PIXELS] [NAME…]

Without names it draws all of them. The scenes are in the folder `pictures` beside this file.
Research software, not a medical device.
"""

import argparse
import os
import sys
import time

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "pictures"))
import stage  # noqa: E402
from scenes_of_comparisons import COMPARISON_SCENES  # noqa: E402
from scenes_of_fields import FIELD_SCENES  # noqa: E402
from scenes_of_tools import TOOL_SCENES  # noqa: E402
from scenes_of_volumes import VOLUME_SCENES  # noqa: E402

SCENES = {**TOOL_SCENES, **VOLUME_SCENES, **FIELD_SCENES, **COMPARISON_SCENES}
WIDTH = 900  # pixels of a whole picture


def draw(folder, names, width):
    """Writes the pictures of these names into the folder, NAME.png each."""
    os.makedirs(folder, exist_ok=True)
    for name in names:
        start = time.monotonic()
        file = os.path.join(folder, f"{name}.png")
        stage.write(SCENES[name](width), file)
        stage.clear()
        print(f"{file}: {os.path.getsize(file) / 1000:.0f} kB, {time.monotonic() - start:.1f} s",
              flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(SCENES))
    parser.add_argument("--width", type=int, default=WIDTH)
    arguments = parser.parse_args()
    unknown = set(arguments.names) - set(SCENES)
    if unknown:
        parser.error(f"there are no pictures {', '.join(sorted(unknown))}")
    draw(arguments.folder, arguments.names or SCENES, arguments.width)


if __name__ == "__main__":
    main()
