# SPDX-License-Identifier: BSD-3-Clause
# Proves that two drivers draw the same: each feature as llvmpipe draws it and as zink does, which
# hands the same shaders as SPIR-V to a driver of Vulkan (lavapipe), with empty-space skipping and
# without. Both compute pixels by one library, so pictures are equal to the bit.
import os
import subprocess

import numpy
from brainshift_testing import load_plugin, object_pixels, run_tests, scratch

load_plugin()
import drivers_testing  # noqa: E402 after the plugin

# Mesa 26 chooses its driver by the last variable, earlier ones by the second.
DRIVERS = {"llvmpipe": {"GALLIUM_DRIVER": "llvmpipe"},
           "zink": {"GALLIUM_DRIVER": "zink", "MESA_LOADER_DRIVER_OVERRIDE": "zink"}}
LEAST = 0.03  # of the pixels show the object


def begun(driver):
    """A process that draws all pictures with a driver, and the file that it writes."""
    name = scratch(f"{driver}.npz")
    inherited = {key: value for key, value in os.environ.items()
                 if key not in ("GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE")}
    return name, subprocess.Popen(
        [os.environ["BRAINSHIFT_PVPYTHON"], drivers_testing.__file__, name],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        env={**inherited, "LIBGL_ALWAYS_SOFTWARE": "1", **DRIVERS[driver]})


def pictures_of_both():
    found = {}
    for driver, (name, process) in {driver: begun(driver) for driver in DRIVERS}.items():
        said = process.communicate()[0]
        assert process.returncode == 0, (driver, process.returncode, said)
        errors = [line for line in said.splitlines() if "ERR|" in line or "WARN|" in line]
        assert not errors, (driver, errors)
        with numpy.load(name) as saved:
            found[driver] = dict(saved)
    return found


PICTURES = pictures_of_both()


def test_each_driver_is_the_one_asked_for():
    for driver, found in PICTURES.items():
        name = str(found.pop("driver"))
        print(f"  {driver}: {name}", flush=True)
        assert name.startswith(driver), f"asked for {driver}, drawn by {name}"


def test_pictures_show_something():
    for name, image in PICTURES["llvmpipe"].items():
        share = object_pixels(image / 255.0).mean()
        assert share > LEAST, (name, share)


def test_both_drivers_draw_the_same():
    expected = PICTURES["llvmpipe"]
    found = PICTURES["zink"]
    assert set(found) == set(expected), set(found) ^ set(expected)
    differing = {name: int((found[name] != image).any(axis=2).sum())
                 for name, image in expected.items()}
    differing = {name: pixels for name, pixels in differing.items() if pixels}
    print(f"  {len(expected)} pictures, different: {differing}", flush=True)
    assert not differing, differing


def test_skipping_changes_nothing():
    for driver, found in PICTURES.items():
        for name, image in found.items():
            plain = found.get(name + drivers_testing.UNSKIPPED)
            assert plain is None or numpy.array_equal(image, plain), (driver, name)


run_tests(globals())
