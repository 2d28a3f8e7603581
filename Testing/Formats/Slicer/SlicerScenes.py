# SPDX-License-Identifier: BSD-3-Clause
# Proves that what a scene of 3D Slicer holds opens where Slicer shows it: landmarks, surfaces and
# voxels below linear, grid, B-spline and nested transforms of both directions lie within 0.001 mm
# of where numpy, VTK's grid transform (Slicer's own) and ITK (transformix) take them; and that all
# that cannot be opened is said, one sentence each.
import os
import shutil
import warnings
import zipfile

import numpy
import slicer_testing as slicer
from brainshift_testing import data, load_plugin, output, run_tests, scratch
from outside_testing import FLIP, itk_text, mapped_outside, of_itk_text, write
from slicer_testing import HALF_TURN, STRETCH, TURN, Written, of_rows
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersHybrid import vtkBSplineTransform, vtkGridTransform
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift import openscene  # noqa: E402
from paraview import simple  # noqa: E402

NEAR = 1e-3  # mm
#: Landmarks of the world, RAS; no number is symmetric.
WORLD = numpy.random.default_rng(8).uniform((-40, -30, -20), (45, 35, 40), (12, 3))
VECTORS = slicer.grid_vectors(size=1.5)
SPLINE = ("BSplineTransform", numpy.random.default_rng(3).uniform(-3, 3, (3, 9, 10, 11)).ravel(),
          (11, 10, 9, -130, -120, -110, 26, 27, 28, 1, 0, 0, 0, 1, 0, 0, 0, 1))


def opened(path, **options):
    with warnings.catch_warnings(record=True):
        warnings.simplefilter("always")
        return brainshift.open_scene(path, **options)


def positions(source):
    source.UpdatePipeline()
    return vtk_to_numpy(output(source).GetPoints().GetData())


def assert_there(source, right):
    away = numpy.linalg.norm(positions(source) - right, axis=1).max()
    assert away < NEAR, away
    return away


def as_slicer(points, vectors):
    """RAS points moved by VTK's own grid transform, cubic, as Slicer sets it up."""
    image = vtkImageData()
    image.SetDimensions(*slicer.GRID_SIDES)
    image.SetOrigin(*slicer.GRID_ORIGIN)
    image.SetSpacing(*[slicer.GRID_STEP] * 3)
    image.GetPointData().SetScalars(numpy_to_vtk(vectors.reshape(-1, 3), deep=True))
    transform = vtkGridTransform()
    transform.SetDisplacementGridData(image)
    transform.SetInterpolationModeToCubic()
    return numpy.array([transform.TransformPoint(*(point * FLIP)) for point in points]) * FLIP


def test_linear_and_nested_transforms():
    scene = Written("linear")
    scene.linear("Outer", TURN)
    scene.linear("Inner", STRETCH, above="Outer")
    scene.landmarks("free", WORLD)
    scene.landmarks("turned", WORLD, above="Outer")
    scene.landmarks("both", WORLD, above="Inner")
    found = opened(scene.written())
    assert not found.notes, found.notes
    assert_there(found.points["free"], WORLD)
    assert_there(found.points["turned"], of_rows(TURN, WORLD))
    assert_there(found.points["both"], of_rows(TURN, of_rows(STRETCH, WORLD)))
    # The transforms by themselves: from the world to below them, and back.
    back = found.transforms["Inner"].map_back(WORLD)
    assert numpy.abs(back - of_rows(TURN @ STRETCH, WORLD)).max() < NEAR
    assert any(name.endswith(".tfm") for name in os.listdir(scene.path("scene-opened")))
    names = {name for name, _ in simple.GetSources()}
    assert {"both", "both at rest", "free"} <= names, names


def test_files_of_linear_transforms_lead_from_the_parent():
    scene = Written("linear files", version="Slicer4.4.0")
    inverse = numpy.linalg.inv(TURN)
    flip = numpy.array((-1.0, -1.0, 1.0))
    matrix, shift = flip[:, None] * inverse[:3, :3] * flip, flip * inverse[:3, 3]
    with open(scene.path("Drehung ä'1.tfm"), "w") as file:
        file.write(itk_text(("AffineTransform", (*matrix.ravel(), *shift), (0, 0, 0))))
    scene.stored("LinearTransform", "Filed", "Drehung ä'1.tfm", old=True)
    scene.landmarks("turned", WORLD, above="Filed", old=True)
    found = opened(scene.written())
    assert not found.notes, found.notes
    assert_there(found.points["turned"], of_rows(TURN, WORLD))


