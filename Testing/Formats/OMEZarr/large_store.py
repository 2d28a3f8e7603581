# SPDX-License-Identifier: BSD-3-Clause
"""Makes large OME-Zarr images from a head, chunk by chunk, and judges the reader on them.

    pvpython large_store.py make FOLDER 2048 2048 1024 uint16   # 8 GiB
    pvpython large_store.py make FOLDER 2048 1024 1025 uint8    # more than 2^31 voxels
    pvpython large_store.py judge FOLDER
    pvpython large_store.py bake FOLDER BAKED.zarr 128 [whole]  # MiB of a piece

The head of the tests is stretched over the size (x, y, z) and gets noise of 4 bits, so that it does
not pack better than a scan. `judge` reads what fits each Memory Limit, and boxes of 96 voxels at
random places and in the last corner at level 0, each in a process that is measured, and compares
them with zarr-python. `bake` bends level 0 in the middle and at a corner, writes it in pieces, and
compares boxes with what numpy reads where the tissue rests; with `whole` also every voxel with a
bake of the whole, which needs the memory. No test runs it: the build server has neither the time
nor the disk.
"""

import json
import multiprocessing
import os
import resource
import subprocess
import sys
import time

import numcodecs
import numpy

CHUNK = 64
LIMITS = (16, 128, 512, 1200)  # MiB
BOXES = 24
SIDE = 96


class Head:
    """Values of the stretched head at each voxel."""

    def __init__(self, size, kind):
        import nibabel
        name = os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_mr_t1.nii.gz")
        voxels = numpy.asarray(nibabel.as_closest_canonical(nibabel.load(name)).dataobj).T
        most = 4000 if numpy.dtype(kind).itemsize > 1 else 239
        self.voxels = (voxels * (most / voxels.max())).astype("float32")
        self.size, self.kind = size[::-1], kind  # z, y, x

    def weights(self, axis, indices):
        """(first source voxel, matrix from source voxels to voxels) along an axis."""
        count = self.voxels.shape[axis]
        at = numpy.clip((indices + 0.5) * count / self.size[axis] - 0.5, 0, count - 1.001)
        low = at.astype(int)
        matrix = numpy.zeros((len(indices), low[-1] + 2 - low[0]), "float32")
        rows = numpy.arange(len(indices))
        matrix[rows, low - low[0]] = 1 - (at - low)
        matrix[rows, low - low[0] + 1] = at - low
        return low[0], matrix

    def chunk(self, place):
        """Of the finest level; beyond the end its last voxels are repeated."""
        parts, places = [], []
        for axis in range(3):
            indices = numpy.arange(place[axis] * CHUNK, (place[axis] + 1) * CHUNK)
            indices = numpy.minimum(indices, self.size[axis] - 1)
            places.append(indices)
            parts.append(self.weights(axis, indices))
        block = self.voxels[tuple(slice(low, low + matrix.shape[1]) for low, matrix in parts)]
        for axis in range(3):
            block = numpy.moveaxis(numpy.tensordot(parts[axis][1], block, (1, axis)), 0, axis)
        z, y, x = (numbers.astype("uint32") for numbers in places)
        noise = (z * numpy.uint32(2654435761))[:, None, None] ^ \
            (y * numpy.uint32(2246822519))[None, :, None] ^ (x * numpy.uint32(3266489917))
        noise = (noise * numpy.uint32(668265263)) >> numpy.uint32(28)
        return (block + noise).astype(self.kind)


