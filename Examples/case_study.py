# SPDX-License-Identifier: BSD-3-Clause
"""Bends the MR of a brain to what is seen after its craniotomy and resection.

    pvpython case_study.py [FOLDER]   prints the figures, draws into FOLDER (demo-output)

The "post-operative" volume is synthetic. It is the pre-operative MR, bent by a known sag of soft
strokes on a denser lattice, with a cavity. Ten stamps, four and nine pulls, and a fit are found
from 300 noisy points that a pointer traced on the exposed cortex. Nothing else is used to find
them. The known sag serves to measure the error that is left. If the plugin is not loaded
yet, BRAINSHIFT_PLUGIN gives its path.
Research software, not a medical device.
"""

import os
import sys
import time

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Testing", "Data")

# The patient, RAS mm. The head lies so that the craniotomy is on top; gravity pulls through it.
CRANIOTOMY = numpy.array((-340.0, 30.0, 523.0))  # middle of the exposed cortex
EXPOSED_MM = 35.0  # radius of what a pointer can reach
GRAVITY = numpy.array((0.30, 0.15, -0.94))
CAVITY_CENTRE = CRANIOTOMY + (12.0, -12.0, -12.0)
CAVITY_MM = 10.0
CAVITY_MARGIN_MM = 2.0  # a cavity is drawn generously: its walls are not cortex

TRACE_POINTS = 300
NOISE_MM = 0.5  # of the pointer, standard deviation along each axis
LANDMARKS = 50
LANDMARK_REACH_MM = 70.0  # from the craniotomy; farther off, nothing moved
SEED = 20090212

STAMPS = 10
# From coarse to fine: what all of the trace says first, then smaller regions of it.
REGIONS_MM = numpy.geomspace(EXPOSED_MM, 10.0, STAMPS)  # radii
STAMP_PER_REGION = 2.0  # a stamp falls to one half at about 0.6 of its radius

PULLS = (4, 9)

COLUMNS = ("trace mean", "RMS", "95th percentile", "TRE mean", "TRE largest",
           "smallest determinant")

# What the pictures show: half their height (mm), what is in the middle, the ends of the colours.
WHITE = 330.0  # scalar of the MR
CORTEX = (50.0, 100.0)  # scalars between which the brain turns opaque
SLICE_HALF_MM = 75.0
SLICE_FOCUS = (20.0, 0.0, -35.0)  # from the cavity
TRACE_HALF_MM = 85.0
TRACE_FOCUS = (25.0, -5.0, -25.0)  # from the craniotomy
TRACE_SCALE_MM = 6.0
#: As the window shows a trace: purple inside, white at the cortex, green outside.
TRACE_COLORS = (-1, 0.48, 0, 0.75, -0.25, 0.75, 0.35, 1, 0, 1, 1, 1,
                0.25, 0.2, 0.85, 0.3, 1, 0, 0.5, 0.1)
TRACE_BALL_MM = 1.4  # radius

# "Inside" is the mask with its voxels' steps smoothed; 0.5 is the cortex.
BRAIN = """
import numpy
intensity, mask = (image.PointData["Intensity"] for image in inputs)
inside = numpy.asarray(mask, numpy.float32).reshape(inputs[0].GetDimensions()[::-1])
for repetition in range(6):
    for axis in range(3):
        inside = (numpy.roll(inside, 1, axis) + 2 * inside + numpy.roll(inside, -1, axis)) / 4
share = numpy.clip((inside - 0.4) / 0.4, 0, 1)
output.PointData.append((intensity * share.ravel()).astype(numpy.float32), "Brain")
output.PointData.append(inside.ravel(), "Inside")
output.PointData.SetActiveScalars("Brain")
"""

