# SPDX-License-Identifier: BSD-3-Clause
"""Measures BrainShift and ParaView's own volume rendering in one process.

    ./brainshift bench [--quick] [--sizes 128 256 512] [--lattices 9 19 37] [--windows 512 1024]
                       [--rounds 5] [--seconds 15]
    ./brainshift bench --volumes [FILE ...]  floors on four volumes (floors.py), and on real files
    ./brainshift bench --large [X Y Z]   a store that is drawn in bricks (large.py)
    ./brainshift bench --ranks [N ...]   what each of several ranks holds and draws (ranks.py)
    ./brainshift bench --ultrasound      errors of Refine by ultrasound instead (ultrasound.py)

It prints tables and writes bench-output/benchmark.json and a plot. The last table shows the floors
and goals of targets.py. The reference case is the sample MRI on 256x256x150 voxels of 1 mm, uint8,
with a 19x19x19 lattice, 4 samples and one stamp of 20 mm.

What makes the comparison fair:
- There is one view, one camera, one window and one headlight. One vtkRenderer draws all sides.
- Our volume and every pinned stock volume share one vtkVolumeProperty (colours, opacities,
  shading). ParaView's own representation has a property of its own with the same values.
- All sides take one step. ParaView's "Volume" adjusts its sample distance and does not expose it.
  So "stock" is VTK's GPU mapper, which that representation uses, in the same renderer, without
  automatic adjustment, lock to the spacing and jitter. It is measured at our step of half a voxel
  and at VTK's default step of one voxel. "ParaView's Volume" is the representation as users get it.
- The headlight is the one light under which VTK's mapper turns normals correctly.
- The pictures are compared, and their mean difference is printed.
- The sides run in turn, round by round, so other work on the machine affects all of them. A time
  ends when OpenGL has finished.
- Our side draws the bent volume. Stock draws the volume as it was loaded, or bent by
  vtkImageReslice with vtkBSplineTransform, or bent by Bake Deformation beforehand. ParaView runs
  vtkImageReslice on one thread. Here it gets as many threads as llvmpipe, so a user of ParaView
  waits longer than shown.
- GPU memory is what the driver says it gave each texture. The GPU itself measures the time of the
  offset field.

"CPU" is the processor time of all threads. "Quiet" is "CPU" divided by the number of rendering
threads. It approximates the time on a quiet machine, where llvmpipe spreads the work evenly. Work
of one thread takes up to all of "CPU". Neither means anything where a GPU draws. Targets are
compared with the time and with "quiet". On a busy machine, read "quiet".
"""

import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import drag  # noqa: E402
import numpy  # noqa: E402
from comparison import measure_comparison  # noqa: E402
from first import measure_first  # noqa: E402
from fits import measure_fits  # noqa: E402
from floors import measure_floors  # noqa: E402
from large import measure_large  # noqa: E402
from measure import Side, Times, interleaved  # noqa: E402
from ranks import measure_ranks, measure_scan  # noqa: E402
from report import Report, header  # noqa: E402
from scene import OCCLUSION, OPACITIES, Scene, load_plugin, mean_difference  # noqa: E402
from session import measure_session  # noqa: E402
from slices import measure_slices  # noqa: E402
from traces import measure_traces  # noqa: E402

load_plugin()
import brainshift  # noqa: E402 after the plugin

REFERENCE = (256, 256, 150)
NORMALS = ("Full resolution", "Half resolution", "On the fly")
OURS, SAME_STEP = "ours, bent", "stock, same step, as loaded"
COARSE = "stock, one-voxel step, as loaded"
TIMES_FOR_FIELD = 7  # times as many rounds, because times of some milliseconds vary most
FULL, DRAGGING = "ours, full quality", "ours, as while dragging"
OCCLUDED = "ours, full quality, ambient occlusion"
RESLICED = "vtkImageReslice, vtkBSplineTransform, upload, stock"
BAKE, RESLICE = "Bake Deformation", "vtkImageReslice, vtkBSplineTransform"
FILTER = "ours: stroke, lattice (filter alone)"
ALL_BUT_RAYS = "ours: the same, fields, presence, 32x32"
AFTER_A_STROKE, ALL_OF_IT = "ours, after a stroke", "ours, all of it"


def ratio_of(rows, ours, theirs):
    """How many times as fast ours is, by the clock and by processor time."""
    return (rows[theirs]["median"] / rows[ours]["median"],
            rows[theirs]["quiet"] / rows[ours]["quiet"])


