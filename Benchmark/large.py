# SPDX-License-Identifier: BSD-3-Clause
"""Measures a volume of which a view draws bricks: a store of the sample head, stretched over many
voxels with noise of 4 bits, so that it packs no better than a scan.

    ./brainshift bench --large [X Y Z]   # voxels; 1024 1024 512, which takes 1 GiB

Beside it, in the same run, stands what the same head takes with a quarter of the voxels a side,
which fits and is drawn as it is. The store is made anew, in the folder of the results, and removed.
The page "Large volumes" says what is drawn when; targets.py has the floors and goals.
"""

import os
import resource
import shutil
import struct
import time

import numpy
from measure import Side, interleaved, rendering_threads
from paraview import simple
from report import Report, header
from scene import AIR, ARRAY, COLORS, TOWARDS_EYE, image_of, sample_voxels, voxels_of
from vtkmodules.vtkImagingCore import vtkImageReslice

WINDOW, LATTICE = 512, 19
LONGEST_MM = 205.0
COARSER = 4       # voxels a side, of the small head
SLAB = 16         # slices at once
READ_MIB = 32.0   # of the level that is read whole
LIMIT_MIB = 2048  # of what is drawn


def slabs(size):
    """The stretched head, some slices [z, y, x] at a time: uint16."""
    head = sample_voxels("seg3d_mr_t1")[0]
    reslice = vtkImageReslice()
    reslice.SetInputData(image_of(head))
    reslice.SetOutputOrigin(0, 0, 0)
    reslice.SetOutputSpacing(*((old - 1) / (new - 1)
                               for old, new in zip(reversed(head.shape), size)))
    reslice.SetInterpolationModeToLinear()
    noise = numpy.random.default_rng(41)
    for z in range(0, size[2], SLAB):
        reslice.SetOutputExtent(0, size[0] - 1, 0, size[1] - 1, z, min(z + SLAB, size[2]) - 1)
        reslice.Update()
        voxels = 16.0 * voxels_of(reslice.GetOutput())
        yield (voxels + noise.integers(0, 16, voxels.shape)).astype("uint16")


def write_file(name, size, spacing, number=2):
    """As NIfTI-1, of 1 or 2 bytes a number."""
    begin = bytearray(352)
    struct.pack_into("<i", begin, 0, 348)
    struct.pack_into("<8h", begin, 40, 3, *size, 1, 1, 1, 1)
    struct.pack_into("<2h", begin, 70, 512 if number == 2 else 2, 8 * number)  # without a sign
    struct.pack_into("<8f", begin, 76, 1, *spacing, 0, 0, 0, 0)
    struct.pack_into("<3f", begin, 108, 352, 1, 0)               # begin of the voxels, slope
    begin[123] = 2                                               # mm
    struct.pack_into("<h", begin, 254, 1)                        # the matrix is the scanner's
    for row in range(3):
        struct.pack_into("<4f", begin, 280 + 16 * row,
                         *(spacing[row] * (row == column) for column in range(3)), 0)
    begin[344:348] = b"n+1\0"
    with open(name, "wb") as file:
        file.write(begin)
        for slab in slabs(size):
            file.write((slab if number == 2 else (slab >> 4).astype("uint8")).tobytes())