def test_grids_of_both_directions():
    scene = Written("grids")
    for kind in ("resampling", "modeling", ""):
        slicer.write_grid(scene.path(f"grid {kind}.nrrd"), VECTORS, kind)
        scene.stored("GridTransform", f"Grid{kind}", f"grid {kind}.nrrd")
    scene.landmarks("resampled", as_slicer(WORLD, VECTORS), above="Gridresampling")
    scene.landmarks("unsaid", as_slicer(WORLD, VECTORS), above="Grid")
    scene.landmarks("modelled", WORLD, above="Gridmodeling")
    far = numpy.array(((150.0, 20.0, 10.0), (-30.0, -130.0, 200.0)))  # outside the grid
    scene.landmarks("outside", far, above="Gridmodeling")
    scene.landmarks("edge", EDGE, above="Gridmodeling")
    found = opened(scene.written())
    assert not found.notes, found.notes
    assert_there(found.points["resampled"], WORLD)
    assert_there(found.points["unsaid"], WORLD)
    assert_there(found.points["modelled"], as_slicer(WORLD, VECTORS))
    assert_there(found.points["outside"], as_slicer(far, VECTORS))
    assert_there(found.points["edge"], as_slicer(EDGE, VECTORS))
    # ITK's way between the points is another one, by more than this test allows.
    assert numpy.abs(as_slicer(WORLD, VECTORS) - slicer.grid_moved(WORLD, VECTORS)).max() > 0.1


#: Points in the outermost cells of the grid, RAS.
EDGE = (slicer.GRID_ORIGIN + slicer.GRID_STEP * numpy.array(
    ((0.3, 5.2, 6.1), (18.7, 0.2, 14.6), (7.4, 16.8, 0.9), (18.2, 16.3, 14.1)))) * FLIP


def test_splines_nested_and_inverse():
    scene = Written("splines")
    with open(scene.path("spline.tfm"), "w") as file:
        file.write(itk_text(SPLINE))
    with open(scene.path("inverse.tfm"), "w") as file:
        file.write(itk_text(("Inverse" + SPLINE[0], *SPLINE[1:])))
    scene.linear("Outer", TURN)
    for kind, name in (("BSplineTransform", "spline"), ("Transform", "inverse")):
        scene.stored(kind, name, f"{name}.tfm", above="Outer")
    local = mapped_outside(WORLD, SPLINE)
    scene.landmarks("spline points", local, above="spline")
    scene.landmarks("inverse points", WORLD, above="inverse")
    found = opened(scene.written())
    assert not found.notes, found.notes
    assert_there(found.points["spline points"], of_rows(TURN, WORLD))
    assert_there(found.points["inverse points"], of_rows(TURN, local))


def as_slicers_spline(points, kind):
    """RAS points moved by VTK's B-spline transform, as Slicer sets it up: zero outside its grid."""
    _, parameters, fixed = kind
    image = vtkImageData()
    image.SetDimensions(*map(int, fixed[:3]))
    image.SetOrigin(*fixed[3:6])
    image.SetSpacing(*fixed[6:9])
    vectors = numpy.ascontiguousarray(numpy.reshape(parameters, (3, -1)).T)
    image.GetPointData().SetScalars(numpy_to_vtk(vectors, deep=True))
    transform = vtkBSplineTransform()
    transform.SetCoefficientData(image)
    transform.SetBorderModeToZero()
    return numpy.array([transform.TransformPoint(*(point * FLIP)) for point in points]) * FLIP


def test_splines_fade_around_their_grid():
    """On both sides of its border, where ITK's spline has ended."""
    scene = Written("fading splines")
    with open(scene.path("spline.tfm"), "w") as file:
        file.write(itk_text(SPLINE))
    scene.stored("BSplineTransform", "spline", "spline.tfm")
    cells = numpy.random.default_rng(6).uniform(-2.9, 1.2, (60, 3))
    cells[::2, 0] = 13.1 - cells[::2, 0]
    cells[::3, 1:] = (4.3, 5.2)
    around = (numpy.array(SPLINE[2][3:6]) + cells * SPLINE[2][6:9]) * FLIP
    scene.landmarks("around", as_slicers_spline(around, SPLINE), above="spline")
    found = opened(scene.written())
    assert_there(found.points["around"], around)
    ends = numpy.abs(mapped_outside(around, SPLINE) - as_slicers_spline(around, SPLINE)).max()
    assert ends > 0.1, ends


