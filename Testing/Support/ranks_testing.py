# SPDX-License-Identifier: BSD-3-Clause
"""What tests of several MPI ranks ask: numbers, pictures, slices and picks of one bent volume. As a
script of pvbatch, this module writes the answers into the file that it is given."""

import os
import re
import subprocess
import sys

import numpy
from brainshift_testing import look, picture, scratch, show_volume, view_along
from paraview import servermanager, simple
from slices_testing import show_slices
from vtkmodules.vtkParallelCore import vtkMultiProcessController

SIZE = 120
MIDDLE = (0.0, 0.0, 0.0)
EXTENT = [-12, 12, -12, 12, -12, 12]
COLORS = [0, 0, 0, 1, 150, 0, 1, 0, 300, 1, 0, 0]
OPACITIES = [0, 0, 0.5, 0, 150, 0.02, 0.5, 0, 300, 0.3, 0.5, 0]
PIXELS = [(SIZE // 2, SIZE // 2), (45, 68), (75, 52), (2, 2)]
NOWHERE = (numpy.nan,) * 3
REFUSES = 2 << 20  # bytes that a rank may take; it lacks more of a volume
WIDE_HALO = 30.0   # mm, so that it does
#: What the first of several ranks reports then, each once.
REFUSALS = ["MPI rank 1 of {}: its part of the volume, .* The first rank draws the whole volume",
            "MPI rank 0 of {}: its part of the volume, .* The picture stays as it was",
            "MPI rank 1 of {}: its part of the volume has no array .* The picture stays as it was"]
#: Why ranks draw no parts, as reported.
REASONS = ["Trace Points are shown beside it", "a volume that is no Deformed Volume is shown",
           "its blend mode is neither", "two colours compare it with a reference"]

# Points of a ball, shared out among the ranks in order.
PARTS = """
import numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkParallelCore import vtkMultiProcessController
ranks = vtkMultiProcessController.GetGlobalController()
places = numpy.random.default_rng(8).normal(size=(200, 3))
places *= 6.0 / numpy.linalg.norm(places, axis=1)[:, None]
points = vtkPoints()
for place in numpy.array_split(places, ranks.GetNumberOfProcesses())[ranks.GetLocalProcessId()]:
    points.InsertNextPoint(place)
self.GetPolyDataOutput().SetPoints(points)
"""

# Gives a rank this many bytes more than it has, or all again.
LIMIT = """
import resource
from vtkmodules.vtkParallelCore import vtkMultiProcessController
rank, more = {rank}, {more}
ranks = vtkMultiProcessController.GetGlobalController()
if ranks.GetNumberOfProcesses() > 1 and rank == ranks.GetLocalProcessId():
    most = resource.getrlimit(resource.RLIMIT_AS)[1]
    with open("/proc/self/statm") as taken:
        pages = int(taken.read().split()[0])
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + more, most)
                       if more else (most, most))
"""

# Turns an image about an axis that is none of the world's.
TURN = """
import vtk
turn = vtk.vtkTransform()
turn.RotateWXYZ(35.0, 1.0, -2.0, 0.5)
rows = [turn.GetMatrix().GetElement(i, j) for i in range(3) for j in range(3)]
"""
TURN_DATA = TURN + """
self.GetImageDataOutput().ShallowCopy(self.GetInputDataObject(0, 0))
self.GetImageDataOutput().SetDirectionMatrix(rows)
"""
TURN_INFORMATION = TURN + """
self.GetOutputInformation(0).Set(vtk.vtkDataObject.DIRECTION(), rows, 9)
"""

# Makes the voxels of an image smaller.
FINER_DATA = """
self.GetImageDataOutput().ShallowCopy(self.GetInputDataObject(0, 0))
self.GetImageDataOutput().SetSpacing(0.4, 0.4, 0.4)
"""
FINER_INFORMATION = """
import vtk
self.GetOutputInformation(0).Set(vtk.vtkDataObject.SPACING(), [0.4] * 3, 3)
"""

# Hands the volume on, or fails on the second of several ranks.
FAILS = """
from vtkmodules.vtkParallelCore import vtkMultiProcessController
fails = {fails}
if fails and vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == 1:
    raise RuntimeError("this rank fails")
self.GetImageDataOutput().ShallowCopy(self.GetInputDataObject(0, 0))
"""

#: How a program starts on several ranks of one machine, whatever its cores and its user.
MPI = [os.environ.get("BRAINSHIFT_MPIEXEC", "mpirun"), "--oversubscribe", "--allow-run-as-root",
       "-np"]


def wavelet():
    return simple.Wavelet(WholeExtent=EXTENT)


def bent(**properties):
    import brainshift
    return simple.FreeFormDeformation(
        Input=wavelet(), Strokes=brainshift.soft(MIDDLE, (4, 2, 1), 12.0), **properties)


def see(size=SIZE):
    return view_along((-0.5, 0.3, -1), MIDDLE, 80.0, size=size)


def drawn(found, name, display, view):
    """Adds a picture to the answers, and where the tissue lies under some pixels."""
    import brainshift
    display.AmbientOcclusion = 0  # ranks that draw parts have none
    found[name] = picture(view)
    picks = [brainshift.pick(display, view, *pixel) for pixel in PIXELS]
    found[name + " picks"] = numpy.array([pick or NOWHERE for pick in picks])


def answer_volume(found):
    import brainshift
    volume, view = bent(), see()
    display = show_volume(volume, view, "Deformed Volume", COLORS, OPACITIES, array="RTData",
                          shade=True)
    drawn(found, "volume", display, view)
    volume.Strokes = list(volume.Strokes) + list(brainshift.soft((4, -2, 7), (0, -3, 1), 10.0))
    drawn(found, "volume after a stroke", display, view)
    found["uploads"] = numpy.array(
        [brainshift.counters(display)[name] for name in ("volumeUploads", "latticeUploads")])
    volume.UpdatePipeline()
    volume.SMProxy.UpdatePropertyInformation()
    found["filter"] = numpy.array([volume.MinimumJacobian, volume.MaximumDisplacement])


def answer_looks(found):
    """What the histogram of the whole volume says, whichever parts the ranks hold."""
    import brainshift
    view = see()
    display = show_volume(bent(), view, "Deformed Volume", COLORS, OPACITIES, array="RTData",
                          shade=True)
    for name in brainshift.looks(display):
        brainshift.look(display, name, view)
        found["look " + name] = numpy.array(
            [*display.LookupTable.RGBPoints, *display.ScalarOpacityFunction.Points,
             *view.CameraPosition, *view.CameraFocalPoint])
    simple.Delete(view)


def answer_scene(found):
    """A volume, a surface that cuts it, and traced points before and behind tissue."""
    view = see()
    display = show_volume(bent(), view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    ball = simple.Show(simple.Sphere(Center=(8, 0, -4), Radius=9, ThetaResolution=40,
                                     PhiResolution=40), view, "GeometryRepresentation")
    ball.DisableLighting = 1
    points = simple.PolyPointSource(Points=[-6, 4, 20, 5, -9, 4, -8, -8, -8])
    traces = simple.Show(points, view, "GeometryRepresentation")
    traces.SetRepresentationType("Trace Points")
    traces.TraceRadius = 2.0
    drawn(found, "scene", display, view)


def answer_slices(found):
    view = see()
    display = show_slices(bent(), view, ("Sagittal", "Coronal", "Axial"), MIDDLE, high=300.0,
                          array="RTData")
    drawn(found, "slices", display, view)
    display.SlicePosition = [3.0, -2.0, 5.0]
    drawn(found, "slices moved", display, view)


def answer_letters(found):
    """The letters of the sides, and the warning that they are not known."""
    view = view_along((0, 0, -1), MIDDLE, 80.0, size=2 * SIZE, half_height=16.0)
    display = show_slices(bent(), view, ("Axial",), MIDDLE, high=300.0, array="RTData")
    found["no letters"] = picture(view)
    display.OrientationMarks = 1
    found["letters not known"] = picture(view)
    display.WorldAxes = "LPS"
    found["letters"] = picture(view)


def answer_parts(found):
    """A larger volume, seen askew, opaque, in parallel, as a projection, from within, and how much
    of it the first rank has in memory and on its card."""
    import brainshift
    source = simple.Wavelet(WholeExtent=[-30, 30] * 3)
    volume = simple.FreeFormDeformation(Input=source)
    for name, strokes in (("unbent", []), ("bent", brainshift.soft(MIDDLE, (8, 2, 1), 25.0)),
                          ("far", brainshift.soft(MIDDLE, (30, 10, -10), 80.0))):
        volume.Strokes = strokes
        view = view_along((-0.5, 0.3, -1), MIDDLE, 150.0, size=SIZE)
        display = show_volume(volume, view, "Deformed Volume", COLORS, OPACITIES, array="RTData",
                              shade=True)
        display.AmbientOcclusion = 0
        found[f"large {name}"] = picture(view)
        found[f"bytes {name}"] = numpy.array([brainshift.gpu(display)["gpuScalarBytes"]])
        found[f"bytes in memory {name}"] = numpy.array(
            [brainshift.counters(display)["voxelBytes"]])
    display.ScalarOpacityFunction.Points = [0, 0, 0.5, 0, 200, 0, 0.5, 0, 210, 1, 0.5, 0]
    found["large opaque"] = picture(view)
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 40
    found["large parallel"] = picture(view)
    view.CameraParallelProjection = 0
    display.BlendMode = 1  # maximum: the first rank draws alone
    found["large maximum"] = picture(view)
    view.CameraParallelScale = 60
    found["large maximum, smaller"] = picture(view)
    found["large maximum picks"] = numpy.array(
        [brainshift.pick(display, view, *pixel) or NOWHERE for pixel in PIXELS])
    display.BlendMode = 0
    picture(view)
    found["bytes again"] = numpy.array([brainshift.gpu(display)["gpuScalarBytes"]])
    view.CameraPosition, view.CameraFocalPoint = [-20, 8, 15], [30, -9, 2]
    found["large from within"] = picture(view)
    plain = view_along((0, 0, -1), MIDDLE, 150.0, size=SIZE + 1)  # without a lattice, along an axis
    display = show_volume(source, plain, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    display.SampleDistance, display.AmbientOcclusion = 4.0, 0
    found["large plain"] = picture(plain)
    plain.CameraParallelProjection = 1
    found["large plain, parallel"] = picture(plain)


def answer_features(found):
    """What needs the range of all values, or cuts the volume."""
    view = see()
    for name, source in (("", bent()), (", not bent", wavelet())):
        display = show_volume(source, view, "Deformed Volume", COLORS, OPACITIES, array="RTData",
                              shade=True)
        display.GradientOpacity = [0, 0.2, 20, 0.2, 30, 1]
        found["gradient opacity" + name] = picture(view)
        display.GradientOpacity = []
        display.UseCropping = 1
        display.CroppingOrigin, display.CroppingScale = [2, -1, 1], [0.6, 0.5, 0.7]
        found["cropped" + name] = picture(view)
        display.UseCropping = 0
        table = simple.GetTransferFunction2D("RTData", None, display, separate=True)
        table.OutputDimensions = [256, 256]
        table.Range = [30.0, 280.0, 0.0, 60.0]
        table.Boxes = [60.0, 5.0, 170.0, 40.0, 0.9, 0.3, 0.1, 0.2]
        display.TransferFunction2D, display.UseTransfer2D = table, 1
        found["2D transfer function" + name] = picture(view)
        display.Visibility = 0
    simple.Delete(view)


def answer_oblique(found):
    """A volume whose axes, and so its cropping, lie along no side of the boxes of the ranks."""
    import brainshift
    turned = simple.ProgrammableFilter(Input=wavelet(), OutputDataSetType="vtkImageData",
                                       Script=TURN_DATA, RequestInformationScript=TURN_INFORMATION)
    volume = simple.FreeFormDeformation(
        Input=turned, Strokes=brainshift.soft(MIDDLE, (4, 2, 1), 12.0))
    view = see()
    display = show_volume(volume, view, "Deformed Volume", COLORS, OPACITIES, array="RTData",
                          shade=True)
    display.AmbientOcclusion = 0
    found["askew"] = picture(view)
    display.UseCropping = 1
    display.CroppingOrigin, display.CroppingScale = [2, -1, 1], [0.6, 0.5, 0.7]
    found["askew and cropped"] = picture(view)
    simple.Delete(view)


def answer_registration(found):
    """What a few steps find: a position, and points that are bent."""
    import brainshift
    volume = bent()
    compare = simple.CompareVolumes(Input=volume, Reference=wavelet())
    brainshift.refine(volume, compare, callback=lambda progress: progress.steps < 3)
    points = numpy.random.default_rng(4).uniform(-9, 9, (50, 3))
    found["refined"] = brainshift.deformed_from_rest(volume, points)
    compare.ReferenceTranslation = (1.5, -1.0, 0.5)
    brainshift.align(compare, callback=lambda progress: progress.steps < 2)
    found["aligned"] = numpy.array([*compare.ReferenceRotation, *compare.ReferenceTranslation])


def answer_registration_of_averages(found):
    """The same of voxels that are too fine to be compared, so that averages are."""
    import brainshift
    large = simple.Wavelet(WholeExtent=[-161, 160, -160, 160, -159, 160])
    finer = simple.ProgrammableFilter(
        Input=large, OutputDataSetType="vtkImageData", Script=FINER_DATA,
        RequestInformationScript=FINER_INFORMATION)
    volume = simple.FreeFormDeformation(Input=finer, LatticeDimensions=[6, 6, 6])
    reference = simple.Wavelet(WholeExtent=[-60, 60, -60, 60, -60, 60])
    compare = simple.CompareVolumes(Input=volume, Reference=reference,
                                    ReferenceTranslation=(3.0, -2.0, 1.0))
    brainshift.align(compare, callback=lambda progress: progress.steps < 2)
    found["aligned averages"] = numpy.array(
        [*compare.ReferenceRotation, *compare.ReferenceTranslation])
    for source in (compare, reference, volume, finer, large):
        simple.Delete(source)


def answer_failure(found):
    """The pipeline of one rank fails, while a stroke is made, and works again."""
    import brainshift
    made = simple.ProgrammableFilter(Input=wavelet(), OutputDataSetType="vtkImageData",
                                     Script=FAILS.format(fails=False))
    volume = simple.FreeFormDeformation(Input=made)
    view = see()
    display = show_volume(volume, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    display.AmbientOcclusion = 0
    before = picture(view)
    made.Script = FAILS.format(fails=True)
    kept = picture(view)
    volume.Strokes = brainshift.soft(MIDDLE, (4, 2, 1), 12.0)
    kept_again = picture(view)
    ranks = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
    expected = before if ranks > 1 else kept_again
    found["picture while a rank fails"] = numpy.array(
        [abs(kept - before).max(), abs(kept_again - expected).max()])
    made.Script = FAILS.format(fails=False)
    found["after a rank failed"] = picture(view)
    simple.Delete(view)


def show_two(kind, make, view):
    """Two volumes, one before the other, of other values, as what `make` gives of their source."""
    far = simple.Wavelet(WholeExtent=[-12, 12, -12, 12, 15, 39], Center=[0, 0, 27])
    volumes = [make(wavelet()), make(far)]
    displays = [show_volume(volume, view, kind, COLORS, OPACITIES, array="RTData", shade=True)
                for volume in volumes]
    displays[1].LookupTable.RGBPoints = [0, 0, 1, 0, 150, 1, 0, 1, 300, 0, 0, 1]
    return volumes, displays


def answer_several(found):
    """Two volumes in one view, also with a surface that cuts both."""
    import brainshift
    view = view_along((-0.5, 0.3, -1), (0, 0, 12), 110.0, size=SIZE)
    volumes, displays = show_two(
        "Deformed Volume", lambda source: simple.FreeFormDeformation(Input=source), view)
    found["two"] = picture(view)
    volumes[1].Strokes = brainshift.soft((0, 0, 20), (6, 5, -4), 14.0)
    found["two, one bent"] = picture(view)
    look(view, (0.9, 0.2, 0.4), (0, 0, 12), 110.0)
    found["two, from the side"] = picture(view)
    ball = simple.Show(simple.Sphere(Center=(2, 3, 13), Radius=9, ThetaResolution=40,
                                     PhiResolution=40), view, "GeometryRepresentation")
    ball.DisableLighting = 1
    found["two and a ball"] = picture(view)
    displays[1].BlendMode = 1  # the first rank draws both
    found["two, one as its maximum"] = picture(view)
    displays[1].Visibility = 0
    found["two, one hidden"] = picture(view)
    displays[0].Visibility, displays[1].Visibility, displays[1].BlendMode = 0, 1, 0
    found["two, the other hidden"] = picture(view)
    show_volume(wavelet(), view, "Volume", COLORS, OPACITIES, array="RTData")
    picture(view)  # in no right order, which is reported
    simple.Delete(view)


def limit(rank, more):
    """Lets a rank take that many bytes more; 0: as many as there are."""
    simple.ProgrammableSource(OutputDataSetType="vtkPolyData",
                              Script=LIMIT.format(rank=rank, more=more)).UpdatePipeline()


def answer_refusal(found):
    """A rank gets no memory for its part, then the first rank gets none, then all get it again."""
    import brainshift
    volume = simple.FreeFormDeformation(Input=simple.Wavelet(WholeExtent=[-80, 80] * 3))
    volume.UpdatePipeline()
    view = view_along((-0.5, 0.3, -1), MIDDLE, 450.0, size=SIZE)
    display = show_volume(volume, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    display.Visibility, display.RankHalo = 0, WIDE_HALO
    picture(view)  # windows and mappers need memory, too
    limit(1, REFUSES)
    display.Visibility = 1
    found["one refuses"] = picture(view)
    found["bytes one refuses"] = numpy.array([brainshift.gpu(display)["gpuScalarBytes"]])
    limit(1, 0)
    display.RankHalo = 5.0
    found["none refuses"] = picture(view)
    found["bytes none refuses"] = numpy.array([brainshift.gpu(display)["gpuScalarBytes"]])
    limit(0, REFUSES)
    volume.Strokes = brainshift.soft(MIDDLE, (70, 20, -10), 150.0)
    kept = picture(view)
    limit(0, 0)
    display.RankHalo = 6.0
    found["strokes that a rank refused"] = picture(view)
    ranks = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses()
    expected = found["none refuses" if ranks > 1 else "strokes that a rank refused"]
    found["picture of a refused stroke"] = numpy.array([abs(kept - expected).max()])


def answer_comparison(found):
    compared = simple.CompareVolumes(Input=bent(), Reference=wavelet())
    view = see()
    display = show_volume(compared, view, "Deformed Volume", COLORS, OPACITIES, array="RTData")
    display.VolumeComparison = 0
    found["no comparison"] = picture(view)
    display.VolumeComparison = 1
    drawn(found, "red and green", display, view)
    answer_reference_alone(found)


def answer_reference_alone(found):
    """A reference of its own size, moved, of which each rank's card holds a part."""
    import brainshift
    compared = simple.CompareVolumes(
        Input=bent(), Reference=simple.Wavelet(WholeExtent=[-30, 24] * 3), Show="Reference",
        ReferenceRotation=[0, 12, 5])
    view = view_along((-0.5, 0.3, -1), MIDDLE, 150.0, size=SIZE)
    display = show_volume(compared, view, "Deformed Volume", COLORS, OPACITIES, array="RTData",
                          shade=True)
    display.AmbientOcclusion, display.RankHalo = 0, 2.0
    for name, shift in (("", (0, 0, 0)), (", moved", (1.0, -0.5, 1.0)), (", far", (9, 7, 8))):
        compared.ReferenceTranslation = shift
        found["large reference" + name] = picture(view)
        found["bytes reference" + name] = numpy.array([brainshift.gpu(display)["gpuOtherBytes"]])
    display.ScalarOpacityFunction.Points = [0, 0, 0.5, 0, 200, 0, 0.5, 0, 210, 1, 0.5, 0]
    found["large reference opaque"] = picture(view)


def answer_stock(found):
    """ParaView's own "Volume", for comparison."""
    view = see()
    show_volume(wavelet(), view, "Volume", COLORS, OPACITIES, array="RTData", shade=True)
    found["stock"] = picture(view)
    large = view_along((-0.5, 0.3, -1), MIDDLE, 150.0, size=SIZE)
    show_volume(simple.Wavelet(WholeExtent=[-30, 30] * 3), large, "Volume", COLORS, OPACITIES,
                array="RTData", shade=True)
    found["stock large"] = picture(large)
    two = view_along((-0.5, 0.3, -1), (0, 0, 12), 110.0, size=SIZE)
    show_two("Volume", lambda source: source, two)
    found["stock two"] = picture(two)


def answer_traces(found):
    places = numpy.random.default_rng(3).uniform(-11, 11, 120).tolist()
    points = simple.PolyPointSource(Points=places)
    trace = simple.TraceDistance(Input=points, Deformation=bent(), SurfaceBy="Threshold",
                                 Threshold=200.0)
    trace.UpdatePipeline()
    trace.SMProxy.UpdatePropertyInformation()
    found["trace"] = numpy.array([trace.Count, trace.Mean, trace.RMS, trace.Percentile95])
    moved = simple.DeformGeometry(Input=points, Deformation=bent())
    result = servermanager.Fetch(moved)
    found["moved points"] = numpy.array(
        [result.GetPoint(i) for i in range(result.GetNumberOfPoints())])


def answer_fit(found):
    """A fit of landmarks, which the first rank has, and one of traces, of which each rank has a
    part."""
    from brainshift.reports import numbers
    rest = numpy.random.default_rng(5).uniform(-9, 9, (10, 3))
    landmarks = [simple.PolyPointSource(Points=places.ravel().tolist())
                 for places in (rest, rest + (1.0, -2.0, 0.5))]
    near = simple.FitDeformation(Input=wavelet(), RestLandmarks=landmarks[0],
                                 MeasuredLandmarks=landmarks[1])
    bends = simple.FitDeformation(
        Input=wavelet(), Threshold=200.0, Pulls=[0, 0, 3, 0, 1, 5, 1], Pins=[-8, 0, 0, 1],
        Traces=simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script=PARTS))
    for name, fit in (("landmarks", near), ("bend", bends)):
        fit.UpdatePipeline()
        fit.SMProxy.UpdatePropertyInformation()
        found["fit of " + name] = numpy.array(
            [fit.GetPropertyValue(figure) for figure in ("Share", "TraceRMS", "AnchorCount")]
            + numbers(fit.SMProxy, "Rigid") + numbers(fit.SMProxy, "TraceResiduals"), float)
        moved = simple.DeformGeometry(
            Input=landmarks[0],
            Deformation=simple.FreeFormDeformation(Input=wavelet(), Lattice=fit))
        result = servermanager.Fetch(moved)
        found["points moved by the fit of " + name] = numpy.array(
            [result.GetPoint(i) for i in range(result.GetNumberOfPoints())])


def answer_files(found, folder):
    """Images are written in pieces; the test reads the files."""
    made = {"bake": simple.BakeDeformation(Input=bent()),
            "field": simple.DeformationField(Input=bent(), Direction="Backward")}
    made["inverse"] = simple.InvertDisplacementField(
        Input=simple.DeformationField(Input=bent(), Direction="Forward"))
    for name, proxy in made.items():
        simple.SaveData(os.path.join(folder, name + ".pvti"), proxy)
    simple.SaveData(os.path.join(folder, "bake.nii"), made["bake"], World="RAS")


def answers(folder=None):
    """All answers by name: pictures [row, column, colour], picks (mm), numbers of filters."""
    found = {}
    if folder:
        answer_refusal(found)
        answer_failure(found)
    answer_volume(found)
    answer_looks(found)
    answer_scene(found)
    answer_parts(found)
    answer_features(found)
    answer_oblique(found)
    answer_registration(found)
    answer_registration_of_averages(found)
    answer_several(found)
    answer_slices(found)
    answer_letters(found)
    answer_comparison(found)
    answer_stock(found)
    answer_traces(found)
    answer_fit(found)
    if folder:
        answer_files(found, folder)
    return found


def answers_of_many(folder):
    """Those of `answers` that say what many ranks draw and what filters find. The first rank
    registers, however many there are."""
    found = {}
    for answer in (answer_volume, answer_parts, answer_oblique, answer_several, answer_slices,
                   answer_stock, answer_traces, answer_fit):
        answer(found)
    answer_files(found, folder)
    return found


def run_batch(ranks, *arguments, timeout=600):
    """What pvbatch says on that many ranks while it runs a script. It must end by itself."""
    command = [*MPI, str(ranks), os.environ["BRAINSHIFT_PVBATCH"], *arguments]
    # A rank that has no more memory must not be served by what it gave back, nor by the 64 MB of
    # addresses that each thread gets for an arena of its own and leaves behind when it ends.
    environment = {**os.environ, "MALLOC_MMAP_THRESHOLD_": str(1 << 20), "MALLOC_ARENA_MAX": "1"}
    ended = subprocess.run(
        command, text=True, capture_output=True, timeout=timeout, env=environment)
    said = ended.stdout + ended.stderr
    assert ended.returncode == 0, f"pvbatch ended with {ended.returncode}: {said}"
    return said


def batch(ranks, folder, script=__file__, expected=()):
    """What pvbatch answers on that many ranks, and what it says. The script is a module like this
    one; it reports errors that match the expected expressions, each once."""
    os.makedirs(folder, exist_ok=True)
    name = scratch(f"ranks{ranks}.npz")
    said = run_batch(ranks, script, name, folder)
    errors = [line for line in said.splitlines()
              if "ERR|" in line and "No plugin loaded yet" not in line]  # it was loaded already
    for expression in expected:
        found = [line for line in errors if re.search(expression, line)]
        assert len(found) == 1, (expression, errors)
        errors.remove(found[0])
    assert not errors, errors
    assert "OpenGL errors" not in said, said
    with numpy.load(name) as saved:
        return dict(saved), said


def largest(found, expected):
    """The largest difference; nan, which says that nothing was found, is equal to nan."""
    assert found.shape == expected.shape, (found.shape, expected.shape)
    assert (numpy.isnan(found) == numpy.isnan(expected)).all(), (found, expected)
    return numpy.abs(numpy.nan_to_num(found) - numpy.nan_to_num(expected)).max()


def answers_of_batch(ranks, folder):
    found, said = batch(ranks, folder, expected=[line.format(ranks) for line in REFUSALS])
    for reason in REASONS:
        sentence = f"The first of {ranks} MPI ranks holds and draws the whole volume: {reason}"
        assert sentence in said, (sentence, said)
    return found


def load_plugin_on_ranks():
    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=simple.__dict__)
    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=True, ns=simple.__dict__)


if __name__ == "__main__":
    load_plugin_on_ranks()
    MANY = vtkMultiProcessController.GetGlobalController().GetNumberOfProcesses() > 4
    numpy.savez(sys.argv[1], **(answers_of_many if MANY else answers)(sys.argv[2]))
