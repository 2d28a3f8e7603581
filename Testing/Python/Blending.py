# SPDX-License-Identifier: BSD-3-Clause
# Proves that each blend mode shows of a bent volume what ParaView's "Volume" shows of the baked one
# in the same mode, and the same bit for bit with empty-space skipping and without.
import numpy
from brainshift_testing import (Messages, assert_same_with_skipping, assert_says, ball, load_plugin,
                                mean_difference, messages, mirrored, new_lattice, object_pixels,
                                picture, run_tests, scattered, show_volume, use_headlight,
                                view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import BakeDeformation, Delete, FreeFormDeformation  # noqa: E402