def test_points_without_a_position_are_said():
    scene = Written("folded")
    holes, folds = VECTORS.copy(), slicer.grid_vectors(size=40.0)
    holes[5:12] = numpy.nan
    for name, vectors in (("holes", holes), ("folds", folds)):
        slicer.write_grid(scene.path(f"{name}.nrrd"), vectors, "resampling")
        scene.stored("GridTransform", name, f"{name}.nrrd")
        scene.landmarks(f"in {name}", WORLD, above=name)
    simple.SaveData(scene.path("ball.vtp"), simple.Sphere(Radius=30))
    scene.stored("Model", "ball in holes", "ball.vtp", above="holes",
                 storage={"coordinateSystem": "LPS"})
    found = opened(scene.written())
    assert "in holes" not in found.points and not found.models, found
    left = [name for name, _ in simple.GetSources() if "in holes" in name]
    assert not left, left
    assert sum("in holes' is not opened" in note for note in found.notes) == 2, found.notes
    # A fold without a solution is told, or each point is where the grid takes it back.
    back = as_slicer(positions(found.points["in folds"]), folds) if "in folds" in (
        found.points) else WORLD + 1.0
    assert any("'in folds'" in note for note in found.notes) or (
        numpy.abs(back - WORLD).max() < NEAR), found.notes


def test_slicers_own_transforms():
    folder = data("transforms", "slicer-transforms")
    scene = Written("own", version="Slicer4.4.0")
    for name in ("Bspline-f-m.tfm", "TpsTransform.h5", "rotationAndAffine.tfm"):
        shutil.copy(os.path.join(folder, name), scene.path("TestData/" + name))
        scene.stored("Transform", name, "TestData/" + name, old=True)
        scene.landmarks("below " + name, WORLD, above=name, old=True)
    found = opened(scene.written())
    for name in ("Bspline-f-m.tfm", "TpsTransform.h5"):
        back = brainshift.read_transform(os.path.join(folder, name)).map(
            positions(found.points["below " + name]))
        assert numpy.abs(back - WORLD).max() < NEAR, name
    # Two transforms in a file that is no composite: it is refused, and so are its points.
    assert len(found.notes) == 2 and all("rotationAndAffine" in note for note in found.notes)


def voxels():
    return numpy.random.default_rng(2).integers(0, 99, (9, 10, 11)).astype(numpy.int16)


def place_of(image, index):
    """Where a voxel of an image lies."""
    point = [0.0, 0.0, 0.0]
    image.TransformIndexToPhysicalPoint([int(each) for each in index], point)
    return numpy.array(point)


def assert_voxels(source, values, world_of):
    """Each voxel of a file lies where `world_of` takes its index [x, y, z]."""
    source.UpdatePipeline()
    image = output(source)
    found = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(
        tuple(reversed(image.GetDimensions())))
    index = numpy.argwhere(numpy.ones(found.shape))[:, ::-1]
    places = numpy.array([place_of(image, each) for each in index])
    right = {}
    for z, y, x in numpy.ndindex(values.shape):
        right[tuple(numpy.round(world_of(numpy.array((x, y, z))), 2) + 0.0)] = values[z, y, x]
    assert len(right) == values.size
    for place, value in zip(places, found.ravel()):
        near = tuple(numpy.round(place, 2) + 0.0)
        keys = [near] if near in right else [key for key in right
                                             if numpy.abs(numpy.subtract(key, place)).max() < 0.011]
        assert keys and right[keys[0]] == value, (place, value)


def test_volumes_below_rigid_transforms():
    values, steps = voxels(), numpy.diag((-3.0, -2.5, 4.0))
    origin = numpy.array((20.0, 15.0, -18.0))  # LPS

    def rest(index):
        return (origin + index @ steps) * FLIP
    for number, matrix in enumerate((TURN, HALF_TURN, numpy.diag((1.0, -1.0, 1.0, 1.0)))):
        scene = Written(f"volumes {number}")
        slicer.write_nrrd(scene.path("Kopf grün.nrrd"), values, origin, steps)
        scene.linear("Placed", matrix)
        scene.stored("Volume", "head", "Kopf grün.nrrd")
        scene.stored("Volume", "turned", "Kopf grün.nrrd", above="Placed")
        found = opened(scene.written())
        assert not found.notes, found.notes
        assert found.volumes["turned"].SMProxy.GetXMLName() == "NRRDVolumeReader", "no lattice"
        assert_voxels(found.volumes["head"], values, rest)
        assert_voxels(found.volumes["turned"], values,
                      lambda index: of_rows(matrix, rest(index)))  # noqa: B023