# Removes the voxels within `radius` of `centre`. The array "Cavity" marks them.
CAVITY = """
import numpy
image = inputs[0].VTKObject
matrix = image.GetIndexToPhysicalMatrix()
world = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(3)])
k, j, i = numpy.indices(image.GetDimensions()[::-1])
offsets = [world[a, 0] * i + world[a, 1] * j + world[a, 2] * k + world[a, 3] - {centre}[a]
           for a in range(3)]
distance = numpy.linalg.norm(offsets, axis=0).ravel()
for name in ("Brain", "Inside"):
    left = numpy.clip(distance - {radius} + 0.5, 0, 1).astype(numpy.float32)
    output.PointData.append(inputs[0].PointData[name] * left, name)
drawn = (distance < {radius} + {margin}).astype(numpy.uint8)
output.PointData.append(drawn, "Cavity")
output.PointData.SetActiveScalars("{scalars}")
"""


def load_plugin():
    definitions = servermanager.ActiveConnection.Session.GetSessionProxyManager()
    if not definitions.GetProxyDefinitionManager().HasDefinition("filters", "FreeFormDeformation"):
        simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=vars(simple))


# The patient --------------------------------------------------------------------------------------


def preoperative_brain():
    """The MR without its skull: "Brain", and "Inside", which is 0.5 at the cortex."""
    head, mask = (simple.NIFTIVolumeReader(FileName=os.path.join(DATA, "seg3d-utah", file))
                  for file in ("seg3d_mr_t1.nii.gz", "seg3d_brainmask.nii.gz"))
    brain = simple.ProgrammableFilter(Input=[head, mask], Script=BRAIN)
    brain.UpdatePipeline()
    return brain


def known_sag(brain, scale=1.0):
    """What happened, hidden from the tool: a deep sag, more of it in front, less beside. `scale`
    multiplies all of it."""
    import brainshift
    beside = scale * numpy.array((0.5, -1.0, 0.5))
    strokes = (brainshift.soft(CRANIOTOMY, 6.5 * scale * GRAVITY, 90.0)
               + brainshift.soft(CRANIOTOMY + (-5, 25, -10), 2.5 * scale * GRAVITY, 45.0)
               + brainshift.soft(CRANIOTOMY + (0, -30, -15), beside, 40.0))
    return simple.FreeFormDeformation(Input=brain, Strokes=strokes,
                                      LatticeDimensions=[31, 31, 31])


def postoperative(baked, scalars):
    """The sunken brain with its cavity; `scalars` names the array that other filters take."""
    script = CAVITY.format(centre=CAVITY_CENTRE.tolist(), radius=CAVITY_MM,
                           margin=CAVITY_MARGIN_MM, scalars=scalars)
    return simple.ProgrammableFilter(Input=baked, Script=script)


def points_of(source):
    return vtk_to_numpy(servermanager.Fetch(source).GetPoints().GetData()).astype(float)


def pointer_trace(surgery, random):
    """Points anywhere on the exposed surface after surgery, the walls of the cavity included."""
    surface = simple.Contour(Input=surgery, ContourBy=["POINTS", "Inside"], Isosurfaces=[0.5])
    points = points_of(surface)
    exposed = points[numpy.linalg.norm(points - CRANIOTOMY, axis=1) < EXPOSED_MM]
    traced = random.choice(exposed, TRACE_POINTS, replace=False)
    traced += random.normal(0.0, NOISE_MM, traced.shape)
    return simple.PolyPointSource(Points=traced.ravel().tolist())


def landmarks(brain, sag, random):
    """Places in the brain at rest, near the craniotomy and not resected later."""
    import brainshift
    reach = LANDMARK_REACH_MM * random.uniform(-1.0, 1.0, (20 * LANDMARKS, 3))
    reach = reach[numpy.linalg.norm(reach, axis=1) < LANDMARK_REACH_MM]
    probe = simple.ResampleWithDataset(
        SourceDataArrays=brain,
        DestinationMesh=simple.PolyPointSource(Points=(CRANIOTOMY + reach).ravel().tolist()))
    inside = vtk_to_numpy(servermanager.Fetch(probe).GetPointData().GetArray("Inside")) > 0.9
    places = (CRANIOTOMY + reach)[inside]
    from_cavity = numpy.linalg.norm(
        brainshift.deformed_from_rest(sag, places) - CAVITY_CENTRE, axis=1)
    return places[from_cavity > CAVITY_MM][:LANDMARKS]


