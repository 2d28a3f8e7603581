# SPDX-License-Identifier: BSD-3-Clause
"""Lists how fast BrainShift must be: for each quantity a floor that must hold, and a goal."""

import dataclasses


@dataclasses.dataclass
class Target:
    quantity: str
    against: str
    unit: str
    least: float  #: the floor
    goal: float
    small_is_good: bool = False

    def margin(self, value):
        """How many times better than the floor; below 1: missed."""
        ratio = value / self.least
        return 1.0 / max(ratio, 1e-9) if self.small_is_good else ratio

    def verdict(self, value):
        sign = -1 if self.small_is_good else 1
        if sign * value >= sign * self.goal:
            return "goal"
        return "yes" if sign * value >= sign * self.least else "NO"


STOCK = "stock Volume as loaded, same step"
EQUAL = "stock Volume as loaded, at the step where its error is ours"
COARSE = "stock Volume as loaded, a step of a voxel"
OWN = "ParaView's Volume as loaded, as it draws a still picture"
RESLICE = "vtkImageReslice, vtkBSplineTransform, upload, stock Volume"

#: By the key that measurements are reported with, in the order of the table.
TARGETS = {
    "frame opaque": Target("steady frame, opaque", STOCK, "x", 4, 10),
    "frame translucent": Target("steady frame, translucent", STOCK, "x", 2.5, 6),
    "coarse opaque": Target("steady frame, opaque", COARSE, "x", 2, 5),
    "coarse translucent": Target("steady frame, translucent", COARSE, "x", 1.3, 3),
    "edit": Target("edit to picture, full quality", "a hand", "ms", 120, 40, small_is_good=True),
    "edit occluded": Target("the same with ambient occlusion", "a hand", "ms", 120, 40,
                            small_is_good=True),
    "edit ratio": Target("edit to picture, full quality", RESLICE, "x", 15, 40),
    "drag": Target("edit to picture while dragging", "an eye", "/s", 15, 30),
    "curve": Target("opacity curve dragged", "an eye", "/s", 15, 30),
    "first": Target("first picture of delivered voxels", "-", "s", 1, 0.5, small_is_good=True),
    "bake": Target("bake", "vtkImageReslice, vtkBSplineTransform", "x", 5, 15),
    "field": Target("lattice to offset field, all of it", "-", "ms", 10, 3, small_is_good=True),
    "fit landmarks": Target("fit, 16 landmarks", "-", "ms", 5, 2, small_is_good=True),
    "fit pulls": Target("fit, one of 30 pulls moved", "a hand", "ms", 30, 15, small_is_good=True),
    "fit traces": Target("fit, 300 traces and 250 anchors", "-", "ms", 100, 50,
                         small_is_good=True),
    "fit live": Target("fit, a pull beside 300 traces", "a hand", "ms", 30, 15, small_is_good=True),
    "fit many traces": Target("fit, 10 000 traces", "-", "ms", 300, 150, small_is_good=True),
    "memory": Target("GPU memory beyond the scalars", "the volume as float", "x", 2, 1,
                     small_is_good=True),
    "skipping": Target("pixels that skipping changes", "no skipping", "", 0, 0,
                       small_is_good=True),
}

#: Of floors.py alone, on several volumes; the rows of the table above that it measures count, too.
OF_VOLUMES = {
    "own opaque": Target("steady frame, opaque", OWN, "x", 2, 5),
    "own translucent": Target("steady frame, translucent", OWN, "x", 1.3, 3),
    "error opaque": Target("error beside stock's, same step, opaque", "stock's error", "x", 1, 0.5,
                           small_is_good=True),
    "error translucent": Target("error beside stock's, same step, translucent", "stock's error",
                                "x", 1, 0.5, small_is_good=True),
    "equal error opaque": Target("steady frame at equal error, opaque", EQUAL, "x", 4, 10),
    "equal error translucent": Target("steady frame at equal error, translucent", EQUAL, "x", 2.5,
                                      6),
    "occlusion opaque": Target("error of occlusion alone, opaque", "the picture's error", "x", 0.2,
                               0.1, small_is_good=True),
    "occlusion translucent": Target("error of occlusion alone, translucent",
                                    "the picture's error", "x", 0.2, 0.1, small_is_good=True),
}

#: Of large.py alone.
OF_STORES = {
    "large first": Target("store: first picture", "-", "s", 3, 1.5, small_is_good=True),
    "large detail": Target("store: all detail of a view", "-", "s", 10, 4, small_is_good=True),
    "large edit": Target("store: a stroke to a still picture", "a head that fits, as loaded", "x",
                         1.5, 1, small_is_good=True),
    "large drag": Target("store: a stroke to a picture while dragging", "an eye", "/s", 15, 30),
    "large memory": Target("store: resident memory beyond the limit", "-", "GiB", 1, 0.5,
                           small_is_good=True),
}
