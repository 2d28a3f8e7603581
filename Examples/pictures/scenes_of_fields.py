# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of the documentation that show lattices, displacement fields and moved geometry."""

import os
import tempfile

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import stage

FOCUS = (-325.0, 30.0, 500.0)
HALF_MM = 52.0
ARROWS_MM = 7.0  # between arrows
LANDMARKS_MM = 14.0  # between landmarks
IN_FRONT_MM = 8.0  # of a slice, so that what lies in its plane is seen
LARGEST_MM = 12.0
CONTACTS, PITCH_MM = 5, 10.0  # of a grid of electrodes, a side
BEHIND = (-310.0, -15.0, 475.0)  # the control points that move

# Displacements of the second input's points from those of the first.
MOVED_BY = """
import numpy
shift = numpy.asarray(inputs[1].Points) - numpy.asarray(inputs[0].Points)
output.ShallowCopy(inputs[1].VTKObject)
output.PointData.append(numpy.linalg.norm(shift, axis=1), "Moved (mm)")
"""

# The control points that moved by more than half a millimetre, where they moved to.
CONTROL_POINTS = """
import numpy
image, shift = inputs[0].VTKObject, numpy.asarray(inputs[0].PointData["Displacement"])
rest = numpy.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
length = numpy.linalg.norm(shift, axis=1)
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.util.numpy_support import numpy_to_vtk
points = vtkPoints()
points.SetData(numpy_to_vtk((rest + shift)[length > 0.5], deep=True))
output.VTKObject.SetPoints(points)
output.PointData.append(length[length > 0.5], "Moved (mm)")
"""


def _push():
    return stage.push(-LARGEST_MM, 80.0, 35.0)


def _slice_of(bent, side):
    made = stage.flat_view(side, FOCUS, HALF_MM)
    stage.show_slices(bent, made)
    return made


def _moved_forward(source):
    """Towards the eye of a coronal view."""
    moved = simple.Transform(Input=source)
    moved.Transform.Translate = (0.0, IN_FRONT_MM, 0.0)
    return moved


def lattice_layer(bent):
    """The layer of control points nearest to the coronal slice, as bent, as lines."""
    lattice = simple.DeformationLattice(Input=bent)
    lattice.UpdatePipeline()
    information = lattice.GetDataInformation()
    low, high = information.GetBounds()[2:4]
    last = information.GetExtent()[3]
    layer = round((stage.CORTEX[1] - low) / (high - low) * last)
    subset = simple.ExtractSubset(Input=lattice, VOI=[0, 18, layer, layer, 0, 18])
    return _moved_forward(stage.as_bent(subset))


def free_form_deformation(width):
    """A coronal slice with a layer of the lattice, as loaded and bent."""
    side = width // 2
    views = []
    for strokes in ((), _push()):
        bent = stage.bend(stage.head(), strokes)
        made = _slice_of(bent, side)
        display = stage.show_surface(lattice_layer(bent), made, stage.CYAN)
        display.SetRepresentationType("Wireframe")
        display.LineWidth, display.Ambient, display.Diffuse = 1.5, 1.0, 0.0
        views.append(made)
    return stage.side_by_side(views)


def deformation_lattice(width):
    """The brain as bent, and those control points that moved, by how far, before a slice."""
    side = width // 2
    bent = stage.bend(stage.brain(), _push())
    moved = simple.ProgrammableFilter(Input=simple.DeformationLattice(Input=bent),
                                      Script=CONTROL_POINTS, OutputDataSetType="vtkPolyData")
    balls = simple.Glyph(Input=moved, GlyphType="Sphere", GlyphMode="All Points",
                         ScaleArray=["POINTS", "No scale array"])
    balls.ScaleFactor = 4.0
    views = [stage.brain_view(bent, side), stage.view(side)]
    stage.color_by(balls, views[1], "Moved (mm)", "mm", 0.0, LARGEST_MM, component=None)
    slices = stage.show_slices(bent, views[1], array="Brain", position=BEHIND)
    slices.MapSliceOpacity = 1
    stage.look_at_brain(views[1])
    return stage.side_by_side(views)


