# SPDX-License-Identifier: BSD-3-Clause
# Proves that a scene that BrainShift saves means in 3D Slicer what it shows: read by ElementTree,
# json and numpy, and moved by VTK's grid transform, which is Slicer's, landmarks at rest go where
# the bent volume has them; and that open_scene brings back what was saved.
import gzip
import json
import os
import re
import shutil
import warnings
import xml.etree.ElementTree
import zipfile

import numpy
import slicer_testing as slicer
from brainshift_testing import ball, load_plugin, messages, output, run_tests, scratch, volume
from outside_testing import FLIP
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersHybrid import vtkGridTransform

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

NEAR_FIELD = 0.05  # mm: the samples of the field are 2 mm apart
REST = numpy.random.default_rng(9).uniform((-25, -20, -25), (25, 20, 25), (10, 3))


#: What 3D Slicer says of a segment, in coded terms.
TAGS = ("TerminologyEntry:Segmentation category and type - DICOM master list~"
        "SCT^49755003^Morphologically Altered Structure~SCT^4147007^Mass~^^~"
        "Anatomic codes - DICOM master list~SCT^12738006^Brain~SCT^7771000^Left|")
ORIGIN = numpy.array((-40.0, -44.0, -30.0))  # LPS
HEAD, LABELS = ball(41, 14).astype(numpy.int16), numpy.zeros((41, 41, 41), numpy.uint8)
HEAD[5:8, 6:12, 30:34] = 55  # no two axes are alike, and no two ends of one
LABELS[15:25, 15:25, 15:25], LABELS[30:34, 3:9, 5:8] = 3, 7


def bent_head():
    """A volume of a file, bent by two strokes, and labels."""
    slicer.write_nrrd(scratch("Kopf ä.nrrd"), HEAD, ORIGIN, numpy.eye(3) * 2.0)
    words = ("Segment0_ID:=Segment_1", "Segment0_Name:=Tümor", "Segment0_Color:=1 0.5 0",
             "Segment0_LabelValue:=3", "Segment0_Layer:=0", "Segment0_Tags:=" + TAGS)
    slicer.write_nrrd(scratch("Labels.seg.nrrd"), LABELS, ORIGIN, numpy.eye(3) * 2.0, words)
    head = simple.NRRDVolumeReader(FileName=scratch("Kopf ä.nrrd"))
    segments = simple.NRRDVolumeReader(FileName=scratch("Labels.seg.nrrd"))
    bent = simple.FreeFormDeformation(Input=head)
    bent.Strokes = brainshift.stamp((10, 5, 0), (10, 5, -30), 8.0) + brainshift.move(
        (-10, -8, 5), (3, 5, 2))
    bent.UpdatePipeline()
    scene = slicer.Written("rest points")
    scene.landmarks("Marken", REST)
    return bent, segments, scene.path("Marken.mrk.json")


def header_and_values(path):
    """The header of an NRRD file as a dictionary, and its numbers."""
    with open(path, "rb") as file:
        head, data = file.read().split(b"\n\n", 1)
    words = dict(line.replace(":=", ": ", 1).split(": ", 1)
                 for line in head.decode().split("\n")[1:] if ": " in line or ":=" in line)
    data = gzip.decompress(data) if words["encoding"].startswith("gz") else data
    assert words.get("endian", "little") == "little", words
    kind = {"float": "<f4", "double": "<f8", "short": "<i2", "uint8": "u1",
            "unsigned char": "u1", "int16": "<i2", "uchar": "u1"}[words["type"]]
    sides = [int(word) for word in words["sizes"].split()]
    return words, numpy.frombuffer(data, kind).reshape(sides[::-1])


def steps_and_origin(words):
    """The axes of a file's voxels as rows, and its first voxel (LPS, mm)."""
    assert words["space"] in ("left-posterior-superior", "LPS"), words
    steps = [eval(word) for word in words["space directions"].split() if word != "none"]
    return numpy.array(steps), numpy.array(eval(words["space origin"]))


def assert_places(path, right, origin, steps):
    """A file has each voxel [z, y, x] where it is by `origin` and `steps`, as rows (LPS, mm)."""
    words, values = header_and_values(path)
    own_steps, own_origin = steps_and_origin(words)
    index = numpy.argwhere(numpy.ones(values.shape))[:, ::-1]
    there = (own_origin + index @ own_steps - origin) @ numpy.linalg.inv(steps)
    assert numpy.abs(there - numpy.round(there)).max() < 1e-3, there
    x, y, z = numpy.round(there).astype(int).T
    assert values.size == right.size and min(x.min(), y.min(), z.min()) == 0
    assert (values.ravel() == right[z, y, x]).all(), path


