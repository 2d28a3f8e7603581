# SPDX-License-Identifier: BSD-3-Clause
"""Measures what each of several MPI ranks holds and computes while they draw parts of a bent head.

    ./brainshift bench --ranks [N ...]   # 1 2 4 8
                       [--ranks-voxels X Y Z]   # 512 512 512
                       [--ranks-bits 8|16]      # 8
                       [--ranks-packed]         # .nii.gz
    ./brainshift bench --ranks [N ...] --ranks-scan FILE   # a scan, by its looks, and no more

The head of large.py lies in a NIfTI file. Of a raw one, a rank reads the voxels of its part alone.
Each rank gets one thread for drawing. MPI spins while it waits, so that the processor time of a
process says nothing:

- Drawing is the processor time of the thread that draws (llvmpipe's), mean of 12 directions.
- Exchange is the time of ParaView's Timer Log for voxels that a stroke beyond RankHalo sends, and
  reading the time for ParaView's part of the file: what ranks would wait for if each asked its
  reader for the voxels that it lacks.
- Compositing is a picture in which every rank covers all pixels with next to no samples: the time
  that passed, times the cores that were busy, by ranks. It holds all that is not drawing.

A rank runs this file with pvbatch --sym and writes what it found beside the volume.
"""

import json
import os
import shutil
import subprocess
import sys
import time

DIRECTIONS = 12
WITHIN, BEYOND = 8.0, 30.0  # mm of strokes: of RankHalo, 10 mm, and farther
DEEP = 30.0                 # mm below the top of a scan, where it is bent
FAR_APART = 1000.0          # mm between two samples: next to none
MPI = [os.environ.get("BRAINSHIFT_MPIEXEC", "mpirun"), "--oversubscribe", "--allow-run-as-root",
       "-np"]


def threads_that_draw():
    """Processor time (s) of llvmpipe's threads of this process; Linux tells."""
    total = 0
    for thread in os.listdir("/proc/self/task"):
        folder = f"/proc/self/task/{thread}"
        with open(folder + "/comm", encoding="ascii") as name:
            draws = name.read().startswith("llvmpipe")
        if draws:
            with open(folder + "/schedstat", encoding="ascii") as file:
                total += int(file.read().split()[0])
    return total / 1e9


def most_resident():
    """MiB that this process had at most."""
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmHWM")) / 1024


def held(head):
    """What the display of this rank holds, and how often its voxels were sent to the card."""
    import brainshift
    head.draw()
    gpu, counters = brainshift.gpu(head.display), brainshift.counters(head.display)
    return {"scalars": gpu["gpuScalarBytes"], "coarser": gpu["gpuVoxelsPerTexel"],
            "memory": counters["voxelBytes"], "uploads": counters["volumeUploads"]}


def seconds_of_frames(head):
    """Drawing, and all that passed, of a mean picture around the head."""
    draws, wall = threads_that_draw(), time.perf_counter()
    for _ in range(DIRECTIONS):
        head.view.GetActiveCamera().Azimuth(360.0 / DIRECTIONS)
        head.draw()
    return ((threads_that_draw() - draws) / DIRECTIONS,
            (time.perf_counter() - wall) / DIRECTIONS)


def seconds_of_reading(head):
    """Of this rank's part of the file, once more."""
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    ranks = vtkMultiProcessController.GetGlobalController()
    reader = head.bent.Input.GetClientSideObject()
    reader.Modified()
    begin = time.perf_counter()
    reader.UpdatePiece(ranks.GetLocalProcessId(), ranks.GetNumberOfProcesses(), 0)
    return time.perf_counter() - begin


def seconds_of_exchanges():
    """That this rank logged since it began."""
    from vtkmodules.vtkCommonSystem import vtkTimerLog
    logged = [(vtkTimerLog.GetEventString(i), vtkTimerLog.GetEventWallTime(i))
              for i in range(vtkTimerLog.GetNumberOfEvents())]
    times = [wall for name, wall in logged if name == "Exchange voxels between MPI ranks"]
    return sum(end - begin for begin, end in zip(times[0::2], times[1::2]))