def test_volumes_below_bending_transforms():
    scene = Written("bent volumes")
    smooth = 4.0 * numpy.sin(slicer.grid_vectors(size=0.0)[..., :1] + numpy.sin(
        numpy.indices(VECTORS.shape[:3])[0][..., None] / 5.0) + numpy.zeros(3))
    slicer.write_grid(scene.path("grid.nrrd"), smooth.astype(numpy.float32), "modeling")
    slicer.write_nrrd(scene.path("head.nrrd"), voxels(), (-25, -20, -15), numpy.diag((5.0,) * 3))
    scene.linear("Outer", HALF_TURN)
    scene.stored("GridTransform", "Bend", "grid.nrrd", above="Outer")
    scene.linear("Inner", TURN, above="Bend")
    scene.stored("Volume", "head", "head.nrrd", above="Inner")
    found = opened(scene.written())
    bent = found.volumes["head"]
    assert bent.SMProxy.GetXMLName() == "FreeFormDeformation"
    local = numpy.random.default_rng(1).uniform((-20, -18, -10), (20, 20, 20), (20, 3))
    right = of_rows(HALF_TURN, as_slicer(of_rows(TURN, local), smooth.astype(numpy.float32)))
    # Where the reader put the volume at rest, Slicer's matrices have turned it already.
    rest = of_rows(HALF_TURN @ TURN, local)
    moved = brainshift.deformed_from_rest(bent, rest)
    away = numpy.linalg.norm(moved - right, axis=1).max()
    assert away < 0.05, away
    assert numpy.linalg.norm(rest - right, axis=1).max() > 1.0


def test_volumes_below_a_stretch():
    scene = Written("stretched")
    values = numpy.zeros((30, 30, 30), numpy.int16)
    slicer.write_nrrd(scene.path("head.nrrd"), values, (-60, -60, -60), numpy.diag((4.0,) * 3))
    scene.linear("Affine", TURN @ STRETCH)
    scene.stored("Volume", "head", "head.nrrd", above="Affine")
    found = opened(scene.written())
    assert not found.notes, found.notes
    bent = found.volumes["head"]
    rows = numpy.reshape(bent.Input.GetPropertyValue("WorldFromFile"), (4, 4))
    local = numpy.random.default_rng(7).uniform(-56, 56, (100, 3))
    moved = brainshift.deformed_from_rest(bent, of_rows(rows, local))
    away = numpy.linalg.norm(moved - of_rows(TURN @ STRETCH, local), axis=1).max()
    assert away < 0.05, away
    assert numpy.allclose(rows[:3, :3] @ rows[:3, :3].T, numpy.eye(3)), "a rotation"


def test_states_keep_what_was_opened():
    scene = Written("kept")
    slicer.write_grid(scene.path("grid.nrrd"), VECTORS, "modeling")
    scene.stored("GridTransform", "Grid", "grid.nrrd")
    scene.linear("Inner", TURN, above="Grid")
    scene.landmarks("Kept", WORLD, above="Inner")
    opened(scene.written())
    simple.SaveState(scratch("kept.pvsm"))
    simple.Disconnect()
    simple.Connect()
    load_plugin()
    simple.LoadState(scratch("kept.pvsm"))
    assert_there(simple.FindSource("Kept"), as_slicer(of_rows(TURN, WORLD), VECTORS))


def test_segmentations_and_label_maps():
    layers = numpy.zeros((9, 10, 11), numpy.uint8)
    layers[2:5, 3:6, 4:7] = 1
    scene = Written("segments")
    words = ("Segment0_ID:=Segment_1", "Segment0_Name:=Tümor", "Segment0_Color:=1 0.5 0",
             "Segment0_LabelValue:=1", "Segment0_Layer:=0")
    slicer.write_nrrd(scene.path("Seg.seg.nrrd"), layers, (0, 0, 0), numpy.eye(3), words)
    slicer.write_nrrd(scene.path("labels.nrrd"), layers, (0, 0, 0), numpy.eye(3))
    scene.linear("Placed", TURN)
    scene.stored("Segmentation", "Seg", "Seg.seg.nrrd", above="Placed")
    scene.stored("LabelMapVolume", "Labels", "labels.nrrd")
    found = opened(scene.written())
    assert not found.notes and sorted(found.segmentations) == ["Labels", "Seg"], found
    assert_voxels(found.segmentations["Seg"], layers,
                  lambda index: of_rows(TURN, index * FLIP))
    names = output(found.segmentations["Seg"]).GetFieldData().GetAbstractArray("LabelNames")
    assert names.GetValue(0) == "Tümor"


def write_said_vtp(mesh, path):
    """A surface whose file says that it is in LPS, as Slicer writes it."""
    said, word = mesh.NewInstance(), vtkStringArray()
    said.ShallowCopy(mesh)
    word.SetName("SPACE")
    word.InsertNextValue("LPS")
    said.GetFieldData().AddArray(word)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(said)
    writer.SetFileName(path)
    assert writer.Write()