def moved_as_in_slicer(path, points):
    """RAS points moved from the parent by a grid of a file."""
    words, values = header_and_values(path)
    assert words["displacement field type"] == "resampling", words
    steps, origin = steps_and_origin(words)
    spacing = numpy.linalg.norm(steps, axis=1)
    image = vtkImageData()
    image.SetDimensions(*reversed(values.shape[:3]))
    image.SetSpacing(*spacing)
    turn = (steps / spacing[:, None]).T  # columns: the axes of the grid in LPS
    vectors = (values.reshape(-1, 3) @ turn).astype(numpy.float64)  # along the axes
    image.GetPointData().SetScalars(numpy_to_vtk(numpy.ascontiguousarray(vectors), deep=True))
    grid = vtkGridTransform()
    grid.SetDisplacementGridData(image)
    grid.SetInterpolationModeToCubic()
    found = [turn @ numpy.array(grid.TransformPoint(*((point * FLIP - origin) @ turn))) + origin
             for point in points]
    return numpy.array(found) * FLIP


def nodes_of(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    assert root.tag == "MRML" and root.get("version").startswith("Slicer 5")
    by_id = {node.get("id"): node for node in root}
    assert len(by_id) == len(root), "identifiers differ"
    for node in root:
        for part in node.get("references", "").split(";"):
            assert not part or part.split(":")[1] in by_id, part
    return root, by_id


def refers(node, role):
    return dict(part.split(":") for part in node.get("references").split(";") if part).get(role)


def file_of(folder, node, by_id):
    name = by_id[refers(node, "storage")].get("fileName")
    assert " " not in name and not os.path.isabs(name), name
    path = os.path.join(folder, name.replace("%20", " "))
    assert os.path.isfile(path), path
    return path


def judge(path):
    """What a reader of scenes finds in one that was saved of `bent_head`."""
    folder = os.path.dirname(path)
    root, by_id = nodes_of(path)
    kinds = [node.tag for node in root]
    assert kinds.count("Volume") == 2 and kinds.count("GridTransform") == 1, kinds
    assert kinds.count("Segmentation") == 1 and kinds.count("MarkupsFiducial") == 1, kinds
    grid = next(node for node in root if node.tag == "GridTransform")
    by_name = {node.get("name"): node for node in root}
    rest, hardened = by_name["Kopf ä"], by_name["Kopf ä hardened"]
    points = by_name["Marken"]
    assert refers(rest, "transform") == refers(points, "transform") == grid.get("id")
    assert refers(by_name["Labels"], "transform") == grid.get("id")
    assert refers(hardened, "transform") is None
    return {name: file_of(folder, node, by_id) for name, node in (
        ("grid", grid), ("rest", rest), ("hardened", hardened), ("points", points),
        ("labels", by_name["Labels"]))}


def test_a_saved_scene_is_bent_in_slicer():
    bent, segments, marks = bent_head()
    path = scratch("saved scene.mrml")
    brainshift.save_scene(path, bent, points=marks, segmentations=segments)
    files = judge(path)
    deformed = brainshift.deformed_from_rest(bent, REST)
    back = moved_as_in_slicer(files["grid"], deformed)
    away = numpy.linalg.norm(back - REST, axis=1).max()
    assert away < NEAR_FIELD, away
    assert numpy.linalg.norm(deformed - REST, axis=1).max() > 2.0
    with open(files["points"], encoding="utf-8") as file:
        markup = json.load(file)["markups"][0]
    assert markup["coordinateSystem"] == "LPS"
    stored = numpy.array([point["position"] for point in markup["controlPoints"]]) * FLIP
    assert numpy.abs(stored - REST).max() < 1e-4
    assert_places(files["rest"], HEAD, ORIGIN, numpy.eye(3) * 2.0)
    assert_places(files["labels"], LABELS, ORIGIN, numpy.eye(3) * 2.0)
    words, _ = header_and_values(files["labels"])
    assert words["Segment0_Name"] == "Tümor" and words["Segment0_LabelValue"] == "3", words
    assert words["Segment0_Tags"] == TAGS, words
    assert words["Segment1_LabelValue"] == "7" and words["Segment1_Tags"] == "|", words


def test_the_hardened_copy_has_each_voxel_where_the_bake_has_it():
    bent, _, _ = bent_head()
    path = scratch("hardened.mrml")
    brainshift.save_scene(path, bent)
    root, by_id = nodes_of(path)
    node = next(node for node in root if node.get("name") == "Kopf ä hardened")
    baked = simple.BakeDeformation(Input=bent)
    image = output(baked)
    right = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(
        tuple(reversed(image.GetDimensions())))
    first, steps = numpy.zeros(3), numpy.zeros((3, 3))
    image.TransformIndexToPhysicalPoint([0, 0, 0], first)
    for step, index in zip(steps, numpy.eye(3, dtype=int)):
        image.TransformIndexToPhysicalPoint([int(each) for each in index], step)
        step -= first
    assert_places(file_of(scratch("."), node, by_id), right, first * FLIP, steps * FLIP)


def in_lps(voxels, name):
    """A source of voxels at ORIGIN that says that its world axes are LPS."""
    source = volume(voxels, ORIGIN, (2.0, 2.0, 2.0))
    axes = vtkStringArray()
    axes.SetName("WorldAxes")
    axes.InsertNextValue("LPS")
    source.GetClientSideObject().GetOutputDataObject(0).GetFieldData().AddArray(axes)
    simple.RenameSource(name, source)
    source.UpdatePipeline()
    return source


def test_a_volume_in_lps_is_bent_in_slicer():
    bent = simple.FreeFormDeformation(Input=in_lps(HEAD, "Head"))
    bent.Strokes = brainshift.move((-10, -8, 5), (3, 5, 2))
    path = scratch("lps.mrml")
    with messages() as told:
        brainshift.save_scene(path, bent, segmentations=in_lps(LABELS, "Labels"))
    assert not told.text, told.text
    root, by_id = nodes_of(path)
    files = {node.get("name"): file_of(scratch("."), node, by_id) for node in root
             if node.tag in ("Volume", "Segmentation", "GridTransform")}
    assert_places(files["Head"], HEAD, ORIGIN, numpy.eye(3) * 2.0)
    assert_places(files["Labels"], LABELS, ORIGIN, numpy.eye(3) * 2.0)
    deformed = brainshift.deformed_from_rest(bent, REST)
    back = moved_as_in_slicer(files["Head deformation"], deformed * FLIP) * FLIP
    assert numpy.linalg.norm(back - REST, axis=1).max() < NEAR_FIELD


def test_a_bundle_comes_back():
    bent, segments, marks = bent_head()
    path = scratch("Zurück.mrb")
    shutil.rmtree(scratch("Zurück-opened"), ignore_errors=True)
    brainshift.save_scene(path, [bent], points=[marks], segmentations=[segments])
    assert not [name for name in os.listdir(scratch(".")) if name.startswith("brainshift-scene")]
    names = zipfile.ZipFile(path).namelist()
    assert "Zurück/Zurück.mrml" in names and all(name.startswith("Zurück/") for name in names)
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        found = brainshift.open_scene(path)
    assert sorted(found.volumes) == ["Kopf ä", "Kopf ä hardened"], found.volumes
    assert all("lattice" in note for note in found.notes), (found.notes, heard)
    right = brainshift.deformed_from_rest(bent, REST)
    again = brainshift.deformed_from_rest(found.volumes["Kopf ä"], REST)
    assert numpy.linalg.norm(again - right, axis=1).max() < 0.1
    found.points["Marken"].UpdatePipeline()
    marks = vtk_to_numpy(output(found.points["Marken"]).GetPoints().GetData())
    assert numpy.linalg.norm(marks - right, axis=1).max() < NEAR_FIELD
    names = output(found.segmentations["Labels"]).GetFieldData().GetAbstractArray("LabelNames")
    assert [names.GetValue(i) for i in range(2)] == ["Tümor", "Label 7"]


def test_plain_volumes_and_wrong_names():
    plain = volume(ball(9, 3))
    brainshift.save_scene(scratch("plain.mrml"), plain)
    root, _ = nodes_of(scratch("plain.mrml"))
    assert not [node for node in root if node.tag == "GridTransform"]
    try:
        brainshift.save_scene(scratch("scene.xml"), plain)
    except ValueError as problem:
        assert "must end in .mrml or .mrb" in str(problem)
    else:
        raise AssertionError("another ending is not refused")


def fresh(name):
    """A folder with nothing in it."""
    shutil.rmtree(scratch(name), ignore_errors=True)
    os.makedirs(scratch(name))
    return scratch(name)


def contents(folder):
    """The bytes of all files below a folder, by their paths in it."""
    found = {}
    for root, _, names in os.walk(folder):
        for name in names:
            with open(os.path.join(root, name), "rb") as file:
                found[os.path.relpath(os.path.join(root, name), folder)] = file.read()
    return found


def folders(folder):
    return sorted(name for name in os.listdir(folder) if os.path.isdir(os.path.join(folder, name)))


def head_in(folder, name):
    path = os.path.join(folder, name)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    return slicer.write_nrrd(path, ball(21, 7).astype(numpy.int16), (-40, -40, -40),
                             numpy.eye(3) * 4.0)


def bent_file(path):
    head = simple.NRRDVolumeReader(FileName=path)
    return simple.FreeFormDeformation(Input=head, Strokes=brainshift.move((0, 0, 0), (4, 0, 0)))


def test_files_that_were_there_stay():
    folder = fresh("kept files")
    bent = bent_file(head_in(folder, "p-data/T1.nrrd"))
    head_in(folder, "p-data/T1 hardened.nrrd")
    before = contents(folder)
    brainshift.save_scene(os.path.join(folder, "p.mrml"), bent)
    assert before.items() <= contents(folder).items()
    simple.Delete(bent.Input)
    brainshift.save_scene(os.path.join(folder, "q.mrml"), bent)
    assert before.items() <= contents(folder).items()


def test_a_second_save_takes_the_place_of_the_first():
    folder = fresh("twice")
    bent = bent_file(head_in(folder, "T1.nrrd"))
    path = os.path.join(folder, "p.mrml")
    for _ in range(3):
        brainshift.save_scene(path, bent)
    last, = folders(folder)
    root, by_id = nodes_of(path)
    for node in root:
        if node.tag in ("Volume", "GridTransform"):
            assert os.path.dirname(file_of(folder, node, by_id)) == os.path.join(folder, last)
    with open(os.path.join(folder, last, "T1.nrrd"), "ab") as file:
        file.write(b"by another program")
    brainshift.save_scene(path, bent)
    assert last in folders(folder) and len(folders(folder)) == 2


def test_files_that_another_scene_names_stay():
    folder = fresh("two scenes")
    bent = bent_file(head_in(folder, "T1.nrrd"))
    path, other = os.path.join(folder, "a b.mrml"), os.path.join(folder, "other.mrml")
    brainshift.save_scene(path, bent, hardened=False)
    for ending in (".mrml", ".pvsm"):
        last = folders(folder)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(other[:-5] + ending, "w", encoding="utf-8") as file:
            file.write(text if ending == ".mrml" else text.replace("%20", " "))
        brainshift.save_scene(path, bent, hardened=False)
        assert set(last) < set(folders(folder)), (last, folders(folder))
    assert not brainshift.open_scene(other).notes


def test_a_scene_that_is_saved_onto_itself_keeps_what_its_sources_read():
    folder = fresh("onto itself")
    path = os.path.join(folder, "scene.mrml")
    brainshift.save_scene(path, bent_file(head_in(folder, "T1.nrrd")))
    scene = xml.etree.ElementTree.parse(path)
    turn = scene.getroot().makeelement("LinearTransform", {
        "id": "turn", "name": "turn",
        "matrixTransformToParent": slicer.numbers(slicer.TURN)})
    scene.getroot().append(turn)
    grid = next(node for node in scene.getroot() if node.tag == "GridTransform")
    grid.set("references", grid.get("references") + "transform:turn;")
    scene.write(path, encoding="utf-8", xml_declaration=True)
    found = brainshift.open_scene(path)
    bent = found.volumes["T1"]
    bent.Strokes = brainshift.move((0, 0, 30), (0, 3, 0))
    before, points = contents(folder), REST / 2
    right = brainshift.deformed_from_rest(bent, points)
    brainshift.save_scene(path, list(found.volumes.values()))
    after = contents(folder)
    assert all(after[name] == before[name] for name in before if name != "scene.mrml")
    again = brainshift.open_scene(path, folder=fresh("opened again")).volumes
    there = next(each for name, each in again.items() if each.SMProxy.GetXMLName() ==
                 "FreeFormDeformation")
    away = brainshift.deformed_from_rest(there, points) - right
    assert numpy.linalg.norm(away, axis=1).max() < 0.15, away


def test_a_scene_that_is_refused_leaves_the_former_one():
    folder = fresh("refused")
    bent = bent_file(head_in(folder, "T1.nrrd"))
    path = os.path.join(folder, "p.mrml")
    brainshift.save_scene(path, bent)
    before = contents(folder)
    bent.Strokes = brainshift.move((0, 0, 0), (0, 6, 0))
    try:
        brainshift.save_scene(path, bent, segmentations=volume(ball(9, 3) - 1.0))
    except ValueError as problem:
        assert "values from -1.0" in str(problem), problem
    else:
        raise AssertionError("labels below 0 are not refused")
    assert contents(folder) == before
    assert len(folders(folder)) == 1


def refused(path, *arguments, **named):
    """Why a scene is not saved. Nothing is left of it."""
    try:
        brainshift.save_scene(path, *arguments, **named)
    except (ValueError, OSError) as problem:
        left = [name for name in os.listdir(os.path.dirname(path)) if name != "T1.nrrd"]
        assert not left, left
        return f"{type(problem).__name__}: {problem}"
    raise AssertionError(f"{path} is saved")


def test_what_is_no_volume_is_refused():
    folder = fresh("wrong kinds")
    bent, path = bent_file(head_in(folder, "T1.nrrd")), os.path.join(folder, "p.mrml")
    sphere = simple.Sphere(registrationName="ball")
    assert "volume must be a volume; ball is" in refused(path, sphere)
    assert "segmentation must be a volume; ball is" in refused(path, bent, segmentations=sphere)
    assert "landmarks must be points; T1 is" in refused(path, bent, points=bent.Input)
    for things in ({"volumes": None}, {"volumes": "head.nrrd"},
                   {"volumes": bent, "segmentations": "labels.nrrd"}):
        assert "it must have ParaView sources" in refused(path, **things), things
    assert "nothing to save" in refused(path, [])
    for spacing in (0, -1, numpy.nan, numpy.inf):
        assert "spacing is" in refused(path, bent, spacing=spacing), spacing
    with messages():
        missing = refused(path, bent, points=os.path.join(folder, "missing.fcsv"))
    assert "ValueError" in missing and "missing.fcsv does not exist" in missing, missing


def test_a_volume_behind_a_deformation_is_refused():
    folder = fresh("behind")
    bent, path = bent_file(head_in(folder, "T1.nrrd")), os.path.join(folder, "p.mrml")
    behind = simple.ExtractSubset(registrationName="part", Input=bent)
    for each in (behind, simple.FreeFormDeformation(Input=behind)):
        assert "volume part comes after a Free-Form Deformation" in refused(path, each)
    brainshift.save_scene(path, simple.BakeDeformation(Input=bent))


def test_labels_of_unknown_axes_and_of_several_times():
    import nibabel
    folder = fresh("labels")
    labels = volume(LABELS, ORIGIN, (2.0, 2.0, 2.0))
    times = nibabel.Nifti1Image(numpy.stack([LABELS, LABELS], axis=-1), numpy.eye(4))
    nibabel.save(times, os.path.join(folder, "times.nii"))
    for source, word in ((labels, "axes of the segmentation"),
                         (simple.NIFTIVolumeReader(FileName=os.path.join(folder, "times.nii")),
                          "has 2 times; the scene has one of them")):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            brainshift.save_scene(os.path.join(folder, "p.mrml"), [], segmentations=source)
        assert len(caught) == 1 and word in str(caught[0].message), [str(e.message) for e in caught]


def test_names_that_xml_or_windows_do_not_take():
    folder = fresh("names/of things")
    sources = [in_lps(HEAD, name) for name in ("bad\x01name", "CON", "nul.1")]
    for base, inside in (("a.", "a."), ("10:30", "10_30")):
        path = os.path.join(folder, "new", f"{base}.mrb")  # a folder that is not there
        brainshift.save_scene(path, sources)
        found = brainshift.open_scene(path)
        assert list(found.volumes) == ["bad_name", "CON", "nul.1"] and not found.notes, found
        names = {os.path.basename(name) for name in zipfile.ZipFile(path).namelist()}
        assert names == {"_CON.nrrd", "_nul.1.nrrd", f"{inside}.mrml", "bad_name.nrrd"}, names


def test_nothing_is_left_of_a_file_that_fails():
    folder = fresh("full")
    os.makedirs(os.path.join(folder, "p.mrml"))
    bent = bent_file(head_in(folder, "T1.nrrd"))
    try:
        brainshift.save_scene(os.path.join(folder, "p.mrml"), bent, hardened=False)
    except OSError:
        assert sorted(os.listdir(folder)) == ["T1.nrrd", "p.mrml"], os.listdir(folder)
    else:
        raise AssertionError("a folder is no file")



def parents_of(path):
    """Of each markup of a scene: the tag of what is above it, or None."""
    root, by_id = nodes_of(path)
    above = {node.get("name"): refers(node, "transform") for node in root
             if node.tag == "MarkupsFiducial"}
    return {name: by_id[parent].tag if parent else None for name, parent in above.items()}


def test_points_that_are_moved_are_below_nothing():
    folder = fresh("moved points")
    bent = bent_file(head_in(folder, "T1.nrrd"))
    scene = slicer.Written("points to move")
    scene.landmarks("Marks", REST)
    rest = simple.LandmarkReader(FileName=scene.path("Marks.mrk.json"))
    moved = simple.DeformGeometry(registrationName="moved", Input=rest, Deformation=bent)
    behind = simple.Elevation(registrationName="behind", Input=moved)
    back = simple.DeformGeometry(registrationName="back", Input=moved, Deformation=bent,
                                 Direction="Backward")
    hand = shutil.copy(scene.path("Marks.mrk.json"), scene.path("hand.mrk.json"))
    path = os.path.join(folder, "p.mrml")
    brainshift.save_scene(path, bent, points=[rest, moved, behind, back],
                          moved_points=hand)
    assert parents_of(path) == {"Marks": "GridTransform", "moved": None, "behind": None,
                                "back": "GridTransform",
                                "hand": None}, parents_of(path)


def test_points_of_a_scene_are_at_rest_where_they_only_turned():
    folder = fresh("scene points")
    scene = slicer.Written("points of a scene")
    for name, matrix in (("turned", slicer.TURN), ("mirrored", numpy.diag((-1.0, 1, 1, 1))),
                         ("stretched", slicer.STRETCH)):
        scene.landmarks(name, REST, scene.linear("T " + name, matrix).replace(" ", "_"))
    found = brainshift.open_scene(scene.written()).points
    path = os.path.join(folder, "p.mrml")
    brainshift.save_scene(path, bent_file(head_in(folder, "T1.nrrd")), points=list(found.values()))
    assert parents_of(path) == {"turned": "GridTransform", "mirrored": "GridTransform",
                                "stretched": None}, parents_of(path)


def test_points_below_nothing_beside_a_bent_volume_stay_below_nothing():
    folder = fresh("points in the world")
    first = os.path.join(folder, "first.mrml")
    marks = slicer.Written("points in the world")
    marks.landmarks("Rest", REST)
    marks.landmarks("World", REST)
    brainshift.save_scene(first, bent_file(head_in(folder, "T1.nrrd")), hardened=False,
                          points=marks.path("Rest.mrk.json"),
                          moved_points=marks.path("World.mrk.json"))
    found = brainshift.open_scene(first)
    again = os.path.join(folder, "again.mrml")
    brainshift.save_scene(again, found.volumes["T1"], hardened=False,
                          points=[found.points["World"]])
    assert parents_of(again) == {"World": None}, parents_of(again)
    # Below a transform that only turns they are in the world, too.
    turned = os.path.join(folder, "turned.mrml")
    with open(first, encoding="utf-8") as file:
        text = file.read()
    text = re.sub('(<MarkupsFiducial [^>]*name="World"[^>]* references=")', r"\1transform:T;", text)
    turn = slicer.Written("turn")
    turn.linear("T", slicer.TURN)
    with open(turned, "w", encoding="utf-8") as file:
        file.write(text.replace("</MRML>", turn.lines[0] + "</MRML>"))
    assert parents_of(turned)["World"] == "LinearTransform"
    below = brainshift.open_scene(turned)
    brainshift.save_scene(again, below.volumes["T1"], hardened=False,
                          points=[below.points["World"], below.points["Rest"]])
    assert set(parents_of(again).values()) == {None}, parents_of(again)
    # In a scene whose volume is not bent they are at rest.
    marks.linear("T", slicer.TURN)
    plain = brainshift.open_scene(marks.written())
    brainshift.save_scene(again, found.volumes["T1"], hardened=False,
                          points=[plain.points["World"]])
    assert parents_of(again) == {"World": "GridTransform"}, parents_of(again)


run_tests(globals())