def _arrows(bent, made, direction):
    field = simple.DeformationField(Input=bent, Direction=direction, SampleGrid="Given Spacing",
                                    Spacing=[ARROWS_MM, ARROWS_MM, ARROWS_MM])
    field.UpdatePipeline()
    low, high = field.GetDataInformation().GetBounds()[2:4]
    last = field.GetDataInformation().GetExtent()
    layer = round((stage.CORTEX[1] - low) / (high - low) * last[3])
    subset = simple.ExtractSubset(Input=field, VOI=[0, last[1], layer, layer, 0, last[5]])
    arrows = simple.Glyph(Input=subset, GlyphType="Arrow", GlyphMode="All Points",
                          OrientationArray=["POINTS", "Displacement"],
                          ScaleArray=["POINTS", "Displacement"])
    arrows.ScaleFactor = 1.0  # ParaView chooses one of its own while the filter is made
    arrows.GlyphType.ShaftRadius, arrows.GlyphType.TipRadius = 0.05, 0.14
    display = stage.color_by(_moved_forward(arrows), made, "Displacement", "mm", 0.0, LARGEST_MM)
    display.Ambient, display.Diffuse = 0.6, 0.4


def deformation_field(width):
    """Backward displacements over the bent slice; Jacobian determinants over it at rest."""
    side = width // 2
    bent = stage.bend(stage.head(), _push())
    first = _slice_of(bent, side)
    _arrows(bent, first, "Backward")
    second = _slice_of(stage.bend(stage.head()), side)
    field = simple.DeformationField(Input=bent, Direction="Forward", SampleGrid="Given Spacing",
                                    Spacing=[1.5, 1.5, 1.5])
    cut = simple.Slice(Input=field)
    cut.SliceType.Origin, cut.SliceType.Normal = stage.CORTEX, (0, 1, 0)
    display = stage.color_by(_moved_forward(cut), second, "JacobianDeterminant", "Jacobian", 0.6,
                             1.4, component=None)
    display.Opacity, display.Ambient, display.Diffuse = 0.6, 1.0, 0.0
    return stage.side_by_side([first, second])


def invert(width):
    """The forward field over the slice as loaded; the backward one over the slice as bent."""
    side = width // 2
    views = []
    for strength, direction in ((0.0, "Forward"), (1.0, "Backward")):
        shown = stage.bend(stage.head(), _push(), Strength=strength)
        views.append(_slice_of(shown, side))
        _arrows(stage.bend(stage.head(), _push()), views[-1], direction)
    return stage.side_by_side(views)


def field_files(width):
    """A brain bent by a stroke, and drawn through the field that was saved of it."""
    import brainshift
    side = width // 2
    bent = stage.bend(stage.brain(), stage.push())
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "field.nii.gz")
        brainshift.save_field(bent, file, spacing=(3.0, 3.0, 3.0))
        loaded = stage.bend(stage.brain(), Lattice=brainshift.load_field(file))
        views = [stage.brain_view(bent, side), stage.brain_view(loaded, side)]
        return stage.side_by_side(views)


def _landmark_table(file):
    """Writes landmarks of a coronal plane as a table."""
    steps = [step * LANDMARKS_MM for step in range(-3, 4)]
    places = [(FOCUS[0] + x, stage.CORTEX[1], FOCUS[2] + z) for x in steps for z in steps]
    with open(file, "w", encoding="utf-8") as table:
        print("x,y,z", *(f"{x},{y},{z}" for x, y, z in places), sep="\n", file=table)


def _show_landmarks(points, made):
    balls = simple.Glyph(Input=_moved_forward(points), GlyphType="Sphere",
                         GlyphMode="All Points", ScaleArray=["POINTS", "No scale array"])
    balls.ScaleFactor = 3.0
    stage.show_surface(balls, made, stage.CYAN)


def slicer_scene(width):
    """A slice and landmarks at rest, and as a scene brings them that was saved of the bent one."""
    import brainshift
    side = width // 2
    with tempfile.TemporaryDirectory() as folder:
        table, scene = os.path.join(folder, "points.csv"), os.path.join(folder, "scene.mrb")
        _landmark_table(table)
        brainshift.save_scene(scene, stage.bend(stage.head(), _push()), points=table,
                              hardened=False, spacing=4.0)
        found = brainshift.open_scene(scene)
        views = []
        for shown, points in ((stage.bend(stage.head()), simple.LandmarkReader(FileName=table)),
                              (*found.volumes.values(), *found.points.values())):
            views.append(_slice_of(shown, side))
            _show_landmarks(points, views[-1])
        return stage.side_by_side(views)


