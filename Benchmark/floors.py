# SPDX-License-Identifier: BSD-3-Clause
"""Holds the floors on four volumes: speed beside ParaView's Volume, and the error of pictures.

An error is the root mean square difference from the same side's own picture at a step of 1/16
voxel, over the pixels of the object, as a fraction of full scale, at 256x256. Each side is bent or
not as in the other comparisons. "At equal error" divides stock's time at the step where its error
is that of ours at our default step by our time there. Stock's error over its step is a line through
logarithms, and its time is a part that stays and one that grows with the number of samples.

The error of occlusion is that of what it takes from the picture: the picture without it minus the
picture with it, at our step and at 1/16 voxel.
"""

import math

import numpy
from measure import Side, interleaved
from scene import OCCLUSION, OPACITIES, Scene
from volumes import all_volumes

STEPS = (1.0, 0.5, 0.25)  # voxels
FINEST = 1.0 / 16.0
ERROR_WINDOW = 256  # pixels: pictures at 1/16 voxel take long
OURS, STOCK, OWN = "ours", "stock", "own"
OWN_STEP = 0.5  # voxels, by its times: for the name of the row, since it is not set


def rms(left, right, where):
    return float(numpy.sqrt(((left - right)[where] ** 2).mean()))


def time_at(error, errors, times):
    """Stock's time for an error. `errors`: {step: error}; `times`: {step: time} of two steps."""
    slope, shift = numpy.polyfit(numpy.log(list(errors)), numpy.log(list(errors.values())), 1)
    step = math.exp((math.log(error) - shift) / slope)
    (coarse, first), (fine, second) = sorted(times.items(), reverse=True)
    growing = (second - first) / (1.0 / fine - 1.0 / coarse)
    return first + growing * (1.0 / step - 1.0 / coarse)


class Floors:
    """The measurements of one volume; each becomes a row of the table."""

    def __init__(self, name, scene, report, options):
        self.name, self.scene, self.report, self.options = name, scene, report, options
        self.voxel = float(scene.spacing.min())
        self.about = {"volume": name, "dimensions": scene.dimensions, "lattice": scene.lattice,
                      "voxels": int(numpy.prod(scene.dimensions))}

    def _set(self, side, step):
        self.scene.show(side)
        if side == OURS:
            self.scene.ours.SampleDistance = step * self.voxel
        elif side == STOCK:
            self.scene.volumes[STOCK].GetMapper().SetSampleDistance(step * self.voxel)

    def _side(self, side, step, warm):
        def prepare():
            self._set(side, step)
            if side == OURS:
                self.scene.frame()  # not timed: it makes a row of the colour map

        return Side(f"{side}, step {step:g}", self.scene.frame, prepare, warm)

    def _row(self, key, value, quiet=None, window=None):
        self.report.target(key, value, quiet, window, self.name)

    def speeds(self, opacities, window):
        """Rows at equal and at default steps. Returns processor times by side and step."""
        self.scene.use(opacities, window)
        warm = window == self.options.windows[0]  # then all is compiled
        wanted = [(OURS, 0.5), (STOCK, 0.5), (STOCK, 1.0), (OWN, OWN_STEP)]
        rows = self.report.group(
            f"{self.name}, {opacities}", f"{self.name}, {opacities}, {window}x{window}",
            {**self.about, "window": window},
            interleaved([self._side(*side, warm) for side in wanted], self.options.rounds,
                        self.options.seconds))
        rows = {side: rows[f"{side[0]}, step {side[1]:g}"] for side in wanted}
        ours = rows[OURS, 0.5]
        for key, theirs in (("frame", (STOCK, 0.5)), ("coarse", (STOCK, 1.0)),
                            ("own", (OWN, OWN_STEP))):
            self._row(f"{key} {opacities}", *(rows[theirs][time] / ours[time]
                                              for time in ("median", "quiet")), window=window)
        return rows

    def _picture(self, side, step, darkness=0.0):
        self._set(side, step)
        self.scene.ours.AmbientOcclusion = darkness
        picture = self.scene.picture()
        self.scene.ours.AmbientOcclusion = 0.0
        return picture

    def errors(self, opacities, times):
        """Rows of errors, and of speed at equal error; `times` from speeds()."""
        window = self.options.windows[0]
        self.scene.use(opacities, ERROR_WINDOW)
        error, pictures = {}, {}
        for side in (OURS, STOCK):
            fine = pictures[side, FINEST] = self._picture(side, FINEST)
            where = fine.max(axis=2) > 0.02
            for step in STEPS:
                pictures[side, step] = self._picture(side, step)
                error[side, step] = rms(pictures[side, step], fine, where)
        self.report.fact(f"error of the picture, {self.name}, {opacities}: " + "; ".join(
            f"{side} " + ", ".join(f"{error[side, step]:.4f} at {step:g}" for step in STEPS)
            for side in (OURS, STOCK)), volume=self.name, opacities=opacities,
            errors=[[side, step, value] for (side, step), value in error.items()])
        self._row(f"error {opacities}", error[OURS, 0.5] / error[STOCK, 0.5])
        errors = {step: error[STOCK, step] for step in STEPS}
        ratios = [time_at(error[OURS, 0.5], errors,
                          {step: times[STOCK, step][clock] for step in (1.0, 0.5)}) /
                  times[OURS, 0.5][clock] for clock in ("median", "quiet")]
        self._row(f"equal error {opacities}", *ratios, window=window)
        self._occlusion(opacities, pictures, error[OURS, 0.5])

    def _occlusion(self, opacities, pictures, error):
        taken = {step: pictures[OURS, step] - self._picture(OURS, step, OCCLUSION)
                 for step in (0.5, FINEST)}
        where = pictures[OURS, FINEST].max(axis=2) > 0.02
        own = rms(taken[0.5], taken[FINEST], where)
        self.report.fact(f"error of occlusion alone, {self.name}, {opacities}: {own:.4f}",
                         volume=self.name, opacities=opacities, occlusion=own)
        self._row(f"occlusion {opacities}", own / max(error, 1e-6))

    def edits(self):
        window = self.options.windows[0]
        self._set(OURS, 0.5)
        self.scene.use("opaque", window)

        def run():
            self.scene.edit()
            self.scene.frame()

        side = Side("ours", run)
        row = self.report.group(f"{self.name}, edit", f"{self.name}, edit to picture, opaque",
                                {**self.about, "window": window},
                                interleaved([side], self.options.rounds, self.options.seconds))
        self._row("edit", row["ours"]["median"], row["ours"]["quiet"], window)


def measure_floors(report_of, options):
    """Measures each volume; `report_of(window)` makes the report once a window is there."""
    report = None
    for name, make in all_volumes(0.25 if options.quick else 1.0, options.volumes).items():
        volume = make()
        scene = Scene(volume.image.GetDimensions(), 19, volume)
        report = report or report_of(scene.window)
        report.case("{}: {} x {} x {} voxels".format(name, *scene.dimensions))
        floors = Floors(name, scene, report, options)
        floors.edits()
        for opacities in OPACITIES:
            times = [floors.speeds(opacities, window) for window in options.windows]
            floors.errors(opacities, times[0])
        scene.close()
    report.targets()
    report.worst()
    return report
