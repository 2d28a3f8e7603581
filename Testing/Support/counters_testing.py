# SPDX-License-Identifier: BSD-3-Clause
"""What tests of the renderer's counters share. Import it after the plugin is loaded."""

import brainshift
from brainshift_testing import picture


class Counted:
    """What is on the screen (`image`), and what the renderer did for it since the last look."""

    def __init__(self, view, display):
        self.view, self.display = view, display
        self.image = picture(view)
        self.before = brainshift.counters(display)

    def did(self):
        """What a new picture took, without the frame itself."""
        self.image = picture(self.view)
        now = brainshift.counters(self.display)
        done = {name: now[name] - self.before[name] for name in now
                if now[name] != self.before[name]}
        self.before = now
        assert done.pop("frames") > 0
        done.pop("pixelsCast", 0)
        return done