def test_models_in_both_axes():
    scene = Written("models")
    simple.SetActiveSource(None)
    ball = simple.Sphere(Radius=10, Center=(20, -30, 7), ThetaResolution=12)
    ball.UpdatePipeline()
    right = positions(ball)
    lps = simple.Transform(Input=ball)
    lps.Transform.Rotate = [0, 0, 180]
    for name, source in (("lps.vtk", lps), ("ras.vtk", ball), ("lps.vtp", lps), ("lps.stl", lps),
                         ("lps.ply", lps), ("lps.obj", None)):
        if source:
            simple.SaveData(scene.path(name), source)
    with open(scene.path("lps.obj"), "w") as file:
        file.write("# SPACE=LPS\nv 1 2 3\nv 4 5 6\nv 7 8 10\nf 1 2 3\n")
    with open(scene.path("lps.vtk"), "rb") as file:
        first, _, rest = file.read().split(b"\n", 2)
    with open(scene.path("said.vtk"), "wb") as file:  # the file's word counts, not the scene's
        file.write(b"\n".join((first, b"3D Slicer output. SPACE=LPS", rest)))
    write_said_vtp(output(lps), scene.path("said.vtp"))
    scene.linear("Placed", TURN)
    for name, axes in (("lps.vtk", "LPS"), ("ras.vtk", "RAS"), ("lps.vtp", "LPS"),
                       ("said.vtp", "RAS"), ("lps.stl", "LPS"), ("lps.ply", "LPS"),
                       ("said.vtk", "RAS"), ("lps.obj", "RAS")):
        scene.stored("Model", name, name, above="Placed", storage={"coordinateSystem": axes})
    scene.stored("Model", "old.vtk", "ras.vtk", old=True)
    scene.stored("FiberBundle", "tracts", "lps.vtp", storage={"coordinateSystem": "LPS"})
    found = opened(scene.written())
    assert not found.notes, found.notes
    for name in ("lps.vtk", "ras.vtk", "lps.vtp", "lps.ply", "said.vtk", "said.vtp"):
        assert_there(found.models[name], of_rows(TURN, right))
        assert not output(found.models[name]).GetFieldData().HasArray("SPACE"), "in RAS now"
    assert_there(found.models["old.vtk"], right)
    assert_there(found.models["tracts"], right)
    assert_there(found.models["lps.obj"],
                 of_rows(TURN, numpy.array(((-1, -2, 3), (-4, -5, 6), (-7, -8, 10.0)))))
    bounds = found.models["lps.stl"].GetDataInformation().GetBounds()  # points in another order
    expected = of_rows(TURN, right)
    assert numpy.allclose(bounds[::2], expected.min(axis=0), atol=1e-4), bounds
    # Normals turn with the surface: from the middle of the ball outwards.
    moved = output(found.models["lps.vtp"])
    normals = vtk_to_numpy(moved.GetPointData().GetNormals())
    outwards = positions(found.models["lps.vtp"]) - of_rows(TURN, numpy.array([[20, -30, 7.0]]))
    assert (numpy.einsum("ij,ij->i", normals, outwards) > 9.0).all()


def test_bundles():
    scene = Written("bundled")
    slicer.write_grid(scene.path("Data/Gitter ß.nrrd"), VECTORS, "modeling")
    scene.stored("GridTransform", "Grid", "Data/Gitter ß.nrrd")
    scene.landmarks("F", WORLD, above="Grid", file="Data/Märker 1.mrk.json")
    path = scene.bundle("Bündel mit Lücke.mrb")
    found = opened(path)
    assert not found.notes, found.notes
    assert_there(found.points["F"], as_slicer(WORLD, VECTORS))
    folder = os.path.splitext(path)[0] + "-opened"
    assert os.path.isdir(folder)
    # The same folder again, not a second one; and another folder on request.
    opened(path)
    assert not os.path.exists(folder + " 2")
    elsewhere = scratch("elsewhere")
    shutil.rmtree(elsewhere, ignore_errors=True)
    opened(path, folder=elsewhere)
    opened(path, folder=elsewhere)
    assert os.listdir(elsewhere)


def test_a_volume_of_colours_opens_and_what_holds_no_data_is_not_mentioned():
    scene = Written("colours")
    colours = numpy.random.default_rng(4).integers(0, 256, (4, 5, 6, 3)).astype(numpy.uint8)
    with open(scene.path("c.nrrd"), "wb") as file:
        file.write(b"NRRD0005\ntype: uchar\ndimension: 4\nsizes: 3 6 5 4\n"
                   b"kinds: RGB-color domain domain domain\nencoding: raw\n"
                   b"space: left-posterior-superior\nspace origin: (1,2,3)\n"
                   b"space directions: none (2,0,0) (0,2,0) (0,0,2)\n\n" + colours.tobytes())
    scene.stored("VectorVolume", "Colours", "c.nrrd")
    for kind in ("IGTLConnector", "SequenceBrowser", "ChartView", "AnnotationHierarchyNode"):
        scene.node(kind, kind, name=kind)
    found = opened(scene.written())
    assert not found.notes, found.notes
    image = output(found.volumes["Colours"])
    assert image.GetDimensions() == (6, 5, 4)
    shown = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(4, 5, 6, 3)
    for k, j, i in numpy.ndindex(4, 5, 6):
        place = [0.0, 0.0, 0.0]
        image.TransformIndexToPhysicalPoint(i, j, k, place)
        x, y, z = numpy.rint((numpy.array(place) * (-1, -1, 1) - (1, 2, 3)) / 2).astype(int)
        assert numpy.array_equal(shown[k, j, i], colours[z, y, x]), (k, j, i)