class Store:
    """Writes the chunks of all levels below one chunk of a level."""

    def __init__(self, folder, head):
        self.folder, self.head = folder, head
        self.shapes = [head.size]
        while max(self.shapes[-1]) > CHUNK:
            self.shapes.append(tuple((side + 1) // 2 for side in self.shapes[-1]))
        self.codec = numcodecs.Blosc("zstd", 1, numcodecs.Blosc.SHUFFLE)

    def put(self, level, place, chunk):
        file = os.path.join(self.folder, str(level), *map(str, place))
        os.makedirs(os.path.dirname(file), exist_ok=True)
        with open(file, "wb") as stream:
            stream.write(self.codec.encode(numpy.ascontiguousarray(chunk)))

    def make(self, level, place):
        """The chunk, after it and those that it is made of were written; None outside."""
        if any(index * CHUNK >= side for index, side in zip(place, self.shapes[level])):
            return None
        if level == 0:
            chunk = self.head.chunk(place)
        else:
            chunk = numpy.zeros((CHUNK,) * 3, self.head.kind)
            for part in numpy.ndindex(2, 2, 2):
                finer = self.make(level - 1, tuple(2 * i + k for i, k in zip(place, part)))
                self.take(chunk, part, finer)
        self.put(level, place, chunk)
        return chunk

    def read(self, level, place):
        file = os.path.join(self.folder, str(level), *map(str, place))
        if not os.path.exists(file):
            return None
        with open(file, "rb") as stream:
            return numpy.frombuffer(self.codec.decode(stream.read()), self.head.kind).reshape(
                (CHUNK,) * 3)

    @staticmethod
    def take(chunk, part, finer):
        """Puts the means of a finer chunk into its eighth of a coarser one."""
        half = CHUNK // 2
        if finer is not None:
            mean = finer.reshape(half, 2, half, 2, half, 2).sum((1, 3, 5), "uint32")
            chunk[tuple(slice(k * half, (k + 1) * half) for k in part)] = (mean + 4) // 8

    def describe(self):
        for level, shape in enumerate(self.shapes):
            self.json(f"{level}/.zarray", {
                "zarr_format": 2, "shape": shape, "chunks": [CHUNK] * 3, "order": "C",
                "dtype": numpy.dtype(self.head.kind).str, "fill_value": 0, "filters": None,
                "dimension_separator": "/", "compressor": self.codec.get_config()})
        datasets = [{"path": str(level), "coordinateTransformations": [
            {"type": "scale", "scale": [0.1 * 2 ** level] * 3},
            {"type": "translation", "translation": [0.05 * (2 ** level - 1)] * 3}]}
            for level in range(len(self.shapes))]
        axes = [{"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"]
        self.json(".zgroup", {"zarr_format": 2})
        self.json(".zattrs", {"multiscales": [
            {"version": "0.4", "axes": axes, "datasets": datasets, "type": "mean"}]})

    def json(self, name, content):
        os.makedirs(os.path.dirname(os.path.join(self.folder, name)), exist_ok=True)
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            json.dump(content, file)


def made(job):
    folder, size, kind, level, place = job
    Store(folder, Head(size, kind)).make(level, place)


def make(folder, x, y, z, kind):
    start = time.time()
    size = (int(x), int(y), int(z))
    store = Store(folder, Head(size, kind))
    level = max(0, len(store.shapes) - 3)
    counts = [-(-side // CHUNK) for side in store.shapes[level]]
    jobs = [(folder, size, kind, level, place) for place in numpy.ndindex(*counts)]
    with multiprocessing.get_context("fork").Pool() as pool:
        pool.map(made, jobs, 1)
    for coarser in range(level + 1, len(store.shapes)):
        counts = [-(-side // CHUNK) for side in store.shapes[coarser]]
        for place in numpy.ndindex(*counts):
            chunk = numpy.zeros((CHUNK,) * 3, kind)
            for part in numpy.ndindex(2, 2, 2):
                store.take(chunk, part, store.read(
                    coarser - 1, tuple(2 * i + k for i, k in zip(place, part))))
            store.put(coarser, place, chunk)
    store.describe()
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    print(f"{folder}: {' x '.join(map(str, size))} {kind}, {len(store.shapes)} levels, "
          f"{time.time() - start:.0f} s, processor "
          f"{sum(one.ru_utime + one.ru_stime for one in used):.0f} s, "
          f"{max(one.ru_maxrss for one in used) / 1024:.0f} MB a process")


def one(folder, request):
    """In a process of its own: reads a level or a box, compares it, and prints what it took."""
    from brainshift_testing import load_plugin, messages
    load_plugin()
    import zarr
    from paraview import simple
    from vtkmodules.util.numpy_support import vtk_to_numpy
    before = resource.getrusage(resource.RUSAGE_SELF)
    start = time.time()
    with messages() as said:
        reader = simple.OMEZarrReader(FileName=folder, **request.get("words", {}))
        own = reader.GetClientSideObject()
        own.UpdateInformation()
        if "box" in request:
            own.UpdateExtent(request["box"])
        else:
            own.UpdateWholeExtent()
    took = time.time() - start
    after = resource.getrusage(resource.RUSAGE_SELF)
    image = own.GetOutput()
    extent = image.GetExtent()
    level = image.GetFieldData().GetArray("OMEZarrLevel").GetValue(0)
    found = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])
    array = zarr.open_array(os.path.join(folder, str(level)), mode="r")
    same = True
    for z in range(extent[4], extent[5] + 1, CHUNK):  # by parts: zarr-python needs memory, too
        end = min(z + CHUNK, extent[5] + 1)
        part = array[z:end, extent[2]:extent[3] + 1, extent[0]:extent[1] + 1]
        same = same and (found[z - extent[4]:end - extent[4]] == part).all()
    print(json.dumps({
        "level": int(level), "dimensions": image.GetDimensions(), "seconds": round(took, 2),
        "processor": round(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 2),
        "voxels MiB": round(found.nbytes / 2 ** 20, 1),
        "resident MiB": round((after.ru_maxrss - before.ru_maxrss) / 1024, 1),
        "same": bool(same), "said": "ERROR" in said.text}))


def asked(folder, request):
    result = subprocess.run([os.environ.get("PVPYTHON", "pvpython"), __file__, "one", folder,
                             json.dumps(request)], capture_output=True, text=True, check=False)
    lines = [line for line in result.stdout.splitlines() if line.startswith("{")]
    if not lines:
        raise RuntimeError(f"{request}: {result.stdout} {result.stderr}")
    return json.loads(lines[-1])


def judge(folder):
    with open(os.path.join(folder, "0", ".zarray"), encoding="utf-8") as file:
        z, y, x = json.load(file)["shape"]
    wrong = 0
    for limit in LIMITS:
        result = asked(folder, {"words": {"MemoryLimit": limit}})
        wrong += not result["same"]
        print(f"limit {limit} MiB: {result}", flush=True)
    random = numpy.random.default_rng(41)
    places = [[int(random.integers(0, side - SIDE)) for side in (x, y, z)] for _ in range(BOXES)]
    places.append([side - SIDE for side in (x, y, z)])
    results = []
    for place in places:
        box = [number for first in place for number in (first, first + SIDE - 1)]
        results.append(asked(folder, {"box": box, "words": {"Level": 0}}))
        wrong += not results[-1]["same"]
    print(f"{len(results)} boxes of {SIDE}^3 at level 0, last one in the last corner: "
          f"{sum(one['same'] for one in results)} same, most "
          f"{max(one['seconds'] for one in results)} s, "
          f"{max(one['resident MiB'] for one in results)} MiB")
    return 1 if wrong else 0


def bent(volume, size, voxel):
    """The volume with tissue that moves in the middle, and at a corner from outside."""
    import brainshift
    from paraview import simple
    middle = [voxel * side / 2 for side in size]
    reach = 0.3 * voxel * min(size)
    strokes = brainshift.soft(middle, (0.1 * reach, 0.05 * reach, -0.15 * reach), reach)
    strokes += brainshift.soft((0, 0, 0), (0.05 * reach,) * 3, 0.3 * reach)
    return simple.FreeFormDeformation(Input=volume, Strokes=strokes)


def written(folder, out, limit):
    """In a process of its own: bakes and writes."""
    from brainshift_testing import load_plugin
    load_plugin()
    from paraview import servermanager, simple
    size, voxel = size_of(folder)
    before = resource.getrusage(resource.RUSAGE_SELF)
    start = time.time()
    reader = simple.OMEZarrReader(FileName=folder, Level=0)
    writer = servermanager.writers.OMEZarrWriter(
        Input=simple.BakeDeformation(Input=bent(reader, size, voxel)), FileName=out,
        MemoryLimit=float(limit))
    writer.UpdatePipeline()
    writer.SMProxy.UpdatePropertyInformation()
    after = resource.getrusage(resource.RUSAGE_SELF)
    print(json.dumps({
        "problem": writer.GetPropertyValue("Problem"), "seconds": round(time.time() - start, 1),
        "processor": round(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 1),
        "resident MiB": round(after.ru_maxrss / 1024), "of it before": before.ru_maxrss // 1024}))


def size_of(folder):
    """Voxels along x, y, z of level 0, and the side of one, mm."""
    with open(os.path.join(folder, "0", ".zarray"), encoding="utf-8") as file:
        return json.load(file)["shape"][::-1], 0.1


def placed(size, voxel):
    """An image of the size without any numbers: its deformation is that of the store."""
    from paraview import simple
    from vtkmodules.vtkCommonDataModel import vtkImageData
    image = vtkImageData()
    image.SetDimensions(size)
    image.SetSpacing([voxel] * 3)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(image)
    return source


def linear(array, at):
    """The numbers of a zarr array at positions (N x 3: x, y, z; voxels), 0 outside."""
    at = at[:, ::-1]
    last = numpy.array(array.shape) - 1
    inside = ((at > -1e-3) & (at < last + 1e-3)).all(1)
    at = numpy.clip(at, 0, last)
    low = numpy.minimum(at.astype(int), last - 1)
    first = low.min(0)
    part = array[tuple(slice(a, b + 2) for a, b in zip(first, low.max(0)))].astype(float)
    result = numpy.zeros(len(at))
    for corner in numpy.ndindex(2, 2, 2):
        weight = numpy.abs(1 - numpy.array(corner) - (at - low)).prod(1)
        result += weight * part[tuple((low - first + corner).T)]
    return result, inside


def compared(folder, out):
    """Boxes against numpy: how many voxels differ by more than rounding, of how many that moved."""
    from brainshift_testing import load_plugin
    load_plugin()
    import brainshift
    import zarr
    size, voxel = size_of(folder)
    filter = bent(placed(size, voxel), size, voxel)
    source = zarr.open_array(os.path.join(folder, "0"), mode="r")
    baked = zarr.open_array(os.path.join(out, "0"), mode="r")
    random = numpy.random.default_rng(41)
    side = 20
    firsts = [(0, 0, 0), tuple(n - side for n in size), tuple(n // 2 - side for n in size)]
    firsts += [tuple(int(n * random.uniform(0.3, 0.7)) for n in size) for _ in range(30)]
    wrong = moved = outside = 0
    for first in firsts:
        box = [numpy.arange(a, a + side) for a in first]
        z, y, x = numpy.meshgrid(*box[::-1], indexing="ij")
        places = numpy.stack([x.ravel(), y.ravel(), z.ravel()], 1)
        rest = brainshift.rest_from_deformed(filter, places * voxel) / voxel
        expected, inside = linear(source, rest)
        found = baked[tuple(slice(a, a + side) for a in first[::-1])].ravel().astype(float)
        lowest = 0  # of this head
        differs = numpy.where(inside, numpy.abs(found - expected) > 0.75, found != lowest)
        wrong += int(differs.sum())
        outside += int((~inside).sum())
        moved += int((numpy.abs(rest - places).max(1) > 0.5).sum())
    print(json.dumps({"wrong": wrong, "moved": moved, "from outside": outside,
                      "of": len(firsts) * side ** 3}))


def against_whole(folder, out):
    """Every voxel against a bake of the whole."""
    from brainshift_testing import load_plugin
    load_plugin()
    import zarr
    from paraview import simple
    from vtkmodules.util.numpy_support import vtk_to_numpy
    size, voxel = size_of(folder)
    start = time.time()
    reader = simple.OMEZarrReader(FileName=folder, Level=0)
    own = simple.BakeDeformation(Input=bent(reader, size, voxel)).GetClientSideObject()
    own.UpdateWholeExtent()
    took = time.time() - start
    whole = vtk_to_numpy(own.GetOutput().GetPointData().GetScalars()).reshape(size[::-1])
    baked = zarr.open_array(os.path.join(out, "0"), mode="r")
    different = sum(int((whole[z:z + CHUNK] != baked[z:z + CHUNK]).sum())
                    for z in range(0, size[2], CHUNK))
    used = resource.getrusage(resource.RUSAGE_SELF)
    print(json.dumps({"different": different, "of": whole.size, "seconds": round(took, 1),
                      "resident MiB": round(used.ru_maxrss / 1024)}))


def run(*words):
    """A command of this file in a process of its own."""
    subprocess.run([os.environ.get("PVPYTHON", "pvpython"), __file__, *words], check=True)


def bake(folder, out, limit, *words):
    run("written", folder, out, limit)
    run("compared", folder, out)
    if words:
        run("against_whole", folder, out)


if __name__ == "__main__":
    commands = (make, judge, bake, written, compared, against_whole)
    sys.exit({one.__name__: one for one in commands}[sys.argv[1]](*sys.argv[2:])
             if sys.argv[1] != "one" else one(sys.argv[2], json.loads(sys.argv[3])))
