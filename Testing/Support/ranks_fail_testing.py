# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong on one of several MPI ranks alone, and what all of them make of it. As a script
of pvbatch, this module writes the answers to some questions into the file that it is given."""

import contextlib
import gzip
import os
import struct
import sys

import numpy
from brainshift_testing import look, messages, picture, show_volume, view_along
from paraview import servermanager, simple
from ranks_testing import (COLORS, MIDDLE, OPACITIES, REFUSES, SIZE, bent, limit,
                           load_plugin_on_ranks, see, show_two, wavelet)

# Hands an image on. On one of several ranks it is spoiled.
SPOILS = """
from vtkmodules.vtkParallelCore import vtkMultiProcessController
ranks = vtkMultiProcessController.GetGlobalController()
image = self.GetImageDataOutput()
image.ShallowCopy(self.GetInputDataObject(0, 0))
if ranks.GetNumberOfProcesses() > 1 and ranks.GetLocalProcessId() == {rank}:
    {how}
"""
FAR_APART = "image.SetSpacing(1e30, 1, 1)"  # what reads it next fails
NO_SCALARS = "image.GetPointData().Initialize()"
NO_VOXELS = """image.Initialize()
    image.SetExtent(0, -1, 0, -1, 0, -1)"""
OTHER_STROKES = """from vtkmodules.vtkCommonCore import vtkFloatArray
    former = image.GetFieldData().GetArray("FFDDisplacements")
    other = vtkFloatArray()
    other.DeepCopy(former)
    other.SetName("FFDDisplacements")
    other.SetComponent(former.GetNumberOfTuples() // 2, 1, former.GetComponent(0, 1) + 0.01)
    image.GetFieldData().AddArray(other)"""

# Labels of three layers in the middle.
LAYERS = """
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
source = self.GetInputDataObject(0, 0)
z = numpy.arange(source.GetExtent()[4], source.GetExtent()[5] + 1)
labels = numpy.zeros(source.GetDimensions()[::-1], numpy.uint8)
labels[abs(z) <= 1] = 1
array = numpy_to_vtk(labels.ravel(), deep=True)
array.SetName("Labels")
image = self.GetImageDataOutput()
image.CopyStructure(source)
image.GetPointData().SetScalars(array)
"""

# Takes a rank to another folder, where it finds no file by its name alone.
GOES = """
import os
from vtkmodules.vtkParallelCore import vtkMultiProcessController
if vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == {rank}:
    os.chdir({folder!r})
"""


def spoiled(source, how, rank=1):
    """A filter that spoils an image on one rank, until `mend`."""
    return simple.ProgrammableFilter(Input=source, OutputDataSetType="vtkImageData",
                                     Script=SPOILS.format(rank=rank, how=how))


# The whole volume is asked for on each rank: what one of them lacks, another one has.
ASKS_WHOLE = """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
asked = self.GetExecutive().GetInputInformation(0).GetInformationObject(0)
asked.Set(Pipeline.UPDATE_EXTENT(), *asked.Get(Pipeline.WHOLE_EXTENT()))
asked.Set(Pipeline.UPDATE_PIECE_NUMBER(), 0)
asked.Set(Pipeline.UPDATE_NUMBER_OF_PIECES(), 1)
"""


def mend(filter):
    filter.Script = SPOILS.format(rank=-1, how="pass")


@contextlib.contextmanager
def noting(found, name):
    """Notes what the first rank reports."""
    with messages() as said:
        yield
    found[name] = numpy.array(said.text)


def points_of(places):
    return simple.PolyPointSource(Points=numpy.ravel(places).tolist())


PLACES = numpy.random.default_rng(3).uniform(-9, 9, (40, 3))


def count_of(trace):
    trace.UpdatePipeline()
    trace.SMProxy.UpdatePropertyInformation()
    return trace.GetPropertyValue("Count")


def answer_trace(found):
    """Trace Distance on a volume that fails on one rank, or in which that one finds no cortex."""
    for name, how in (("input", FAR_APART), ("cortex", NO_SCALARS)):
        broken = spoiled(wavelet(), how)
        trace = simple.TraceDistance(
            Input=points_of(PLACES), Deformation=simple.FreeFormDeformation(Input=broken),
            SurfaceBy="Threshold", Threshold=200.0)
        with noting(found, f"trace {name}"):
            before = count_of(trace)
        mend(broken)
        with noting(found, f"trace {name} mended"):
            after = count_of(trace)
        found[f"trace {name} counts"] = numpy.array([before, after])


def answer_fit(found):
    """Fit Deformation on a volume that fails on one rank, or whose own settings fail there."""
    for name, failed in (("input", simple.FreeFormDeformation), ("volume", lambda Input: Input)):
        broken = spoiled(wavelet(), FAR_APART)
        fit = simple.FitDeformation(
            Input=failed(Input=broken), RestLandmarks=points_of(PLACES),
            MeasuredLandmarks=points_of(PLACES + (1.0, 0.0, 0.5)))
        with noting(found, f"fit {name}"):
            fit.UpdatePipeline()
        mend(broken)
        with noting(found, f"fit {name} mended"):
            fit.UpdatePipeline()
        fit.SMProxy.UpdatePropertyInformation()
        found[f"fit {name} problem"] = numpy.array(fit.GetPropertyValue("Problem") or "")


def answer_file(found, folder):
    """A file that one rank does not find: its reader fails before there are data."""
    name = os.path.join(folder, "volume.nii")
    simple.SaveData(name, wavelet(), World="RAS")
    os.chdir(folder)
    for rank, there in ((0, folder), (1, folder), (1, "/")):
        simple.ProgrammableSource(OutputDataSetType="vtkPolyData",
                                  Script=GOES.format(rank=rank, folder=there)).UpdatePipeline()
    reader = simple.NIFTIVolumeReader(FileName="volume.nii")
    trace = simple.TraceDistance(
        Input=points_of(PLACES), Deformation=simple.FreeFormDeformation(Input=reader),
        SurfaceBy="Threshold", Threshold=200.0)
    with noting(found, "of a file"):
        found["file counts"] = numpy.array([count_of(trace)])


def electrodes_of(cortex):
    """A grid of contacts on a volume of 21 mm."""
    rows = [(4.0 * i - 8.0, 4.0 * j - 6.0, 8.0) for j in range(4) for i in range(5)]
    return simple.ElectrodeGrids(
        Input=points_of(rows), Cortex=cortex, Threshold=150.0,
        ContactNames=[f"G{i + 1}" for i in range(len(rows)) if i != 7] + ["G8"])


def answer_electrodes(found):
    """Contacts count once, and a cortex that fails on one rank fails on all."""
    grids = electrodes_of(wavelet())
    points = servermanager.Fetch(grids)
    found["contacts"] = numpy.array([points.GetPoint(i) for i in range(points.GetNumberOfPoints())])
    found["contacts in all"] = numpy.array(
        [grids.GetDataInformation().GetNumberOfPoints()]
        + [simple.OutputPort(grids, 1).GetDataInformation().GetNumberOfPoints()])
    broken = spoiled(wavelet(), FAR_APART)
    with noting(found, "electrodes"):
        electrodes_of(simple.FreeFormDeformation(Input=broken)).UpdatePipeline()


def answer_look(found):
    """A look that follows the values of a segment, which lies where parts of two ranks meet."""
    import brainshift
    labels = simple.ProgrammableFilter(
        Input=wavelet(), OutputDataSetType="vtkImageData", Script=LAYERS)
    display = show_volume(simple.FreeFormDeformation(Input=wavelet(), Segmentation=labels), see(),
                          "Deformed Volume", COLORS, OPACITIES, array="RTData")
    brainshift.look(display, "Brain")
    found["look Brain"] = numpy.array(
        [*display.LookupTable.RGBPoints, *display.ScalarOpacityFunction.Points])


def answer_unlike(found):
    """One rank bends the volume in another way than the others, as if it had missed a stroke; then
    it has no memory for a lattice."""
    broken = spoiled(bent(), OTHER_STROKES)
    mend(broken)
    view = see()
    display = show_volume(broken, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    display.AmbientOcclusion = 0
    before = picture(view)
    broken.Script = SPOILS.format(rank=1, how=OTHER_STROKES)
    with noting(found, "unlike"):
        kept = picture(view)
    found["picture of ranks that are unlike"] = numpy.array([abs(kept - before).max()])
    mend(broken)
    with noting(found, "alike again"):
        found["alike again picture"] = picture(view)
    simple.Delete(view)


def answer_no_lattice(found):
    import brainshift
    volume = bent(Samples=0)
    view = see()
    display = show_volume(volume, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    display.AmbientOcclusion = 0
    before = picture(view)
    limit(1, REFUSES)
    volume.LatticeDimensions = [90, 90, 90]
    with noting(found, "no lattice"):
        kept = picture(view)
    limit(1, 0)
    found["picture of ranks without a lattice"] = numpy.array([abs(kept - before).max()])
    volume.Strokes = list(volume.Strokes) + list(brainshift.soft((4, -2, 7), (0, -3, 1), 10.0))
    found["lattice of all"] = picture(view)
    simple.Delete(view)


def answer_hidden(found):
    """Of two volumes one is bent while the other is hidden."""
    import brainshift
    view = view_along((-0.5, 0.3, -1), (0, 0, 12), 110.0, size=SIZE)
    volumes, displays = show_two(
        "Deformed Volume", lambda source: simple.FreeFormDeformation(Input=source), view)
    picture(view)
    displays[1].Visibility = 0
    picture(view)
    volumes[0].Strokes = brainshift.soft((0, 0, 4), (30, 20, -16), 40.0)
    picture(view)
    displays[1].Visibility = 1
    found["shown again"] = picture(view)
    look(view, (0.9, 0.2, 0.4), (0, 0, 12), 110.0)
    found["shown again, from the side"] = picture(view)
    simple.Delete(view)


def answer_halo(found):
    """After a refusal, the halo of one of two volumes lets both be drawn in parts again."""
    import brainshift
    view = view_along((-0.5, 0.3, -1), MIDDLE, 450.0, size=SIZE)
    displays = []
    for center in (-50, 50):
        source = simple.Wavelet(WholeExtent=[-80, 80, -80, 80, center - 45, center + 45],
                                Center=[0, 0, center])
        display = show_volume(simple.FreeFormDeformation(Input=source), view, "Deformed Volume",
                              COLORS, OPACITIES, array="RTData")
        display.Visibility = 0
        displays.append(display)
    picture(view)  # windows and mappers need memory, too

    def held():
        picture(view)
        return [brainshift.gpu(display)["gpuScalarBytes"] for display in displays]
    limit(1, REFUSES)
    for display in displays:
        display.Visibility = 1
    with noting(found, "halo"):
        refused = held()
    limit(1, 0)
    displays[1].RankHalo = 5.0
    found["bytes refused and with another halo"] = numpy.array([refused, held()])
    simple.Delete(view)


LARGE = 512, 512, 513  # numbers of 16 bit: more than 256 MiB, which gzip makes small
NRRD_HEADER = """NRRD0004
type: uint16
dimension: 3
sizes: {} {} {}
endian: little
space: RAS
space directions: (0.1,0,0) (0,0.1,0) (0,0,0.1)
space origin: (0,0,0)
encoding: gzip

"""


def nifti_header():
    header = bytearray(352)
    struct.pack_into("<i36x8h", header, 0, 348, 3, *LARGE, 1, 1, 1, 1)
    struct.pack_into("<2h2x4f16xf", header, 70, 512, 16, 1, 0.1, 0.1, 0.1, 352)
    struct.pack_into("<h", header, 252, 1)  # the qform is the scanner's, without a turn
    header[344:348] = b"n+1\0"
    return bytes(header)


def answer_packed(found, folder):
    """Large files whose parts cannot be found."""
    numbers = bytes(2 * int(numpy.prod(LARGE)))
    for name, content, reader in (
            ("large.nrrd", NRRD_HEADER.format(*LARGE).encode() + gzip.compress(numbers, 1),
             simple.NRRDVolumeReader),
            ("large.nii.gz", gzip.compress(nifti_header() + numbers, 1),
             simple.NIFTIVolumeReader)):
        path = os.path.join(folder, name)
        with open(path, "wb") as file:
            file.write(content)
        source = reader(FileName=path)
        with noting(found, name):
            source.UpdatePipeline()
        found[name + " points"] = numpy.array([source.GetDataInformation().GetNumberOfPoints()])


def answer_card(found):
    """No card takes all of its part. A stroke makes parts of two sizes, so sentences differ."""
    import brainshift
    view = view_along((-0.5, 0.3, -1), MIDDLE, 450.0, size=SIZE)
    volume = simple.FreeFormDeformation(
        Input=simple.Wavelet(WholeExtent=[-80, 80] * 3),
        Strokes=brainshift.soft((50, 0, 0), (25, 0, 0), 40.0))
    display = show_volume(volume, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    display.AmbientOcclusion = 0
    display.MemoryLimit = 32.0  # MiB; the field takes 25
    with noting(found, "card"):
        picture(view)
        look(view, (0.9, 0.2, 0.4), MIDDLE, 450.0)
        picture(view)
    simple.Delete(view)


def answer_step(found):
    """A step that is shorter than a ray of the whole volume allows."""
    view = view_along((-0.5, 0.3, -1), MIDDLE, 150.0, size=SIZE)
    display = show_volume(simple.Wavelet(WholeExtent=[-30, 30] * 3), view, "Deformed Volume",
                          COLORS, OPACITIES, array="RTData")
    display.AmbientOcclusion = 0
    display.ScalarOpacityFunction.Points = [0, 0, 0.5, 0, 200, 0, 0.5, 0, 210, 1, 0.5, 0]
    display.SampleDistance = 0.005
    with noting(found, "step"):
        found["short step"] = picture(view)
    simple.Delete(view)


def answer_empty(found):
    """A rank that has no voxels: the first, which registers, or the second."""
    import brainshift
    for rank in (0, 1):
        lacking = spoiled(wavelet(), NO_VOXELS, rank)
        lacking.RequestUpdateExtentScript = ASKS_WHOLE
        volume = simple.FreeFormDeformation(
            Input=lacking, Strokes=brainshift.soft(MIDDLE, (4, 2, 1), 9))
        view = see()
        display = show_volume(volume, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
        display.AmbientOcclusion = 0
        with noting(found, f"empty {rank}"):
            found[f"empty {rank} picture"] = picture(view)
        compare = simple.CompareVolumes(Input=volume, Reference=wavelet())
        try:
            brainshift.refine(volume, compare, callback=lambda progress: progress.steps < 2)
        except (RuntimeError, ValueError) as error:
            found[f"empty {rank} refusal"] = numpy.array(str(error))
        found[f"empty {rank} refined"] = brainshift.deformed_from_rest(volume, PLACES)
        simple.Delete(view)


QUESTIONS = {name[len("answer_"):]: answer for name, answer in list(globals().items())
             if name.startswith("answer_")}


def answers(names, folder):
    found = {}
    for name in names:
        print("asks", name, flush=True)
        arguments = [found, folder] if name in ("file", "packed") else [found]
        QUESTIONS[name](*arguments)
    return found


if __name__ == "__main__":
    load_plugin_on_ranks()
    numpy.savez(sys.argv[1], **answers(sys.argv[3:], sys.argv[2]))