# The tool -----------------------------------------------------------------------------------------


def measured_distances(measure):
    """Where each trace point that counts lies, and how far (mm) out of the cortex as bent."""
    measure.UpdatePipeline()
    result = servermanager.Fetch(measure)
    distances = vtk_to_numpy(result.GetPointData().GetArray("DistanceToCortex"))
    counts = numpy.isfinite(distances)
    return points_of(measure)[counts], distances[counts].astype(float)


def next_stamp(points, distances, point_of_interest, region_mm):
    """A stamp for the region of the trace that lies farthest off on average, by that distance."""
    import brainshift
    apart = numpy.linalg.norm(points[:, None] - points[None], axis=2)
    near = (apart < region_mm).astype(float)
    means = near @ distances / near.sum(axis=1)
    worst = numpy.argmax(numpy.abs(means))
    traced = near[worst] @ points / near[worst].sum()
    outwards = (traced - point_of_interest) / numpy.linalg.norm(traced - point_of_interest)
    cortex = traced - means[worst] * outwards  # the tissue to take hold of
    radius = STAMP_PER_REGION * region_mm
    return brainshift.stamp(cortex, point_of_interest, means[worst], radius, radius)


def stamp_to_trace(bent, measure):
    """Adds stamps one after the other, each found from the distances that the last one left."""
    for region_mm in REGIONS_MM:
        points, distances = measured_distances(measure)
        stamp = next_stamp(points, distances, numpy.array(bent.PointOfInterest),
                           region_mm)
        bent.Strokes = tuple(bent.Strokes) + stamp


def regions_of(points, count):
    """The number of a region for each point: compact parts of about the same size (k-means)."""
    middles = points[:1]
    while len(middles) < count:  # each start lies farthest from those before it
        apart = numpy.linalg.norm(points[:, None] - middles[None], axis=2).min(axis=1)
        middles = numpy.vstack((middles, points[apart.argmax()]))
    for _ in range(20):
        region = numpy.linalg.norm(points[:, None] - middles[None], axis=2).argmin(axis=1)
        middles = numpy.array([points[region == i].mean(axis=0) for i in range(count)])
    return region


def pulls_to_trace(points, distances, point_of_interest, count):
    """Pulls as a hand makes them: in each region, tissue of the cortex to the trace over it."""
    region = regions_of(points, count)
    pulls = []
    for i in range(count):
        traced, distance = points[region == i].mean(axis=0), distances[region == i].mean()
        outwards = (traced - point_of_interest) / numpy.linalg.norm(traced - point_of_interest)
        pulls.append((traced - distance * outwards, traced))
    return pulls


def pull_to_trace(case, count):
    """Bends by that many pulls; the cortex beyond the opening is held."""
    import brainshift
    pulls = pulls_to_trace(*measured_distances(case.measure),
                           numpy.array(case.bent.PointOfInterest), count)
    return brainshift.fit(case.bent, pulls=pulls, array="Inside", threshold=0.5,
                          opening=(CRANIOTOMY, EXPOSED_MM))


def fit_to_trace(case):
    """Bends by all of the trace at once."""
    import brainshift
    return brainshift.fit(case.bent, traces=points_of(case.trace), array="Inside", threshold=0.5,
                          opening=(CRANIOTOMY, EXPOSED_MM), cavity=case.cavity)


# Figures and pictures -----------------------------------------------------------------------------


