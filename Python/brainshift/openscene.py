# SPDX-License-Identifier: BSD-3-Clause
"""Opens scenes of 3D Slicer: each thing of them as a pipeline of ParaView's own sources."""

import collections
import os
import warnings

from .casesources import free_name
from .files import reason_of
from .mrb import folder_for, unpack
from .mrml import WORLD_POINTS, SceneClause, SceneProblem, path_of, read_scene, with_way_out
from .mrmlfiles import require_below
from .mrmlshow import show_all
from .mrmltransforms import KINDS, Link, Transforms, files_of, merged, motion_in
from .points import taken_by
from .transforms import read_transform

VOLUMES, MODELS = ("Volume", "LabelMapVolume", "VectorVolume"), ("Model", "FiberBundle")
SEGMENTATIONS = ("Segmentation",)
#: Markups whose points are all that they are, and those that are more than their points.
POINTS = ("MarkupsFiducial",)
FIGURES = ("MarkupsLine", "MarkupsAngle", "MarkupsCurve", "MarkupsClosedCurve", "MarkupsPlane",
           "MarkupsROI")

#: Kinds of nodes that hold no data of the patient: views, colours, settings of modules.
_SETTINGS = frozenset("""
    Camera Clip ClipModels Color ColorLegendDisplay ColorTable ColorTableStorage CommandLineModule
    CropVolumeParameters Crosshair FolderDisplay GPURayCastVolumeRendering Interaction Layout
    CPURayCastVolumeRendering MultiVolumeRendering PETProceduralColor PlotView ProceduralColor
    ProceduralColorStorage ScriptedModule SegmentEditor Selection ShaderProperty
    ShaderPropertyStorage Slice SliceComposite SliceDisplay SubjectHierarchy
    SubjectHierarchyItem TableView Unit View VolumeProperty VolumePropertyJsonStorage
    VolumePropertyStorage VolumeRendering VolumeRenderingParameters dGEMRICProceduralColor
    DiffusionTensorDisplayProperties DisplayableHierarchy Hierarchy HierarchyStorage ModelHierarchy
    AnnotationHierarchy AnnotationHierarchyNode ViewLayout LinearTransformDisplay ChartView
    IGTLConnector SequenceBrowser""".split())

_VOLUME_READERS = {
    ".nrrd": "NRRDVolumeReader", ".nhdr": "NRRDVolumeReader", ".nii": "NIFTIVolumeReader",
    ".nii.gz": "NIFTIVolumeReader", ".hdr": "NIFTIVolumeReader", ".img": "NIFTIVolumeReader",
    ".mha": "MHAVolumeReader", ".mhd": "MHAVolumeReader", ".mgz": "MGHVolumeReader",
    ".mgh": "MGHVolumeReader", ".mnc": "MINCVolumeReader"}
_MINC1_READER = "MINC1VolumeReader"
_MODEL_READERS = {
    ".vtk": ("LegacyVTKReader", "FileNames"), ".vtp": ("XMLPolyDataReader", "FileName"),
    ".ply": ("PLYReader", "FileNames"), ".stl": ("STLReader", "FileNames"),
    ".obj": ("WavefrontOBJReader", "FileName")}

#: Control points of a lattice along each axis, from few to many, and the error that is good enough
#: (mm).
_SIDES, _GOOD_MM = (19, 37, 73), 0.05

#: What a point may miss its position by without a word, and when it has none (mm).
_MISS_MM, _FAR_MM = 1e-3, 100.0

#: The first bytes of a model's file, where it may name its axes.
_HEADER_BYTES = 4096

OpenedScene = collections.namedtuple(
    "OpenedScene", "volumes segmentations points models transforms notes")


def _ending(path, endings):
    name = path.lower()
    return next((end for end in sorted(endings, key=len, reverse=True) if name.endswith(end)), "")


def _made(proxy, name, file_property, path, **properties):
    """A source that has read a file; the end of a sentence if it could not."""
    from paraview import simple

    maker = getattr(simple, proxy, None)
    if maker is None:
        raise SceneProblem(f"needs the {proxy}, which this build does not have")
    value = [path] if file_property == "FileNames" else path
    source = maker(registrationName=free_name(name), **{file_property: value}, **properties)
    source.UpdatePipeline()
    reason = reason_of(source) if source.SMProxy.GetProperty("Problem") else ""
    if reason or not source.GetDataInformation().DataInformation.GetNumberOfPoints():
        simple.Delete(source)
        raise SceneProblem(f"cannot be read: {reason or path + ' holds no points'}")
    return source


