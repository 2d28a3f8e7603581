# SPDX-License-Identifier: BSD-3-Clause
# Proves that the script of the documentation's pictures draws every picture that it knows, small
# here, and that those pages show are among them, of the size they promise.
import os
import sys
import tempfile

import numpy
from PIL import Image

CHECKOUT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(CHECKOUT, "Examples"))
import documentation_pictures as script  # noqa: E402

SMALL = 240  # pixels of a picture's width
LEAST_CONTRAST = 10.0  # standard deviation of the brightness, of 255
FROM_THE_WINDOW = {  # in the folder "window"
    "case",  # by hand: the dock after Measure, with the sample head and points on its cortex
    "stamp-strip", "window",  # Examples/stamp_strip.py, Examples/demo.py
    "tool-pointer",  # by hand: the dock beside a brain, with a server of poses
    "tool-pull",  # by hand, while the third pull is dragged
    "refine",  # by hand, paused at the fifth step, with the case study's volumes
    "first-bend-head", "first-bend-brain", "first-bend-bent"}  # by hand, as first-bend.md says
LARGEST_BYTES, LARGEST_WIDTH = 200_000, 900


def brightness(file):
    return numpy.asarray(Image.open(file).convert("L"), float)


def test_each_picture_is_drawn_and_not_flat():
    with tempfile.TemporaryDirectory(dir=os.environ["BRAINSHIFT_TEST_TEMP"]) as folder:
        script.draw(folder, script.SCENES, SMALL)
        for name in script.SCENES:
            picture = brightness(os.path.join(folder, f"{name}.png"))
            assert picture.shape[1] == SMALL, (name, picture.shape)
            assert picture.std() > LEAST_CONTRAST, (name, picture.std())
            halves = picture[:, :SMALL // 3], picture[:, -SMALL // 3:]
            assert all(half.std() > LEAST_CONTRAST / 2 for half in halves), name


def test_the_pages_pictures_are_those_and_small():
    pictures = os.path.join(CHECKOUT, "Documentation", "pictures")

    def stored(folder):
        return {os.path.splitext(name)[0] for name in os.listdir(folder) if name.endswith(".png")}
    assert stored(pictures) == set(script.SCENES), stored(pictures) ^ set(script.SCENES)
    of_window = stored(os.path.join(pictures, "window"))
    assert of_window == FROM_THE_WINDOW, of_window ^ FROM_THE_WINDOW
    for name in script.SCENES:
        file = os.path.join(pictures, f"{name}.png")
        assert os.path.getsize(file) <= LARGEST_BYTES, (name, os.path.getsize(file))
        assert brightness(file).shape[1] <= LARGEST_WIDTH, name


test_the_pages_pictures_are_those_and_small()
test_each_picture_is_drawn_and_not_flat()