def said(scene, count=1, **options):
    """The only notes of a scene, which has nothing else."""
    found = opened(scene.written(), **options)
    assert len(found.notes) == count, found.notes
    return found


def test_what_is_not_opened_is_said():
    def refused(words, make):
        scene = Written("refused")
        make(scene)
        scene.landmarks("free", WORLD)
        found = said(scene)
        assert words in found.notes[0], found.notes
        assert_there(found.points["free"], WORLD)
        assert list(found.points) == ["free"] and not found.volumes and not found.models, found
    at = WORLD

    def below(*lines, above="T", only_points=False):
        def make(scene):
            for line in lines:
                line(scene)
            scene.landmarks("bent", at, above=above)
            scene.lines = [line for line in scene.lines
                           if not only_points or "refused-by-itself" not in line]
        return make
    refused("T is not in the scene", below())
    refused("no such file; save it again", lambda scene: scene.stored("Volume", "V", "gone.nrrd"))
    refused("outside the folder", lambda scene: scene.stored("Volume", "V", "../out.nrrd"))
    refused("outside the folder", lambda scene: scene.stored("Model", "M", "/etc/hostname"))
    refused("no file of this machine",
            lambda scene: scene.stored("Volume", "V", "https://example.org/a.nrrd"))
    refused("Sequence 'S' is not opened: it is of a kind",
            lambda scene: scene.node("Sequence", "S", name="S"))
    refused("NewKind 'S'", lambda scene: scene.node("NewKind", "S", name="S"))
    refused("has no file", lambda scene: scene.node("Volume", "V", name="V"))
    refused("centerImage", lambda scene: scene.stored("Volume", "V", "v.nrrd",
                                                      storage={"centerImage": 1}))
    refused("save it as .nrrd", lambda scene: (open(scene.path("v.png"), "w").close(),
                                               scene.stored("Volume", "V", "v.png")))
    refused("save it as .seg.nrrd in Slicer, after its binary labelmap",
            lambda scene: (open(scene.path("s.seg.vtm"), "w").close(),
                           scene.stored("Segmentation", "S", "s.seg.vtm")))
    refused("cannot be read", lambda scene: (open(scene.path("v.nrrd"), "w").close(),
                                             scene.stored("Volume", "V", "v.nrrd")))


def test_transforms_that_cannot_be_read():
    def refused(words, count, make):
        scene = Written("unread")
        make(scene)
        scene.landmarks("bent", WORLD, above="T")
        found = said(scene, count)
        assert all(words in note for note in found.notes), found.notes
        assert "bent" not in found.points and any("'bent'" in note for note in found.notes)
    refused("without an inverse", 2, lambda scene: scene.linear("T", numpy.diag((1, 1, 0, 1.0))))
    refused("not affine", 2, lambda scene: scene.linear("T", numpy.diag((1, 1, 1, 2.0))))
    refused("9 numbers", 2, lambda scene: scene.linear("T", numpy.eye(3)))
    refused("no numbers", 2, lambda scene: scene.node(
        "LinearTransform", "T", name="T", matrixTransformToParent="1 0 x"))
    refused("neither a matrix nor a file", 2,
            lambda scene: scene.node("GridTransform", "T", name="T"))
    refused("back to themselves", 2, lambda scene: scene.linear("T", TURN, above="T"))
    refused("no such file", 2, lambda scene: scene.stored("GridTransform", "T", "gone.nrrd"))
    refused("cannot be read", 2, lambda scene: (write_text(scene.path("bad.tfm"), "no transform"),
                                                scene.stored("Transform", "T", "bad.tfm")))
    refused("is no transform", 1, lambda scene: scene.node(
        "Camera", "T", name="T"))

    def stored_other_way(scene):
        write_text(scene.path("s.tfm"), itk_text(SPLINE))
        scene.stored("BSplineTransform", "T", "s.tfm", readWriteAsTransformToParent="true")
    refused("save the scene again", 2, stored_other_way)
    # The matrix in the scene counts where the file of a linear transform is gone.
    scene = Written("gone")
    scene.stored("LinearTransform", "T", "gone.h5",
                 matrixTransformToParent=slicer.numbers(TURN))
    scene.landmarks("bent", WORLD, above="T")
    found = said(scene)
    assert "The matrix in the scene counts" in found.notes[0]
    assert_there(found.points["bent"], of_rows(TURN, WORLD))


def write_text(path, text):
    with open(path, "w") as file:
        file.write(text)