class Case:
    """The patient before and after surgery, the volume to bend, and what is measured of it.

    `scale` multiplies the sag.
    """

    def __init__(self, scale=1.0):
        random = numpy.random.default_rng(SEED)
        self.brain = preoperative_brain()
        self.sag = known_sag(self.brain, scale)
        sunken = simple.BakeDeformation(Input=self.sag, Interpolation="Cubic")
        self.after_surgery = postoperative(sunken, "Brain")
        self.trace = pointer_trace(self.after_surgery, random)
        self.landmarks = landmarks(self.brain, self.sag, random)
        self.bent = simple.FreeFormDeformation(Input=self.brain)
        self.cavity = postoperative(sunken, "Cavity")
        self.measure = simple.TraceDistance(
            Input=self.trace, Deformation=self.bent, Cavity=self.cavity,
            SurfaceArray="Inside", Threshold=0.5)
        self.compare = simple.CompareVolumes(Input=self.bent, Reference=self.after_surgery,
                                             Cavity=self.cavity)

    def straighten(self):
        """Leaves the volume as it was at rest."""
        self.bent.Strokes, self.bent.Lattice = (), None

    def figures(self):
        """Trace distance and target registration error (TRE), mm; the smallest determinant."""
        import brainshift
        self.measure.UpdatePipeline()
        self.measure.UpdatePropertyInformation()
        self.bent.UpdatePipeline()
        self.bent.UpdatePropertyInformation()
        error = numpy.linalg.norm(brainshift.deformed_from_rest(self.bent, self.landmarks)
                                  - brainshift.deformed_from_rest(self.sag, self.landmarks), axis=1)
        return {"count": self.measure.Count, "trace mean": self.measure.Mean,
                "RMS": self.measure.RMS, "95th percentile": self.measure.Percentile95,
                "TRE mean": float(error.mean()), "TRE largest": float(error.max()),
                "smallest determinant": self.bent.MinimumJacobian}


def parallel_view(towards_eye, focus, half_height, size):
    """A black view from that side at `focus` (mm), superior up."""
    view = simple.CreateView("RenderView", ViewSize=(size, size))
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = (0.0, 0.0, 0.0)
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    simple.Render(view)  # the first picture of a session finds a camera of its own
    view.CameraFocalPoint = focus
    view.CameraPosition = focus + 400.0 * numpy.array(towards_eye)
    view.CameraViewUp = (0, 0, 1)
    view.CameraParallelProjection = 1
    view.CameraParallelScale = half_height
    return view


def show_red_green(compare, plane, towards_eye, size):
    """One plane through the cavity: as bent red, as it is after surgery green, both yellow."""
    view = parallel_view(towards_eye, CAVITY_CENTRE + SLICE_FOCUS, SLICE_HALF_MM, size)
    display = simple.Show(compare, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    simple.ColorBy(display, ("POINTS", "Brain"), separate=True)
    display.SetScalarBarVisibility(view, False)
    for other in ("Sagittal", "Coronal", "Axial"):
        setattr(display, f"Show{other}", int(other == plane))
    display.SlicePosition = CAVITY_CENTRE
    display.OrientationMarks = 1
    display.WorldAxes = "RAS"  # as in the head's file; what makes the cavity drops the word
    display.SliceComparison = "Two colours"
    color = simple.GetColorTransferFunction("Brain", display, separate=True)
    color.ColorSpace = "RGB"
    color.RGBPoints = (0, 0, 0, 0, WHITE, 1, 1, 1)
    display.ReferenceRange = (0, WHITE)
    return view


def cortex_view(size):
    """From above and the left."""
    return parallel_view((-0.4, -0.5, 0.75), CRANIOTOMY + TRACE_FOCUS, TRACE_HALF_MM, size)


def show_cortex(compare, size):
    """Both brains: red where the bent one lies before the other, green where it lies behind, yellow
    where their surfaces agree, grey in the cavity."""
    view = cortex_view(size)
    display = simple.Show(compare, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "Brain"), separate=True)
    display.SetScalarBarVisibility(view, False)
    opacity = simple.GetOpacityTransferFunction("Brain", display, separate=True)
    opacity.Points = (0, 0, 0.5, 0, CORTEX[0], 0, 0.5, 0, CORTEX[1], 1, 0.5, 0, WHITE, 1, 0.5, 0)
    display.ScalarOpacityUnitDistance = 1.0
    display.Shade = 1
    return view


