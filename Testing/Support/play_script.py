# SPDX-License-Identifier: BSD-3-Clause
"""ParaView's window runs this file as its script. It runs BRAINSHIFT_TEST_SCRIPT, and ends the
window if that cannot begin, for example at an import: the window would wait for ever."""

import os
import runpy
import traceback

try:
    runpy.run_path(os.environ["BRAINSHIFT_TEST_SCRIPT"], run_name="__main__")
except BaseException:
    traceback.print_exc()
    os._exit(1)