def small_head(size, spacing):
    """A source of the head with fewer voxels, at the same place."""
    few = [side // COARSER for side in size]
    voxels = numpy.concatenate(list(slabs(few)))
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(image_of(voxels, [COARSER * mm for mm in spacing]))
    return source


class Head:
    """A bent head in a view of its own."""

    def __init__(self, source, size, spacing, scale=16):
        self.middle = numpy.array(size) * spacing / 2
        self.edits = self.turns = 0
        self.bent = simple.FreeFormDeformation(Input=source, LatticeDimensions=[LATTICE] * 3)
        self.edit()
        self.view = view = simple.CreateView("RenderView")
        view.ViewSize = [WINDOW, WINDOW]
        view.UseColorPaletteForBackground = 0
        view.OrientationAxesVisibility = view.CenterAxesVisibility = view.UseFXAA = 0
        view.LODThreshold = 1e6
        towards = numpy.array(TOWARDS_EYE) / numpy.linalg.norm(TOWARDS_EYE)
        view.CameraFocalPoint = list(self.middle)
        view.CameraPosition = list(self.middle + 2.6 * LONGEST_MM * towards)
        view.CameraViewUp = [0, 0, 1]
        self.display = simple.Show(self.bent, view, "UniformGridRepresentation")
        self.display.SetRepresentationType("Deformed Volume")
        simple.ColorBy(self.display, ("POINTS", ARRAY), separate=True)
        self.display.SetScalarBarVisibility(view, False)
        colors = simple.GetColorTransferFunction(ARRAY, self.display, separate=True)
        colors.ColorSpace = "RGB"
        colors.RGBPoints = [scale * value if i % 4 == 0 else value
                            for i, value in enumerate(COLORS)]
        self.opacities = simple.GetOpacityTransferFunction(ARRAY, self.display, separate=True)
        self.opacities.Points = [0, 0, 0.5, 0, scale * AIR, 0, 0.5, 0, 3 * scale * AIR, 1, 0.5, 0,
                                 256 * scale, 1, 0.5, 0]
        self.display.MemoryLimit = LIMIT_MIB

    def edit(self):
        import brainshift
        self.edits += 1
        top = self.middle + (0, 0, 0.35 * LONGEST_MM)
        self.bent.Strokes = brainshift.soft(tuple(top), (0, 0, -8.0 + 0.1 * self.edits), 50.0)

    def turn(self):
        """The camera moves by a degree, there and back."""
        self.turns += 1
        self.view.GetActiveCamera().Azimuth(1.0 if self.turns % 2 else -1.0)

    def draw(self, moving=False):
        self.view.UseFXAA = 0  # a new view turns it on, for all
        self.view.SMProxy.InteractiveRender() if moving else self.view.SMProxy.StillRender()
        self.view.GetClientSideObject().GetRenderWindow().WaitForCompletion()


def resident():
    """GiB of memory that this process has now; Linux tells."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize() / 2 ** 30


def spent(work):
    """Seconds that passed, and of all threads of this process; the result of the work."""
    wall, processor = time.perf_counter(), time.process_time()
    result = work()
    return time.perf_counter() - wall, time.process_time() - processor, result


def side(name, head, before, moving):
    def run():
        before(head)
        head.draw(moving)
    return Side(name, run)


def measure_large(size, options):
    """Makes, draws and edits the store; writes the results."""
    import brainshift
    spacing = [LONGEST_MM / max(size)] * 3
    folder = os.path.join(options.output, "large")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    small = Head(small_head(size, spacing), size, spacing)
    small.draw()
    report = Report(header(small.view.GetRenderWindow()))
    words = " x ".join(map(str, size))
    report.case(f"{words} voxels of 16 bits, {WINDOW}x{WINDOW} pixels")
    name = os.path.join(folder, "head.nii")
    write_file(name, size, spacing)
    store = os.path.join(folder, "head.ome.zarr")
    wall, processor, _ = spent(lambda: brainshift.pyramid(name, store))
    report.fact(f"the store is made in {wall:.1f} s, {processor:.1f} s of processor time")
    os.remove(name)
    begin = resident()

    def first():
        reader = simple.OMEZarrReader(FileName=store, MemoryLimit=READ_MIB)
        head = Head(reader, size, spacing)
        head.draw()
        return head
    wall, processor, head = spent(first)
    quiet = processor / rendering_threads()
    report.fact(f"first picture {wall:.2f} s, {processor:.2f} s of processor time")
    report.target("large first", wall, quiet)
    frames = brainshift.counters(head.display)["frames"]
    wall, processor, state = spent(lambda: brainshift.draw_detail(head.view, head.display, 600))
    frames = brainshift.counters(head.display)["frames"] - frames
    report.fact(f"all detail {wall:.1f} s, {processor:.1f} s of processor time, in {frames} "
                f"pictures: {state['gpuBricks']} bricks of level {state['gpuLevel']}")
    report.target("large detail", wall, processor / rendering_threads())
    rows = {}
    about = {"dimensions": list(size), "voxels": int(numpy.prod(size)), "lattice": LATTICE,
             "window": WINDOW}
    for kind, before, moving in (("a stroke", Head.edit, False),
                                 ("a stroke under the hand", Head.edit, True),
                                 ("another camera", Head.turn, False)):
        rows[kind] = report.group(
            f"large, {kind}", f"{kind}, {WINDOW}x{WINDOW}", about,
            interleaved([side(words, head, before, moving),
                         side("a quarter of the voxels a side", small, before, moving)],
                        options.rounds, options.seconds))
    ours, other = rows["a stroke"].values()
    report.target("large edit", ours["median"] / other["median"],
                  ours["quiet"] / other["quiet"])
    moving = next(iter(rows["a stroke under the hand"].values()))
    report.target("large drag", 1000.0 / moving["median"], 1000.0 / moving["quiet"])
    end = resident()
    report.fact(f"resident memory {end:.2f} GiB, {begin:.2f} before the first picture")
    report.target("large memory", end - LIMIT_MIB / 1024)
    report.targets()
    report.write(options.output)
    shutil.rmtree(folder)
