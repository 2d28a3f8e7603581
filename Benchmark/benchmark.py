# SPDX-License-Identifier: BSD-3-Clause
"""Measures BrainShift beside ParaView's own volume rendering, both in one process.

    ./brainshift bench [--quick] [--sizes 128 256 512] [--lattices 9 19 37] [--windows 512 1024]
                       [--repetitions 5]

Prints a table and writes bench-output/benchmark.json and a plot. The reference case is the sample
MRI on 256x256x150 voxels of 1 mm, uint8, a 19x19x19 lattice, 4 samples, one stamp of 20 mm.

What makes it fair
- One view, one camera, one window, one headlight: all sides are drawn by the same vtkRenderer.
- One vtkVolumeProperty (colours, opacities, shading) is shared by ours and every pinned stock
  volume. ParaView's own representation has a property of its own, set alike.
- One step. ParaView's "Volume" adjusts its sample distance and does not expose it, so "stock" is
  VTK's GPU mapper, which ParaView's representation uses inside, put into the same renderer with
  automatic adjustment, the lock to the spacing and jitter switched off, at our half-voxel step.
  "ParaView's Volume" is the representation as a user gets it. Both are measured.
- The headlight is the one light under which VTK's mapper turns normals rightly (ARCHITECTURE.md).
- The pictures are compared, and their mean difference is printed.
- Sides are run in turn, round by round, so that other work on the machine hits all of them. A
  time ends when OpenGL has finished, not when it was asked.
- Ours draws the bent volume; stock draws the volume as loaded, or bent by vtkImageReslice with
  vtkBSplineTransform, or bent by Bake Deformation beforehand. ParaView holds vtkImageReslice to one
  thread; here it gets as many as llvmpipe, so a user of ParaView waits longer than shown.

"CPU" is the processor time of all threads, "quiet" the same divided by the number of rendering
threads: about what the clock would show on a quiet machine, where llvmpipe does the work and spreads
it evenly. What runs on one thread needs up to all of "CPU". Where a GPU draws both mean nothing.
"""

import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import numpy  # noqa: E402
from measure import Side, interleaved  # noqa: E402
from report import Report, header  # noqa: E402
from scene import OPACITIES, SAMPLES, Scene, load_plugin, mean_difference  # noqa: E402

load_plugin()
import brainshift  # noqa: E402 after the plugin

REFERENCE = (256, 256, 150)
NORMALS = ("Full resolution", "Half resolution", "On the fly")