def measured(head, maps):
    """What one rank finds; all of them run it."""
    import brainshift
    found = {"begin": held(head)}
    middle = tuple(head.middle)  # where parts meet
    for name, mm in (("within", WITHIN), ("beyond", BEYOND)):
        head.bent.Strokes = brainshift.soft(middle, (-mm / 3 ** 0.5,) * 3, 50.0)
        before = seconds_of_exchanges()
        found[name] = held(head)
        found[name]["seconds"] = seconds_of_exchanges() - before
    found["resident"] = most_resident()  # reading the file again takes more
    found["reading"] = seconds_of_reading(head)
    head.bent.Strokes = brainshift.soft(middle, (-WITHIN / 3 ** 0.5,) * 3, 50.0)
    head.draw()
    for name, points in maps.items():
        head.opacities.Points = points
        found[name] = seconds_of_frames(head)
    head.opacities.Points = [0, 1e-4, 0.5, 0, 65535, 1e-4, 0.5, 0]
    head.display.SampleDistance = FAR_APART
    found["compositing"] = seconds_of_frames(head)
    return found


def found_in_head(file, top, *size):
    """`top`: the largest value of the voxels; `size`: their numbers."""
    import large
    import numpy
    from paraview import simple
    spacing = numpy.array([large.LONGEST_MM / max(size)] * 3)
    head = large.Head(simple.OpenDataFile(file), size, spacing, (top + 1) / 256)
    head.display.MemoryLimit = 0  # all that the driver gives
    air = top * large.AIR / 255
    maps = {"opaque": list(head.opacities.Points),
            "translucent": [0, 0, 0.5, 0, air, 0, 0.5, 0, top, 0.1, 0.5, 0]}
    return measured(head, maps)


class Scan:
    """A scan in the middle of a view, bent by 10 mm at a place."""

    def __init__(self, file, place):
        import brainshift
        import large
        from paraview import simple
        self.bent = simple.FreeFormDeformation(
            Input=simple.OpenDataFile(file), Strokes=brainshift.soft(place, (0, 0, -10.0), 50.0))
        self.view = simple.CreateView("RenderView")
        self.view.ViewSize = [large.WINDOW] * 2
        self.view.OrientationAxesVisibility = self.view.UseFXAA = 0
        self.display = simple.Show(self.bent, self.view, "UniformGridRepresentation")
        self.display.SetRepresentationType("Deformed Volume")
        self.display.AmbientOcclusion = 0
        simple.ColorBy(self.display, ("POINTS", self.bent.PointData.GetArray(0).GetName()))

    def draw(self):
        self.view.UseFXAA = 0
        self.view.SMProxy.StillRender()
        self.view.GetClientSideObject().GetRenderWindow().WaitForCompletion()


def found_in_scan(file, *place):
    """Seconds of a mean frame of each look of a scan, by name, and what this rank holds. `place`:
    mm, of the stroke: a rank knows the bounds of its own part."""
    import brainshift
    scan = Scan(file, place)
    found = {"looks": {}}
    for name in brainshift.looks(scan.display):
        brainshift.look(scan.display, name, scan.view)
        found["begin"] = held(scan)
        found["looks"][name] = seconds_of_frames(scan)
    return found


def write_found(found, out):
    from paraview.modules.vtkRemotingCore import vtkProcessModule
    rank = vtkProcessModule.GetProcessModule().GetPartitionId()
    with open(f"{out}.{rank}.json", "w", encoding="utf-8") as file:
        json.dump(found, file)