class _Opening:
    """The opening of one scene."""

    def __init__(self, scene, folder, outside):
        self.scene, self.folder, self.outside = scene, folder, outside
        self.transforms = Transforms(scene, outside)
        self.found = OpenedScene({}, {}, {}, {}, {}, [])
        self.shown = []  #: pairs of node and source

    def keep(self, kind, node, name, source):
        """Keeps the last source of a thing. Two things of one name keep both."""
        _put(getattr(self.found, kind), name, source)
        self.shown.append((node, source))

    def path(self, node):
        storage = self.scene.by_id.get(node.reference("storage"))
        if storage is None:
            raise SceneProblem("has no file in the scene")
        names = storage.file_names()
        if not names:
            raise SceneProblem("has no file in the scene")
        if storage.is_on("centerImage") or storage.attributes.get("UseOrientationFromFile") == "0":
            raise SceneProblem("was moved when Slicer loaded its file (centerImage, "
                               "UseOrientationFromFile); save the volume and the scene again")
        path = path_of(self.scene, names[0], self.outside)
        require_below(self.scene, path, self.outside)
        return path, storage

    # Volumes -------------------------------------------------------------------------------------

    def volume(self, node, kind):
        path, _ = self.path(node)
        links = self.transforms.chain(node)
        if _ending(path, _VOLUME_READERS):
            self.layers(node, kind, links, (_reader_of(path), path))
            return
        if not path.lower().endswith((".dcm", ".ima")) or links:
            raise SceneProblem(
                f"is in {os.path.basename(path)}; save it as " +
                (".nrrd in Slicer" if kind == "volumes" else
                 ".seg.nrrd in Slicer, after its binary labelmap was made the source "
                 "representation"))
        self.keep(kind, node, node.name, _made("DICOMVolumeReader", node.name, "FileName", path))

    def layers(self, node, kind, links, reader_of):
        """A volume, or the layers of a segmentation whose segments overlap."""
        first = self.bent(node, links, reader_of, node.name)
        names = [first.layer_names[i] for i in range(len(first.layer_names))]
        self.keep(kind, node, node.name, first.source)
        for number, layer in enumerate(names[1:], 2):
            name = f"{node.name} layer {number}"
            self.keep(kind, node, name,
                      self.bent(node, links, reader_of, name, Layer=layer).source)

    def bent(self, node, links, reader_of, name, **properties):
        """A volume below a chain of transforms: its own reader where they are rigid."""
        from paraview import simple

        motion = self.motion(links, reader_of, properties)
        rest = merged([*links, Link(node.name, matrix=motion)])
        proxy, path = reader_of
        reader = _made(proxy, f"{name} at rest" if rest else name, "FileName", path,
                       WorldFromFile=[float(number) for number in motion.ravel()], **properties)
        layers = list(reader.GetPropertyValue("LayerList") or []) if (
            reader.SMProxy.GetProperty("LayerList")) else []
        kept = collections.namedtuple("Kept", "source layer_names")
        if not rest:
            return kept(reader, layers)
        try:
            return kept(self.lattice(node, links, rest, reader, name), layers)
        except SceneProblem:
            simple.Delete(reader)
            raise

    @staticmethod
    def motion(links, reader_of, properties):
        """Where the reader of a volume puts it."""
        import numpy
        from paraview import simple

        motion = motion_in(links, numpy.zeros(3))
        others = merged([link for link in links if link.matrix is not None] +
                        [Link("", matrix=motion)])
        if not others:
            return motion
        reader = _made(reader_of[0], "volume", "FileName", reader_of[1], **properties)
        bounds = numpy.reshape(reader.GetDataInformation().GetBounds(), (3, 2))
        simple.Delete(reader)
        return motion_in(links, bounds.mean(axis=1))

    def lattice(self, node, links, rest, reader, name):
        """The Free-Form Deformation of a volume by what is left of its transforms."""
        from paraview import simple

        files = files_of(rest, self.folder)
        above = " + ".join(dict.fromkeys(link.name for link in reversed(links)))
        field = simple.TransformReader(
            registrationName=free_name(above), Volume=reader, FileName=files[0],
            LaterFileNames=files[1:], Direction="Backward", FieldsBetween="Held")
        for sides in _SIDES:
            field.LatticeDimensions = [sides] * 3
            field.UpdatePipeline()
            reason = reason_of(field)
            error = field.SMProxy.GetProperty("LargestError").GetElement(0)
            if reason or error <= _GOOD_MM:
                break
        if reason:
            simple.Delete(field)
            raise SceneProblem(f"cannot be bent by '{above}': {reason}")
        if error > _GOOD_MM:
            self.found.notes.append(
                f"{node.words} is drawn with a lattice of {sides} points along each axis, which "
                f"misses its transforms by up to {error:.2g} mm.")
        self.require_positions(node, above, reader, files)
        return simple.FreeFormDeformation(
            registrationName=free_name(name), Input=reader, Lattice=field,
            LatticeDimensions=[sides] * 3)

    def require_positions(self, node, above, reader, files):
        """Says where in a volume its transforms have no finite number, and refuses if nowhere."""
        import numpy

        bounds = numpy.reshape(reader.GetDataInformation().GetBounds(), (3, 2))
        axes = [numpy.linspace(*ends, _SIDES[0]) for ends in bounds]
        points = numpy.stack(numpy.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        transform = read_transform(files)
        _hold_fields(transform._report)
        found = numpy.isfinite(transform.map_back(points)).all(axis=1)
        if not found.any():
            raise SceneProblem(f"cannot be bent by '{above}', which has no finite number in it")
        if not found.all():
            self.found.notes.append(
                f"{node.words} is below '{above}', which has no finite number at {(~found).sum()} "
                f"of {found.size} points of the volume; the tissue there is not moved.")

    # Points and surfaces -------------------------------------------------------------------------

    def points(self, node):
        path, _ = self.path(node)
        links = self.transforms.chain(node)
        if not _ending(path, (".mrk.json", ".json", ".fcsv")):
            raise SceneProblem(f"is in {os.path.basename(path)}; save it as .mrk.json in Slicer")
        reader = _made("LandmarkReader", self.rest_name(node, links), "FileName", path)
        self.keep("points", node, node.name, self.moved(node, links, reader))
        if node.kind in FIGURES:
            self.found.notes.append(f"Of {node.words} only the control points are shown.")

    @staticmethod
    def rest_name(node, links):
        return f"{node.name} at rest" if merged(links) else node.name

    def model(self, node):
        from paraview import simple

        path, storage = self.path(node)
        links = self.transforms.chain(node)
        end = _ending(path, _MODEL_READERS)
        if not end:
            raise SceneProblem(f"is in {os.path.basename(path)}; save it as .vtp or .ply in Slicer")
        proxy, file_property = _MODEL_READERS[end]
        reader = _made(proxy, f"{node.name} in its file", file_property, path)
        if not reader.GetDataInformation().DataSetTypeIsA("vtkPolyData"):
            kind = reader.GetDataInformation().GetPrettyDataTypeString()
            simple.Delete(reader)
            raise SceneProblem(f"is no surface but {kind}; save its surface as a model in Slicer")
        if _axes_of_model(reader, path, end, storage) == "LPS":
            reader = simple.Transform(registrationName=free_name(self.rest_name(node, links)),
                                      Input=_without_space(reader, node.name))
            reader.Transform.Rotate = [0.0, 0.0, 180.0]  # from LPS to RAS
        else:
            simple.RenameSource(free_name(self.rest_name(node, links)), reader)
        self.keep("models", node, node.name, self.moved(node, links, reader))

    def moved(self, node, links, source):
        """Points or a surface below a chain of transforms, each point by the exact map."""
        from paraview import servermanager

        links = merged(links)
        if not links:
            return source
        files = files_of(links, self.folder)
        manager = servermanager.ProxyManager().SMProxyManager
        report = manager.NewProxy("misc", "TransformReport")
        report.UnRegister(None)  # the manager holds it
        report.GetProperty("FileName").SetElement(0, files[0])
        for i, name in enumerate(files[1:]):
            report.GetProperty("LaterFileNames").SetElement(i, name)
        _hold_fields(report)
        report.UpdatePropertyInformation()
        problem = report.GetProperty("Problem").GetElement(0)
        if problem:
            _delete(source)
            raise SceneProblem(f"cannot be moved: {problem}")
        moved = taken_by(report, source, "Backward")
        miss = _largest_miss(source, taken_by(report, moved, "Forward"))
        if not miss < _FAR_MM:  # also rejects NaN
            del moved
            _delete(source)
            raise SceneProblem("has points that its transforms take to no position")
        if miss > _MISS_MM:
            self.found.notes.append(f"{node.words} has points where its transforms fold; they miss "
                                    f"their positions by up to {miss:.2g} mm.")
        name = free_name(node.name)
        manager.RegisterProxy("brainshift_transforms", name, report)  # so that states keep it
        manager.RegisterProxy("sources", name, moved.SMProxy)
        return moved

    # Transforms ----------------------------------------------------------------------------------

    def transform(self, node):
        """What takes points of the world to below a transform node."""
        chain = merged([*self.transforms.chain(node), self.transforms.own_link(node)])
        still = [Link(node.name, matrix=_identity())]
        transform = read_transform(files_of(chain or still, self.folder))
        _hold_fields(transform._report)
        _put(self.found.transforms, node.name, transform)

    # All of it -----------------------------------------------------------------------------------

    def open(self, node):
        if node.kind in VOLUMES:
            is_labels = node.kind == "LabelMapVolume" or node.is_on("labelMap")
            self.volume(node, "segmentations" if is_labels else "volumes")
        elif node.kind in SEGMENTATIONS:
            self.volume(node, "segmentations")
        elif node.kind in MODELS:
            self.model(node)
        elif node.kind in POINTS + FIGURES:
            self.points(node)
        elif node.kind in KINDS:
            self.transform(node)
        else:
            raise SceneProblem("is of a kind that BrainShift does not show; save what you need of "
                               "it as a volume, a model or markups")

    def run(self):
        for node in self.scene.nodes:
            if _is_setting(node):
                continue
            try:
                self.open(node)
            except SceneProblem as problem:
                subject = "" if isinstance(problem, SceneClause) else "it "
                self.found.notes.append(
                    f"{node.words} is not opened: {subject}{with_way_out(str(problem))}.")
            except OSError as problem:
                self.found.notes.append(f"{node.words} is not opened: its file cannot be read: "
                                        f"{problem}.")
        self.mark_moved()
        self.found.notes[:0] = self.scene.notes
        self.found.notes.extend(self.transforms.notes)

    def mark_moved(self):
        """Points below nothing that bends, beside a volume that is bent, are where tissue is now:
        marked, so that `save_scene` puts them below nothing. States keep the mark."""
        from paraview import servermanager

        kinds = {source.SMProxy.GetXMLName() for _, source in self.shown}
        if "FreeFormDeformation" not in kinds:
            return
        manager = servermanager.ProxyManager().SMProxyManager
        for node, source in self.shown:
            if node.kind in POINTS + FIGURES and all(
                    link.matrix is not None for link in self.transforms.chain(node)):
                manager.RegisterProxy(WORLD_POINTS, node.name, source.SMProxy)


def _reader_of(path):
    """The reader of a volume. MINC1 is netCDF, MINC2 is HDF5; both end in `.mnc`."""
    end = _ending(path, _VOLUME_READERS)
    with open(path, "rb") as file:
        is_minc1 = end == ".mnc" and file.read(3) == b"CDF"
    return _MINC1_READER if is_minc1 else _VOLUME_READERS[end]


def _put(held, name, thing):
    """Puts a thing into a dictionary; the second one of a name gets a number."""
    number, free = 2, name
    while free in held:
        number, free = number + 1, f"{name} {number}"
    held[free] = thing


def _delete(source):
    """Deletes a source, and those before it."""
    from paraview import simple

    before = source.Input if source.SMProxy.GetProperty("Input") else None
    simple.Delete(source)
    if before is not None:
        _delete(before)


def _largest_miss(source, back):
    """The largest distance of points from where the map and its inverse take them (mm)."""
    import numpy
    from paraview import servermanager
    from vtkmodules.util.numpy_support import vtk_to_numpy

    there, again = (vtk_to_numpy(servermanager.Fetch(each).GetPoints().GetData())
                    for each in (source, back))
    return numpy.linalg.norm(there - again, axis=1).max()


def _hold_fields(report):
    """Fields count between and outside their points as in Slicer, not as in ITK."""
    report.GetProperty("FieldsBetween").SetElement(0, 1)
    report.UpdateVTKObjects()


def _identity():
    import numpy

    return numpy.eye(4)


def _is_setting(node):
    """Whether a node holds nothing that a picture of the patient lacks without it."""
    return (node.kind in _SETTINGS or node.kind.endswith(("Storage", "Display", "DisplayNode"))
            or node.attributes.get("hideFromEditors") == "true" and not node.reference("storage"))


def _without_space(reader, name):
    """A model that no longer says the axes of its file, before it is turned around."""
    from paraview import simple

    fields = reader.GetDataInformation().GetFieldDataInformation()
    if not fields.GetArrayInformation("SPACE"):
        return reader
    names = [fields.GetArrayInformation(i).GetName() for i in range(fields.GetNumberOfArrays())]
    return simple.PassArrays(registrationName=free_name(f"{name} in LPS"), Input=reader,
                             FieldDataArrays=[each for each in names if each != "SPACE"] or
                             ["none of them"])  # an empty list would let all pass


def _axes_of_model(reader, path, end, storage):
    """"RAS" or "LPS": the word of the file, else that of the scene; scenes before Slicer 4.11 have
    none and mean RAS. InputAxes.cxx knows the same places, for models without a scene."""
    with open(path, "rb") as file:
        header = file.read(_HEADER_BYTES)
    if end == ".vtk":
        header = b"\n".join(header.split(b"\n")[:2])
    elif end == ".stl":
        header = header[:80] if not header.startswith(b"solid") else header.split(b"\n")[0]
    elif end == ".ply":
        header = header.split(b"end_header")[0]
    elif end == ".obj":
        header = b"\n".join(line for line in header.split(b"\n") if line.startswith(b"#"))
    else:
        header = b""
    fields = reader.GetDataInformation().GetFieldDataInformation().GetArrayInformation("SPACE")
    word = fields.GetStringValue(0).encode() if fields else b""
    for axes in ("RAS", "LPS"):
        if b"SPACE=" + axes.encode() in header or word == axes.encode():
            return axes
    axes = storage.attributes.get("coordinateSystem", "RAS")
    named = {"0": "RAS", "1": "LPS", "RAS": "RAS", "LPS": "LPS"}.get(axes)
    if named is None:
        raise SceneProblem(f"is in the axes {axes}; they must be RAS or LPS")
    return named


def open_scene(path, folder=None, outside=False):
    """Open a scene of 3D Slicer: volumes, segmentations, markups and models below its transforms.

    - `path`: path of a `.mrml` or a `.mrb`. The scene is read where Python runs, its data where the
      volumes are.
    - `folder`: a folder for the files of a bundle and for matrices that ParaView's readers need as
      files. Default: the name of the scene with `-opened`, beside it.
    - `outside`: whether a `.mrml` may name files that are not below its folder. Default: `False`,
      so that a scene of a stranger reads nothing else.

    Each thing has its name in the scene. Rigid transforms place the reader of a volume; what bends
    becomes the Lattice of a Free-Form Deformation. Points and surfaces move by the exact map. If a
    view is active, what the scene shows is shown in it.

    Returns a named tuple. `volumes`, `segmentations`, `points` and `models` are dictionaries of
    names and ParaView sources. `transforms` is one of names and results of `read_transform`, whose
    `map` takes points of the world below the transform, and `map_back` points below it to the
    world. `notes` are the sentences that are also warnings: what is not opened, and why.

    Raises `ValueError` with the reason if the file is no scene.
    """
    from paraview import simple

    path, active = os.fspath(path), simple.GetActiveSource()
    made = {}

    def own(needed=0):
        if "folder" not in made:
            made["folder"], note = folder_for(path, folder, needed)
            notes.extend([note] if note else [])
        return made["folder"]

    notes = []
    try:
        scene_path, found = unpack(path, own) if path.lower().endswith(".mrb") else (path, [])
        notes.extend(found)
        opening = _Opening(read_scene(scene_path), own, outside and scene_path == path)
        if folder is not None:
            own()
    except (SceneProblem, OSError) as problem:
        reason = str(problem) if isinstance(problem, SceneProblem) else f"cannot be read: {problem}"
        raise ValueError(f"Scene {path} {with_way_out(reason)}") from problem
    opening.run()
    opening.found.notes[:0] = notes
    for note in opening.found.notes:
        warnings.warn(f"Scene {os.path.basename(path)}: {note}", stacklevel=2)
    show_all(opening.scene, opening.shown)
    simple.SetActiveSource(next(iter(opening.found.volumes.values()), active))
    return opening.found


def open_in_window(path):
    """`open_scene` for File > Open: its warnings go to Output Messages."""
    from paraview import servermanager
    from vtkmodules.vtkCommonCore import vtkOutputWindow

    if servermanager.ActiveConnection.IsRemote() and not os.path.isfile(path):
        vtkOutputWindow.GetInstance().DisplayErrorText(
            f"Scene {path} is on the server, and scenes are read on the machine of the window. "
            "Copy its folder there, to the same path, or disconnect from the server.\n")
        return ""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            open_scene(path)
        except ValueError as problem:
            vtkOutputWindow.GetInstance().DisplayErrorText(f"{problem}\n")
    for warning in caught:
        vtkOutputWindow.GetInstance().DisplayWarningText(f"{warning.message}\n")
    return ""