def show_trace(bent, measure, size):
    """The brain as bent, and the trace coloured by its distance."""
    view = cortex_view(size)
    brain = simple.Show(bent, view, "UniformGridRepresentation")
    brain.SetRepresentationType("Deformed Volume")
    simple.ColorBy(brain, ("POINTS", "Brain"), separate=True)
    brain.SetScalarBarVisibility(view, False)
    brain.Shade = 1
    color = simple.GetColorTransferFunction("Brain", brain, separate=True)
    color.ColorSpace = "RGB"
    color.RGBPoints = (0, 0.25, 0.2, 0.18, WHITE, 0.85, 0.72, 0.65)
    opacity = simple.GetOpacityTransferFunction("Brain", brain, separate=True)
    opacity.Points = (0, 0, 0.5, 0, 0.15 * WHITE, 0, 0.5, 0, 0.4 * WHITE, 1, 0.5, 0)
    points = simple.Show(measure, view)  # as Trace Points: faded where they lie below the cortex
    points.TraceRadius = TRACE_BALL_MM
    simple.ColorBy(points, ("POINTS", "DistanceToCortex"))
    color = simple.GetColorTransferFunction("DistanceToCortex")
    color.ColorSpace, color.RGBPoints = "RGB", TRACE_COLORS
    color.RescaleTransferFunction(-TRACE_SCALE_MM, TRACE_SCALE_MM)
    bar = simple.GetScalarBar(color, view)
    bar.Title, bar.ComponentTitle = "mm above the cortex", ""
    bar.RangeLabelFormat = "{:.0f}" if "{" in bar.RangeLabelFormat else "%.0f"
    points.SetScalarBarVisibility(view, True)
    return view


def draw(case, file, size=450):
    """Coronal and sagittal slice, the cortex and the trace, side by side."""
    views = [show_red_green(case.compare, "Coronal", (0, 1, 0), size),
             show_red_green(case.compare, "Sagittal", (-1, 0, 0), size),
             show_cortex(case.compare, size),
             show_trace(case.bent, case.measure, size)]
    layout = simple.CreateLayout()
    layout.AssignView(0, views[0])
    for number in range(1, len(views)):
        share = 1.0 / (len(views) - number + 1)
        left = layout.SplitViewHorizontal(views[number - 1], share)
        layout.AssignView(left + 1, views[number])
    simple.SaveScreenshot(file, layout, ImageResolution=(len(views) * size, size))
    for view in views:
        simple.Delete(view)
    simple.Delete(layout)


def report(case, title, seconds=0.0):
    """Prints one row. Seconds are those that the machine needed to find the bend."""
    figures = case.figures()
    print(f"{title:10}", *(f"{figures[name]:{len(name)}.2f}" for name in COLUMNS),
          f"{seconds:7.2f}", sep="  ")


def report_and_draw(case, title, folder, seconds=0.0):
    report(case, title, seconds)
    draw(case, os.path.join(folder, f"case-study-{title}.png"))


def timed(bend, *arguments):
    """How long (s) a bend takes to be found and applied."""
    start = time.perf_counter()
    bend(*arguments)
    return time.perf_counter() - start


def main(folder):
    os.makedirs(folder, exist_ok=True)
    case = Case()
    counted = case.figures()["count"]
    print(f"{counted} of {TRACE_POINTS} traced points count; lengths in mm; pictures in {folder}")
    print(f"{'':10}", *COLUMNS, "seconds", sep="  ")
    report_and_draw(case, "before", folder)
    seconds = timed(stamp_to_trace, case.bent, case.measure)
    report_and_draw(case, "after", folder, seconds)
    for count in PULLS:
        case.straighten()
        report(case, f"{count} pulls", timed(pull_to_trace, case, count))
    case.straighten()
    seconds = timed(fit_to_trace, case)
    report_and_draw(case, "fit", folder, seconds)


load_plugin()
if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "demo-output")