def landmark_files(width):
    """Landmarks of a table over the slice as loaded; those of the mapped file over it as bent."""
    import brainshift
    side = width // 2
    bent = stage.bend(stage.head(), _push())
    with tempfile.TemporaryDirectory() as folder:
        files = os.path.join(folder, "rest.csv"), os.path.join(folder, "bent.mrk.json")
        _landmark_table(files[0])
        brainshift.map_points(*files, bent)
        views = []
        for file, shown in zip(files, (stage.bend(stage.head()), bent)):
            views.append(_slice_of(shown, side))
            _show_landmarks(simple.LandmarkReader(FileName=file), views[-1])
        return stage.side_by_side(views)


def _write_as_freesurfer(mesh, name):
    """A mesh of RAS mm as FreeSurfer keeps it: in tkRAS of a conformed volume whose middle is the
    brain's, with the geometry of that volume behind the triangles."""
    data = simple.servermanager.Fetch(mesh)
    points = vtk_to_numpy(data.GetPoints().GetData()) - numpy.array(stage.CENTRE)
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    middle = " ".join(map(str, stage.CENTRE))
    with open(name, "wb") as file:
        file.write(b"\xff\xff\xfecreated for a picture\n\n")
        file.write(numpy.array([len(points), len(triangles)], ">i4").tobytes())
        file.write(points.astype(">f4").tobytes() + triangles.astype(">i4").tobytes())
        file.write(numpy.array([2, 0, 20], ">i4").tobytes())
        file.write(b"valid = 1  # volume info valid\nfilename = orig.mgz\nvolume = 256 256 256\n"
                   b"voxelsize = 1 1 1\nxras = -1 0 0\nyras = 0 0 -1\nzras = 0 1 0\n")
        file.write(f"cras = {middle}\n".encode())


def surfaces(width):
    """The outline of a surface from a FreeSurfer file, over the slice as loaded and as bent."""
    side = width // 2
    bent = stage.bend(stage.head(), _push())
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "lh.pial")
        _write_as_freesurfer(simple.Triangulate(Input=stage.cortex(stage.brain())), name)
        surface = simple.SurfaceReader(FileName=name)
        moved = simple.DeformGeometry(Input=surface, Deformation=bent)
        views = []
        for shown, volume in ((surface, stage.bend(stage.head())), (moved, bent)):
            views.append(_slice_of(volume, side))
            cut = simple.Slice(Input=shown, SliceType="Plane")
            cut.SliceType.Origin, cut.SliceType.Normal = stage.CORTEX, (0.0, 1.0, 0.0)
            stage.show_surface(_moved_forward(cut), views[-1], stage.YELLOW, LineWidth=1.5)
        return stage.side_by_side(views)


def _contacts_on(mesh):
    """Contacts of a grid laid over a mesh of the cortex, across its sulci; mm."""
    data = simple.servermanager.Fetch(mesh)
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    out = numpy.subtract(stage.CORTEX, stage.CENTRE)
    out /= numpy.linalg.norm(out)
    along = numpy.cross(out, (0.0, 1.0, 0.0))
    along /= numpy.linalg.norm(along)
    axes = numpy.stack((along, numpy.cross(out, along), out))
    places = (points - stage.CORTEX) @ axes.T
    steps = PITCH_MM * (numpy.arange(CONTACTS) - 0.5 * (CONTACTS - 1))
    contacts = []
    for across in steps:
        for beside in steps:
            near = numpy.linalg.norm(places[:, :2] - (across, beside), axis=1) < 0.6 * PITCH_MM
            height = places[near & (places[:, 2] > -30.0), 2].max()
            contacts.append(stage.CORTEX + numpy.array((across, beside, height)) @ axes)
    return numpy.array(contacts)