def raises(words, path, **options):
    try:
        opened(path, **options)
    except ValueError as found:
        assert words in str(found) and os.path.basename(path) in str(found), found
    else:
        raise AssertionError(f"nothing says {words}")


def test_an_opened_folder_holds_one_bundle():
    scene = Written("replaced")
    scene.landmarks("F", WORLD)
    path = scene.bundle("patient.mrb")
    first = opened(path)
    os.remove(scene.path("F.mrk.json"))
    os.rename(os.path.splitext(path)[0] + "-opened", scratch("patient-kept"))
    scene.bundle("patient.mrb")
    shutil.rmtree(scratch("patient-opened 2"), ignore_errors=True)
    os.rename(scratch("patient-kept"), scratch("patient-opened"))
    second = opened(path)
    assert first.points and not second.points and "no such file" in second.notes[0], second
    assert os.path.exists(scratch("patient-opened 2"))


def test_folders_of_others_stay_as_they_are():
    scene = Written("foreign")
    scene.linear("T", TURN)
    path = scene.bundle("foreign.mrb")
    folder = scratch("foreign folder")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    write(os.path.join(folder, "mine.txt"), "x")
    raises("holds other files", path, folder=folder)
    assert os.listdir(folder) == ["mine.txt"]
    for each in (path, scene.written()):
        raises("name another folder", each, folder=os.path.join(folder, "mine.txt"))


def test_names_and_reasons_of_transforms():
    scene = Written("named twice")
    for number, matrix in enumerate((TURN, STRETCH, numpy.eye(3))):
        scene.node("LinearTransform", f"T{number}", name="T",
                   matrixTransformToParent=slicer.numbers(matrix))
    found = opened(scene.written())
    assert list(found.transforms) == ["T", "T 2"], found.transforms
    assert numpy.abs(found.transforms["T"].map_back(WORLD) - of_rows(TURN, WORLD)).max() < NEAR
    assert found.notes == ["LinearTransform 'T' is not opened: it has a matrix of 9 numbers; it "
                           "must have 16."], found.notes


def test_volumes_below_gaps_are_said():
    scene = Written("gaps")
    slicer.write_nrrd(scene.path("head.nrrd"), voxels(), (-25, -20, -15), numpy.diag((5.0,) * 3))
    some, none = numpy.zeros_like(VECTORS), numpy.full_like(VECTORS, numpy.nan)
    some[:8] = numpy.nan
    for name, vectors in (("some", some), ("none", none)):
        slicer.write_grid(scene.path(f"{name}.nrrd"), vectors, "resampling")
        scene.stored("GridTransform", name, f"{name}.nrrd")
        scene.stored("Volume", f"below {name}", "head.nrrd", above=name)
    found = opened(scene.written())
    assert list(found.volumes) == ["below some"], found
    for name in ("some", "none"):
        assert any(f"'below {name}'" in note and "no finite number" in note
                   for note in found.notes), found.notes


def test_files_name_no_files_outside():
    slicer.write_nrrd(scratch("outside.raw"), voxels(), (0, 0, 0), numpy.eye(3))
    raw, inside = scratch("outside.raw"), "NRRD0005\ntype: short\ndimension: 3\nsizes: 11 10 9\n"
    inside += ("space: left-posterior-superior\nspace origin: (0,0,0)\nendian: little\n"
               "space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\n")
    meta = ("ObjectType = Image\nNDims = 3\nDimSize = 11 10 9\nElementType = MET_SHORT\n")
    elastix = '(Transform "EulerTransform")\n(InitialTransformParametersFileName "%s")\n'
    minc = "MNI Transform File\nTransform_Type = Grid_Transform;\nDisplacement_Volume = %s;\n"
    files = [("Volume", "a.nhdr", inside + f"data file: {raw}\n"),
             ("Volume", "b.nrrd", inside + "datafile: ../outside.raw\n"),
             ("Volume", "c.nhdr", inside + "datafile: in.raw\ndata file: ../outside.raw\n"),
             ("Volume", "d.nhdr", inside + "data file: LIST\nin.raw\n../outside.raw\n"),
             ("Volume", "e.nhdr", inside + "data file: ../outside%01d.raw 1 2 1\n"),
             ("Volume", "f.mhd", meta + f"ElementDataFile = {raw}\n"),
             ("Transform", "g.txt", elastix % raw), ("Transform", "h.xfm", minc % raw)]
    scene = Written("naming")
    with open(scene.path("in.raw"), "wb") as file:
        file.write(voxels().tobytes())
    for kind, name, text in [*files, ("Volume", "good.nhdr", inside + "data file: in.raw\n")]:
        write_text(scene.path(name), text)
        scene.stored(kind, name, name)
    for found in (opened(scene.written()), opened(scene.bundle("naming.mrb"))):
        assert list(found.volumes) == ["good.nhdr"] and not found.transforms, found
        for _, name, _ in files:
            assert any(f"'{name}' is not opened" in note and "outside the folder" in note
                       for note in found.notes), (name, found.notes)