class Benchmark:
    """The comparisons for one scene. `reference`: its measurements are held against the targets."""

    def __init__(self, scene, report, options, reference):
        self.scene, self.report, self.options = scene, report, options
        self.reference = reference
        self.about = {"dimensions": scene.dimensions, "voxels": int(numpy.prod(scene.dimensions)),
                      "lattice": scene.lattice}

    def _measure(self, kind, window, sides):
        return self.report.group(
            kind, f"{kind}, {window}x{window}", {**self.about, "window": window},
            interleaved(sides, self.options.rounds, self.options.seconds))

    def _target(self, key, value, quiet=None, window=None):
        if self.reference:
            self.report.target(key, value, quiet, window)

    def _shown(self, text, name, **properties):
        """A side that draws one steady frame; properties are those of our representation."""

        def prepare():
            for key, value in properties.items():
                setattr(self.scene.ours, key, value)
            self.scene.show(name)
            if properties:
                self.scene.frame()  # not timed: it computes what the property changes

        return Side(text, self.scene.frame, prepare)

    def memory(self, window):
        self.scene.use("opaque", window)
        self.scene.frame()
        gpu = brainshift.gpu(self.scene.ours)
        share = gpu["gpuOtherBytes"] / (4 * self.about["voxels"])
        self.report.fact(f"GPU memory: scalars {gpu['gpuScalarBytes'] / 2 ** 20:.1f} MiB, all else "
                         f"{gpu['gpuOtherBytes'] / 2 ** 20:.1f} MiB, {share:.2f} times the volume "
                         "as float", **self.about, share=share, scalars=gpu["gpuScalarBytes"],
                         others=gpu["gpuOtherBytes"])
        self._target("memory", share)

    def frames(self, opacities, window, everything):
        self.scene.use(opacities, window)
        sides = [self._shown(OURS, "ours"), self._shown(SAME_STEP, "stock")]
        if self.reference:
            sides += [self._shown(COARSE, "stock coarse")]
        if everything:
            sides += [self._shown("ParaView's Volume, its own step, as loaded", "own"),
                      self._shown("stock, same step, baked beforehand", "stock baked")]
        rows = self._measure(f"steady frame, {opacities}", window, sides)
        self._target(f"frame {opacities}", *ratio_of(rows, OURS, SAME_STEP), window=window)
        if self.reference:
            self._target(f"coarse {opacities}", *ratio_of(rows, OURS, COARSE), window=window)

    def skipping(self, window):
        differing = 0
        for opacities in OPACITIES:
            self.scene.use(opacities, window)
            sides = [self._shown("ours, skipping on", "ours", EmptySpaceSkipping=1),
                     self._shown("ours, skipping off", "ours", EmptySpaceSkipping=0)]
            self._measure(f"skipping, {opacities}", window, sides)
            self.scene.ours.EmptySpaceSkipping = 0
            without = self.scene.picture()
            self.scene.ours.EmptySpaceSkipping = 1
            differing += int((self.scene.picture() != without).any(axis=2).sum())
        self.report.fact(f"pixels that differ with skipping on and off: {differing}",
                         differing=differing)
        self._target("skipping", differing)

    def normals(self, opacities, window):
        self.scene.use(opacities, window)
        sides = [self._shown(f"ours, normals: {mode.lower()}", "ours", VolumeNormalTexture=mode)
                 for mode in NORMALS]
        self._measure(f"normals, {opacities}", window, sides)
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

        def ours():
            scene.edit()
            scene.frame()

        def dragging():
            scene.edit()
            scene.view.SMProxy.InteractiveRender()
            scene.window.WaitForCompletion()

        def stock():
            scene.edit_coefficients()
            scene.frame()

        sides = [self._with_occlusion(FULL, ours, 0.0),
                 self._with_occlusion(OCCLUDED, ours, OCCLUSION),
                 self._with_occlusion(DRAGGING, dragging, OCCLUSION),
                 Side(RESLICED, stock, lambda: scene.show("stock resliced"), warm=False)]
        rows = self._measure("edit to picture, opaque", window, sides)
        scene.ours.AmbientOcclusion = 0.0
        self._count_an_edit(ours, dragging)
        if window == self.options.windows[0]:
            for key, side in (("edit", FULL), ("edit occluded", OCCLUDED)):
                self._target(key, rows[side]["median"], rows[side]["quiet"], window)
        if window == self.options.windows[-1]:
            self._target("edit ratio", *ratio_of(rows, FULL, RESLICED), window=window)
            self._target("drag", *(1000.0 / max(rows[DRAGGING][time], 1e-9)
                                   for time in ("median", "quiet")), window=window)

    def _with_occlusion(self, text, work, darkness):
        def prepare():
            self.scene.ours.AmbientOcclusion = darkness
            self.scene.show("ours")

        return Side(text, work, prepare)

    def occlusion(self, window):
        """What ambient occlusion, which is on by default, adds to a whole picture."""
        for opacities in OPACITIES:
            self.scene.use(opacities, window)
            self._measure(f"steady frame, ambient occlusion, {opacities}", window,
                          [self._with_occlusion("off", self.scene.frame, 0.0),
                           self._with_occlusion("on", self.scene.frame, OCCLUSION)])
        self.scene.ours.AmbientOcclusion = 0.0

    def _count_an_edit(self, ours, dragging):
        self.scene.show("ours")
        before = brainshift.counters(self.scene.ours)
        ours()
        after = brainshift.counters(self.scene.ours)
        dragging()
        counted = {name: after[name] - before[name] for name in after
                   if name != "imageScale" and after[name] != before[name]}
        scale = brainshift.counters(self.scene.ours)["imageScale"]
        self.report.fact("one edit: " + ", ".join(f"{name} {number}"
                                                  for name, number in counted.items()) +
                         f"; while dragging {scale} pixels a side for one drawn",
                         imageScale=scale, **counted)

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

        self._measure("edit, all but the rays", window,
                      [Side(FILTER, edit_and_filter),
                       Side(ALL_BUT_RAYS, edit_and_frame, lambda: scene.show("ours"))])
        self._field(window, {AFTER_A_STROKE: scene.edit, ALL_OF_IT: scene.change_everything})
        scene.bent.Kernel = "Catmull-Rom"
        rows = self._measure("bake", window,
                             [Side(BAKE, scene.bake.UpdatePipeline, edit_and_filter),
                              Side(RESLICE, scene.reslice.Update, scene.edit_coefficients,
                                   warm=False)])
        self._target("bake", *ratio_of(rows, BAKE, RESLICE))

    def _field(self, window, changes):
        """From control points to offset field, by the GPU's clock."""
        times = {name: Times([], []) for name in changes}
        for _ in range(TIMES_FOR_FIELD * self.options.rounds + 1):
            for name, change in changes.items():
                change()
                self.scene.frame()
                milliseconds = brainshift.gpu(self.scene.ours)["gpuFieldMicroseconds"] / 1000.0
                times[name].wall.append(milliseconds)
        for of in times.values():
            del of.wall[0]  # the first one made textures and shaders
        rows = self.report.group("lattice to offset field", "lattice to offset field, GPU alone",
                                 {**self.about, "window": window}, times)
        self._target("field", rows[ALL_OF_IT]["median"])