class Benchmark:
    """The comparisons for one scene."""

    def __init__(self, scene, report, repetitions):
        self.scene, self.report, self.repetitions = scene, report, repetitions
        self.about = {"dimensions": scene.dimensions, "voxels": int(numpy.prod(scene.dimensions)),
                      "lattice": scene.lattice}

    def _measure(self, title, window, sides):
        self.report.group(title, {**self.about, "window": window},
                          interleaved(sides, self.repetitions))

    def _shown(self, text, name, **properties):
        """A side that draws one steady frame; properties are those of our representation."""

        def prepare():
            for key, value in properties.items():
                setattr(self.scene.ours, key, value)
            self.scene.show(name)
            if properties:
                self.scene.frame()  # what the property changes is made anew in a frame not timed

        return Side(text, self.scene.frame, prepare)

    def memory(self):
        """Computed from the formats of the textures, for the offset field over the lattice alone
        (tissue that leaves the box adds to it); drivers do not tell."""
        voxels, points = self.about["voxels"], self.scene.lattice
        nodes = (points - 1) * (SAMPLES + 1) + 1
        passes = nodes * points ** 2 + nodes ** 2 * points + 2 * nodes ** 3
        parts = {"gradients": 8 * voxels, "field": 16 * passes, "visibility": voxels // 2}
        share = sum(parts.values()) / (4 * voxels)
        text = ", ".join(f"{name} {size / 2 ** 20:.1f} MiB" for name, size in parts.items())
        self.report.fact(f"GPU memory beyond the scalars, computed: {text}; {share:.2f} times the "
                         "volume as float", share=share, **parts)

    def frames(self, opacities, window, everything):
        self.scene.use(opacities, window)
        sides = [self._shown("ours, bent", "ours"),
                 self._shown("stock, same step, as loaded", "stock")]
        if everything:
            sides += [self._shown("ParaView's Volume, its own step, as loaded", "own"),
                      self._shown("stock, same step, baked beforehand", "stock baked")]
        self._measure(f"steady frame, {opacities}, {window}x{window}", window, sides)

    def skipping(self, opacities, window):
        self.scene.use(opacities, window)
        sides = [self._shown("ours, skipping on", "ours", EmptySpaceSkipping=1),
                 self._shown("ours, skipping off", "ours", EmptySpaceSkipping=0)]
        self._measure(f"skipping, {opacities}, {window}x{window}", window, sides)
        self.scene.ours.EmptySpaceSkipping = 0
        without = self.scene.picture()
        self.scene.ours.EmptySpaceSkipping = 1
        differing = int((self.scene.picture() != without).any(axis=2).sum())
        self.report.fact(f"pixels that differ with skipping on and off: {differing}",
                         differing=differing)

    def normals(self, opacities, window):
        self.scene.use(opacities, window)
        sides = [self._shown(f"ours, normals: {mode.lower()}", "ours", VolumeNormalTexture=mode)
                 for mode in NORMALS]
        self._measure(f"normals, {opacities}, {window}x{window}", window, sides)
        self.scene.ours.VolumeNormalTexture = NORMALS[0]

    def pictures(self, opacities, window):
        """How alike the sides' pictures are, or the times would compare different work."""
        scene = self.scene
        scene.use(opacities, window)
        drawn = {}
        for name in ("ours", "own", "stock", "stock baked"):
            scene.show(name)
            drawn[name] = scene.picture()
        scene.bent.Strength = 0.0
        scene.show("ours")
        drawn["ours, as loaded"] = scene.picture()
        scene.bent.Strength = 1.0
        for left, right in (("ours, as loaded", "stock"), ("ours", "stock baked"),
                            ("own", "stock")):
            difference = mean_difference(drawn[left], drawn[right])
            self.report.fact(f"mean difference of {left} from {right}, {opacities}: "
                             f"{100 * difference:.2f} % of full scale", difference=difference)

    def edits(self, window):
        """From a changed stroke to the picture; the stock way resamples, uploads and draws."""
        scene = self.scene
        scene.use("opaque", window)
        counted = {}

        def ours():
            before = brainshift.counters(scene.ours)
            scene.edit()
            scene.frame()
            after = brainshift.counters(scene.ours)
            counted.update({name: after[name] - before[name] for name in after})

        def dragging():
            scene.edit()
            scene.view.SMProxy.InteractiveRender()
            scene.window.WaitForCompletion()

        def stock():
            scene.edit_coefficients()
            scene.frame()

        sides = [Side("ours, full quality", ours, lambda: scene.show("ours")),
                 Side("ours, as while dragging", dragging, lambda: scene.show("ours")),
                 Side("vtkImageReslice, vtkBSplineTransform, upload, stock", stock,
                      lambda: scene.show("stock resliced"))]
        self._measure(f"edit to picture, opaque, {window}x{window}", window, sides)
        self.report.fact("one edit: " + ", ".join(f"{name} {number}"
                                                  for name, number in counted.items()), **counted)

    def resampling(self, window):
        """A picture of 32x32 costs next to nothing to draw: what is left is all but the rays."""
        scene = self.scene
        scene.use("opaque", 32)

        def edit_and_filter():
            scene.edit()
            scene.bent.UpdatePipeline()

        def edit_and_frame():
            scene.edit()
            scene.frame()

        sides = [Side("ours: stroke, lattice (filter alone)", edit_and_filter),
                 Side("ours: the same, fields, presence, 32x32 picture", edit_and_frame,
                      lambda: scene.show("ours"))]
        self._measure("edit, all but the rays", window, sides)
        sides = [Side("Bake Deformation", scene.bake.UpdatePipeline, edit_and_filter),
                 Side("vtkImageReslice, vtkBSplineTransform", scene.reslice.Update,
                      scene.edit_coefficients)]
        self._measure("bake", window, sides)


def parse():
    parser = argparse.ArgumentParser(prog="brainshift bench",
                                     description="Measures BrainShift beside ParaView's own.")
    parser.add_argument("--quick", action="store_true",
                        help="the reference case only, 512x512, two rounds: a minute or two")
    parser.add_argument("--sizes", type=int, nargs="*", metavar="N",
                        help="volumes of N voxels along each side (128 256 512)")
    parser.add_argument("--lattices", type=int, nargs="*", metavar="N",
                        help="control points along each side (9 19 37)")
    parser.add_argument("--windows", type=int, nargs="+", metavar="PIXELS",
                        help="edges of the picture (512 1024)")
    parser.add_argument("--repetitions", type=int, metavar="N", help="rounds (5)")
    options = parser.parse_args()
    quick = options.quick
    for name, usual, few in (("sizes", [128, 256, 512], []), ("lattices", [9, 19, 37], []),
                             ("windows", [512, 1024], [512]), ("repetitions", 5, 2)):
        if getattr(options, name) is None:
            setattr(options, name, few if quick else usual)
    if options.repetitions < 1:
        parser.error(f"--repetitions is {options.repetitions}; it must be at least 1")
    for name, least in (("sizes", 16), ("lattices", 4), ("windows", 32)):
        for value in getattr(options, name):
            if value < least:
                parser.error(f"--{name} has {value}; it must be at least {least}")
    return options


def reference(benchmark, windows, everything):
    benchmark.memory()
    for opacities in OPACITIES:
        benchmark.pictures(opacities, windows[0] if everything else 256)
    for window in windows:
        for opacities in OPACITIES:
            benchmark.frames(opacities, window, everything or opacities == "opaque")
        benchmark.edits(window)
    benchmark.resampling(windows[0])
    benchmark.skipping("opaque", windows[0])
    benchmark.normals("opaque", windows[0])
    if everything:
        benchmark.skipping("translucent", windows[0])
        benchmark.normals("translucent", windows[0])


def main():
    options = parse()
    report = None
    cases = [(REFERENCE, 19)] + [((size,) * 3, 19) for size in options.sizes] + [
        (REFERENCE, lattice) for lattice in options.lattices if lattice != 19]
    for number, (dimensions, lattice) in enumerate(cases):
        scene = Scene(dimensions, lattice)
        report = report or Report(header(scene.window))
        report.case("{} x {} x {} voxels, lattice {}^3".format(*dimensions, lattice))
        benchmark = Benchmark(scene, report, options.repetitions)
        if number == 0:
            reference(benchmark, options.windows, not options.quick)
        else:
            benchmark.memory()
            for opacities in OPACITIES:
                benchmark.frames(opacities, options.windows[0], False)
            benchmark.edits(options.windows[0])
            benchmark.resampling(options.windows[0])
        scene.close()
    report.write("bench-output")


if __name__ == "__main__":
    main()