def runs(out, ranks, finds, *arguments):
    """What each of the ranks found, and wrote into files whose names begin with `out`."""
    done = subprocess.run(
        [*MPI, str(ranks), "pvbatch", "--sym", os.path.abspath(__file__), out,
         finds.__name__, json.dumps(arguments)],  # as options begin with a minus, too
        env={**os.environ, "LP_NUM_THREADS": "1"}, capture_output=True, text=True, check=False)
    names = [f"{out}.{rank}.json" for rank in range(ranks)]
    if done.returncode or not all(map(os.path.exists, names)):
        raise RuntimeError(f"{ranks} ranks failed:\n{done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    found = []
    for name in names:
        with open(name, encoding="utf-8") as one:
            found.append(json.load(one))
        os.remove(name)
    return found


def tell(report, voxels, number, whole, found):
    """What the rank has that holds, draws or waits most. `number`: bytes of a voxel of the file;
    `whole`: bytes of all voxels on a card."""
    ranks = len(found)
    most = {name: max(one[name]["scalars"] for one in found) / 2 ** 20
            for name in ("begin", "within", "beyond")}
    again = {name: sum(one[name]["uploads"] > one[before]["uploads"] for one in found)
             for name, before in (("within", "begin"), ("beyond", "within"))}
    memory = max(one["begin"]["memory"] for one in found)
    more = sum(max(0, one["beyond"]["scalars"] - one["within"]["scalars"])
               for one in found) * voxels / whole
    draws = {name: 1000 * max(one[name][0] for one in found) for name in ("opaque", "translucent")}
    rest = 1000 * found[0]["compositing"][1] * min(ranks, os.cpu_count()) / ranks
    resident = max(one["resident"] for one in found)
    exchange = max(one["beyond"]["seconds"] for one in found)
    reading = max(one["reading"] for one in found)
    coarser = max(one["begin"]["coarser"] for one in found)
    drawn = f", drawn with one voxel for {coarser}," if coarser > 1 else ""
    report.fact(
        f"ranks: {ranks}. The largest{drawn} has {most['begin']:.0f} MiB of voxels on its card "
        f"({100 * most['begin'] * 2 ** 20 / whole:.0f} %), {memory / 2 ** 20:.0f} MiB in memory "
        f"({100 * memory / (number * voxels):.0f} %), {resident:.0f} MiB resident at most; a "
        f"stroke of {WITHIN:.0f} mm sends voxels to {again['within']}, one of {BEYOND:.0f} mm to "
        f"{again['beyond']}, which then have {more / 1e6:.1f} million more after {exchange:.2f} s; "
        f"reading its part takes {reading:.2f} s; drawing "
        f"{draws['opaque']:.0f} ms (opaque), {draws['translucent']:.0f} ms (translucent); all else "
        f"{rest:.0f} ms",
        ranks=ranks, held=most, memory=memory, again=again, more=more, draws=draws, rest=rest,
        resident=resident, exchange=exchange, reading=reading)


def measure_scan(options):
    """Runs each count of ranks with a scan, writes the results."""
    from paraview import simple
    from report import Report, header
    view = simple.CreateView("RenderView")
    simple.Render(view)
    report = Report(header(view.GetRenderWindow()))
    report.case(os.path.basename(options.ranks_scan))
    scan = simple.OpenDataFile(options.ranks_scan)
    scan.UpdatePipeline()
    ends = scan.GetDataInformation().GetBounds()
    place = 0.5 * (ends[0] + ends[1]), 0.5 * (ends[2] + ends[3]), ends[5] - DEEP
    os.makedirs(options.output, exist_ok=True)
    whole = None
    for ranks in sorted({1, *options.ranks}):
        found = runs(os.path.join(os.path.abspath(options.output), "scan"), ranks,
                     found_in_scan, os.path.abspath(options.ranks_scan), *place)
        memory = max(one["begin"]["memory"] for one in found)
        whole = whole or memory
        draws = {name: 1000 * max(one["looks"][name][0] for one in found)
                 for name in found[0]["looks"]}
        report.fact(
            f"ranks: {ranks}. The slowest draws " +
            ", ".join(f"{name} in {ms:.0f} ms" for name, ms in draws.items()) +
            f"; the largest has {100 * memory / whole:.0f} % of the voxels in memory",
            ranks=ranks, draws=draws, memory=memory)
    report.write(options.output)


def measure_ranks(options):
    """Makes the head, runs each count of ranks, writes the results."""
    import large
    import numpy
    from paraview import simple
    from report import Report, header
    size, number = tuple(options.ranks_voxels), options.ranks_bits // 8
    folder = os.path.join(options.output, "ranks")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    file = os.path.join(os.path.abspath(folder), "head.nii")
    large.write_file(file, size, [large.LONGEST_MM / max(size)] * 3, number)
    if options.ranks_packed:
        subprocess.run(["gzip", "-1", file], check=True)
        file += ".gz"
    view = simple.CreateView("RenderView")
    simple.Render(view)
    report = Report(header(view.GetRenderWindow()))
    report.case("{} x {} x {} voxels of {} bits, {}x{} pixels".format(
        *size, 8 * number, large.WINDOW, large.WINDOW))
    top = 255 if number == 1 else 4095
    whole = None
    for ranks in sorted({1, *options.ranks}):
        found = runs(file, ranks, found_in_head, file, top, *size)
        one = found[0]["begin"]
        whole = whole or one["scalars"] * one["coarser"]
        tell(report, int(numpy.prod(size)), number, whole, found)
    report.write(options.output)
    shutil.rmtree(folder)


if __name__ == "__main__":
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    from scene import load_plugin
    load_plugin()
    OUT, FINDS, ARGUMENTS = sys.argv[1:]
    write_found(globals()[FINDS](*json.loads(ARGUMENTS)), OUT)