def parse(arguments):
    parser = argparse.ArgumentParser(prog="brainshift bench",
                                     description="Measures BrainShift beside ParaView's own.")
    parser.add_argument("--quick", action="store_true",
                        help="the reference case only, 512x512, one round: about a minute")
    parser.add_argument("--volumes", nargs="*", metavar="FILE",
                        help="only the floors on four made volumes, and on these files")
    parser.add_argument("--large", type=int, nargs="*", metavar="N",
                        help="only a store of so many voxels, drawn in bricks (1024 1024 512)")
    parser.add_argument("--ranks", type=int, nargs="*", metavar="N",
                        help="only what several MPI ranks hold and draw (1 2 4 8)")
    parser.add_argument("--ranks-voxels", type=int, nargs=3, metavar="N", default=[512] * 3,
                        help="voxels of the volume that they draw (512 512 512)")
    parser.add_argument("--ranks-bits", type=int, choices=(8, 16), default=8)
    parser.add_argument("--ranks-packed", action="store_true", help="the head is a .nii.gz file")
    parser.add_argument("--ranks-scan", metavar="FILE", help="a scan that they draw in its place")
    parser.add_argument("--reference", type=int, nargs=3, metavar="N", default=REFERENCE,
                        help="voxels of the reference case (256 256 150)")
    parser.add_argument("--sizes", type=int, nargs="*", metavar="N",
                        help="volumes of N voxels along each side (128 256 512)")
    parser.add_argument("--lattices", type=int, nargs="*", metavar="N",
                        help="control points along each side (9 19 37)")
    parser.add_argument("--windows", type=int, nargs="+", metavar="PIXELS",
                        help="edges of the picture (512 1024)")
    parser.add_argument("--strokes", type=int, metavar="N",
                        help="strokes of the long session (10000)")
    parser.add_argument("--rounds", type=int, metavar="N", help="most rounds (5)")
    parser.add_argument("--seconds", type=float, metavar="S", default=15.0,
                        help="seconds after which slow sides run once or twice only (15)")
    parser.add_argument("--output", metavar="FOLDER", default="bench-output")
    options = parser.parse_args(arguments)
    quick = options.quick
    for name, usual, few in (("sizes", [128, 256, 512], []), ("lattices", [9, 19, 37], []),
                             ("windows", [512, 1024], [512]), ("strokes", 10000, 1000),
                             ("rounds", 5, 1)):
        if getattr(options, name) is None:
            setattr(options, name, few if quick else usual)
    if options.rounds < 1:
        parser.error(f"--rounds is {options.rounds}; it must be at least 1")
    if options.strokes < 10:
        parser.error(f"--strokes is {options.strokes}; it must be at least 10")
    if options.large is not None:
        options.large = options.large or [1024, 1024, 512]
        if len(options.large) != 3 or min(options.large) < 256:
            parser.error(f"--large is {options.large}; it must be three numbers from 256")
    for name, least in (("reference", 16), ("sizes", 16), ("lattices", 4), ("windows", 32)):
        for value in getattr(options, name):
            if value < least:
                parser.error(f"--{name} has {value}; it must be at least {least}")
    return options