def test_minc_files_go_to_their_readers():
    scene = Written("minc")
    for name, begin in (("one", b"CDF\1"), ("two", b"\x89HDF")):
        with open(scene.path(f"{name}.mnc"), "wb") as file:
            file.write(begin)
    assert openscene._reader_of(scene.path("one.mnc")) == "MINC1VolumeReader"
    assert openscene._reader_of(scene.path("two.mnc")) == "MINCVolumeReader"


def test_hostile_scenes():
    bomb = "".join(f'<!ENTITY a{i} "{"&a%d;" % (i - 1) * 10}">' for i in range(1, 10))
    raises("entities", write("bomb.mrml", f'<!DOCTYPE MRML [<!ENTITY a0 "x">{bomb}]><MRML '
                                          'version="&a9;"></MRML>'))
    raises("deep", write("deep.mrml", "<MRML>" * 40 + "</MRML>" * 40))
    raises("more than 20000 nodes", write("many.mrml", "<MRML>" + "<View/>" * 20001 + "</MRML>"))
    raises("begins with <html>", write("html.mrml", "<html></html>"))
    raises("no good XML", write("cut.mrml", "<MRML><View "))
    raises("no good XML", write("odd.mrml", '<?xml version="1.0" encoding="odd"?><MRML></MRML>'))
    raises("cannot be read", scratch("nothing.mrml"))
    raises("not a zip file", write("bad.mrb", "<MRML>"))
    # What scenes of Slicer 2 begin with names no entity.
    assert not opened(write("dtd.mrml", '<!DOCTYPE MRML SYSTEM "mrml20.dtd">\n<MRML></MRML>')).notes
    # Copies of nodes in scene views count for nothing; the view itself is said.
    found = opened(write("views.mrml", '<MRML><SceneView id="a" name="S"><Volume id="v"/>'
                                       "</SceneView></MRML>"))
    assert len(found.notes) == 1 and "SceneView 'S'" in found.notes[0]


def test_hostile_bundles():
    def bundle(name, *entries):
        path = scratch(name)
        shutil.rmtree(os.path.splitext(path)[0] + "-opened", ignore_errors=True)
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
            file.writestr("s/s.mrml", "<MRML></MRML>")
            for entry, content in entries:
                file.writestr(entry, content)
        return path
    for entry in ("../slipped.txt", "/tmp/slipped.txt", "s/../../slipped.txt", "..\\slipped.txt"):
        found = opened(bundle("slip.mrb", (entry, "x")))
        assert len(found.notes) == 1 and "leads out of the bundle" in found.notes[0], found.notes
        assert not os.path.exists(scratch("slipped.txt"))
    link = zipfile.ZipInfo("s/link")
    link.external_attr = 0o120777 << 16
    found = opened(bundle("link.mrb", (link, "/etc/passwd")))
    assert len(found.notes) == 1 and "is a link" in found.notes[0]
    assert not opened(bundle("good.mrb", ("s/zeros", bytes(10**7)))).notes, "zeros pack well"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of zipfile
        found = opened(bundle("twice.mrb", ("s/a", "1"), ("s/a", "2")))
    assert len(found.notes) == 1 and "twice" in found.notes[0], found.notes
    empty = scratch("empty.mrb")
    with zipfile.ZipFile(empty, "w") as file:
        file.writestr("s/readme.txt", "x")
    raises("no scene", empty)
    for name in ("bad", "empty"):
        assert not os.path.exists(scratch(f"{name}-opened")), "no folder for what is no bundle"
    path = bundle("cut.mrb", ("s/a.bin", os.urandom(1000)))
    with open(path, "rb") as file:
        data = bytearray(file.read())
    data[200] ^= 255
    with open(path, "wb") as file:
        file.write(data)
    assert "s/a.bin of the bundle is not unpacked" in opened(path).notes[0]
    assert not os.path.exists(scratch("cut-opened/s/a.bin.part"))
    path = scratch("lzma.mrb")
    shutil.rmtree(scratch("lzma-opened"), ignore_errors=True)
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("s/s.mrml", "<MRML></MRML>")
        file.writestr("s/a.bin", os.urandom(1000), zipfile.ZIP_LZMA)
    with open(path, "rb") as file:
        data = file.read()
    at = data.index(b"s/a.bin") + 7 + 4  # the properties of LZMA
    with open(path, "wb") as file:
        file.write(data[:at] + b"\xff" + data[at + 1:])
    assert "s/a.bin of the bundle is not unpacked" in opened(path).notes[0]


run_tests(globals())