def electrode_grids(width):
    """Contacts of a grid on the brain as bent, and the tissue under them on the brain as loaded."""
    import brainshift
    side = width // 2
    bent = stage.bend(stage.brain(), stage.push())
    contacts = _contacts_on(
        simple.DeformGeometry(Input=stage.cortex(stage.brain()), Deformation=bent))
    found = brainshift.electrodes(contacts, stage.mask())
    views = []
    for volume, points in ((bent, contacts), (stage.bend(stage.brain()), found.rest)):
        views.append(stage.brain_view(volume, side))
        stage.show_balls(points, views[-1], stage.CYAN)
    return stage.side_by_side(views)


def moments(width):
    """A brain at two moments of a surgery, and half way between them."""
    side = width // 3
    volume = stage.brain()
    steps = simple.Moments(Input=[stage.bend(volume), stage.bend(volume, stage.push())],
                           Times=[0.0, 60.0])
    views = []
    for minutes in (0.0, 30.0, 60.0):
        views.append(stage.brain_view(steps, side))
        views[-1].ViewTime = minutes
    return stage.side_by_side(views)


# Focus, eye and angle of a view into the cavity, from the left, front and above.
CAVITY_VIEW = (-322, 28, 492), (-540, 250, 730), 11


def _inwards(places):
    """How deep places (mm) lie on the way from the cortex to the middle of the brain, and how far
    from it, mm."""
    inwards = numpy.subtract(stage.CENTRE, stage.CORTEX)
    inwards /= numpy.linalg.norm(inwards)
    deep = (places - stage.CORTEX) @ inwards
    return deep, numpy.linalg.norm(places - stage.CORTEX - deep[:, None] * inwards, axis=1)


def _tumour(places):
    deep, aside = _inwards(places)
    return (deep - 13.0) ** 2 + aside ** 2 < 14.0 ** 2


def _cavity(places):
    """Open to the outside; on one side of the tumour it does not reach far enough."""
    deep, aside = _inwards(places + (3.5, 0.0, 2.0))
    return (numpy.maximum(deep - 22.0, 0.0) ** 2 + aside ** 2 < 13.0 ** 2)


def resection(width):
    """A brain that sank after a tumour was removed: in 3D, and a slice of it."""
    side = width // 2
    resected = simple.Resection(
        Input=stage.bend(stage.brain(), stage.push()),
        Tumour=stage.labels_of("Tumour", _tumour), Cavity=stage.labels_of("Cavity", _cavity))
    views = [stage.brain_view(resected, side),
             stage.flat_view(side, numpy.add(stage.CORTEX, (22.0, 0.0, -30.0)), 58.0)]
    stage.demo.frame(views[0], *CAVITY_VIEW)
    stage.show_slices(resected, views[1], array="Brain",
                      position=numpy.subtract(stage.CORTEX, (0.0, 4.0, 0.0)))
    return stage.side_by_side(views)


def deform_geometry(width):
    """A mesh of the brain as loaded, and moved along, coloured by how far, before a slice."""
    side = width // 2
    mesh = stage.cortex(stage.brain())
    moved = simple.DeformGeometry(Input=mesh, Deformation=stage.bend(stage.brain(), _push()))
    colored = simple.ProgrammableFilter(Input=[mesh, moved], Script=MOVED_BY)
    views = [stage.view(side), stage.view(side)]
    stage.show_surface(mesh, views[0], (0.85, 0.85, 0.85), Specular=0.2)
    stage.color_by(colored, views[1], "Moved (mm)", "mm", 0.0, LARGEST_MM, component=None)
    for made in views:
        stage.look_at_brain(made)
    return stage.side_by_side(views)


FIELD_SCENES = {
    "filter-free-form-deformation": free_form_deformation,
    "filter-deformation-lattice": deformation_lattice,
    "filter-deformation-field": deformation_field,
    "filter-invert-displacement-field": invert,
    "filter-displacement-field-files": field_files,
    "filter-landmark-files": landmark_files,
    "filter-slicer-scenes": slicer_scene,
    "filter-surfaces-and-tracts": surfaces,
    "filter-electrode-grids": electrode_grids,
    "filter-moments": moments,
    "filter-resection": resection,
    "filter-deform-geometry": deform_geometry}