def reference(benchmark, windows, quick):
    benchmark.memory(windows[0])
    for opacities in OPACITIES:
        benchmark.pictures(opacities, 256 if quick else windows[0])
    for window in windows:
        for opacities in OPACITIES:
            benchmark.frames(opacities, window, window == windows[0] and not quick)
        benchmark.edits(window)
    benchmark.occlusion(windows[0])
    benchmark.resampling(windows[0])
    benchmark.skipping(windows[0])
    for measure in (measure_first, measure_slices, measure_comparison, measure_traces,
                    measure_session, measure_fits):
        measure(benchmark.scene, benchmark.report, benchmark.options, benchmark.about)
    if not quick:
        for opacities in OPACITIES:
            benchmark.normals(opacities, windows[0])


def another_size(benchmark, window):
    benchmark.memory(window)
    for opacities in OPACITIES:
        benchmark.frames(opacities, window, False)
    benchmark.edits(window)
    benchmark.resampling(window)


def another_lattice(benchmark, window):
    benchmark.memory(window)
    benchmark.frames("opaque", window, False)
    benchmark.edits(window)
    benchmark.resampling(window)


def main(arguments=None):
    options = parse(arguments)
    if options.ranks is not None:
        options.ranks = options.ranks or [1, 2, 4, 8]
        measure_scan(options) if options.ranks_scan else measure_ranks(options)
        return
    if options.large is not None:
        measure_large(tuple(options.large), options)
        return
    if options.volumes is not None:
        measure_floors(lambda window: Report(header(window)), options).write(options.output)
        return
    dimensions = tuple(options.reference)
    cases = [(dimensions, 19, None)] + [((size,) * 3, 19, another_size) for size in options.sizes]
    cases += [(dimensions, lattice, another_lattice)
              for lattice in options.lattices if lattice != 19]
    report = None
    for dimensions, lattice, compare in cases:
        scene = Scene(dimensions, lattice)
        report = report or Report(header(scene.window))
        report.case("{} x {} x {} voxels, lattice {}^3".format(*dimensions, lattice))
        benchmark = Benchmark(scene, report, options, reference=compare is None)
        if compare:
            compare(benchmark, options.windows[0])
        else:
            reference(benchmark, options.windows, options.quick)
            drag.told(report, dimensions, options.windows, options.output)
            report.targets()
        scene.close()
    if len(cases) > 1:
        report.targets()
    report.write(options.output)


if __name__ == "__main__":
    if "--ultrasound" in sys.argv:
        from ultrasound import measure_ultrasound
        measure_ultrasound([word for word in sys.argv[1:] if word != "--ultrasound"])
    else:
        main()
