# SPDX-License-Identifier: BSD-3-Clause
"""Saves a bent volume as a scene of 3D Slicer."""

import gzip
import html
import json
import math
import os
import re
import shutil
import tempfile
import warnings
from xml.sax.saxutils import quoteattr

from .casesources import inputs_of, properties_of, require_kind, sources, stem
from .files import _write, reason_of, save_field, save_volume
from .mrb import MARK, _whole, pack
from .mrml import WORLD_POINTS, decoded, encoded
from .views import world_axes

#: The version of Slicer whose scenes these are.
_VERSION = "Slicer 5.0.3 30893"

#: Signs that names of files must not have on some machine.
_FORBIDDEN = re.compile(r'[\x00-\x1f\\/:*?"<>|]+')

#: Names that Windows keeps for devices, whatever ending follows.
_DEVICE = re.compile(r"(?i:con|prn|aux|nul|com\d|lpt\d) *(?:\..*)?")

#: What XML cannot hold.
_NO_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")

#: Most values of a label map that become segments.
_MOST_SEGMENTS = 10_000

#: Types of labels in NRRD files.
_TYPES = {"u1": "uint8", "<u2": "uint16", "<u4": "uint32"}

#: What axes of a rigid transform may miss length 1 and right angles by, as in open_scene.
_RIGID = 1e-5

#: Colours of segments that have none.
_COLORS = ((1, 0.6, 0.2), (0.3, 0.7, 1), (0.4, 0.85, 0.4), (0.9, 0.4, 0.7), (0.9, 0.9, 0.3))


def _name(source):
    """What a source is called in the scene."""
    return stem(source).removesuffix(".seg")


def _list(given):
    return list(given) if isinstance(given, (list, tuple)) else [given]


def _kind(source):
    return source.SMProxy.GetXMLName()


def _texts_of(proxy):
    """The texts that the properties of a proxy hold; those that name files are among them."""
    for texts in properties_of(proxy, "vtkSMStringVectorProperty"):
        yield from (texts.GetElement(i) or "" for i in range(texts.GetNumberOfElements()))


def _is_read(folder, given):
    """Whether a source of the pipeline, or one of those given, reads a file in a folder."""
    inside = os.path.realpath(folder)
    proxies = {}
    for source in [*sources(), *given]:
        proxies.update(inputs_of(source))
    paths = {os.path.realpath(text) for proxy in proxies.values() for text in _texts_of(proxy)
             if os.path.isabs(text) or os.path.exists(text)}
    return any(path == inside or path.startswith(inside + os.sep) for path in paths)


def _files_in(folder):
    """Of each file in a folder: its size (bytes) and when it was written (ns)."""
    found = {}
    for name in os.listdir(folder):
        if name != MARK:
            known = os.stat(os.path.join(folder, name))
            found[name] = [known.st_size, known.st_mtime_ns]
    return found


def _mark(folder, scene):
    """Notes in a folder which scene has its files, and what they are."""
    with open(os.path.join(folder, MARK), "w", encoding="utf-8") as file:
        json.dump([os.path.basename(scene), _files_in(folder)], file)


def _is_own(folder, scene):
    """Whether a folder holds only files that were saved for a scene, as they were written."""
    try:
        with open(os.path.join(folder, MARK), encoding="utf-8") as file:
            return json.load(file) == [os.path.basename(scene), _files_in(folder)]
    except (OSError, ValueError):
        return False


def _is_named_beside(data, scene):
    """Whether another scene or state in the folder of a scene names a folder of data."""
    folder, name = os.path.split(data)
    for each in os.listdir(folder):
        if each == os.path.basename(scene) or not each.lower().endswith((".mrml", ".pvsm")):
            continue
        try:
            with open(os.path.join(folder, each), "rb") as file:
                text = html.unescape(file.read().decode("utf-8", "replace")).replace("\\", "/")
        except OSError:
            return True
        if f"{name}/" in text or f"{name}/" in decoded(text):
            return True
    return False


def _data_folders(folder, name):
    """The paths in a folder that have a name or that name with a number, by numbers from 1 on."""
    numbered = re.compile(re.escape(name) + "(?: ([1-9][0-9]{0,8}))?")
    found = ((each, numbered.fullmatch(each)) for each in os.listdir(folder))
    return {int(match[1] or 1): os.path.join(folder, each) for each, match in found if match}


class _Saving:
    """A scene that is being written: its nodes as text, its files in `folder`/`data`."""

    def __init__(self, folder, data):
        self.folder, self.data = folder, data
        self.lines, self.counts, self.taken = [], {}, set()
        os.makedirs(os.path.join(folder, data))  # a new one, so that no file is overwritten

    def node(self, kind, of_class, **attributes):
        """Adds a node; its identifier is that of Slicer's class with a number."""
        number = self.counts[of_class] = self.counts.get(of_class, 0) + 1
        identifier = f"vtkMRML{of_class}Node{number}"
        words = "".join(f" {key}={quoteattr(_NO_XML.sub('_', str(value)))}"
                        for key, value in attributes.items())
        self.lines.append(f' <{kind} id="{identifier}"{words}></{kind}>')
        return identifier

    def file(self, name, ending):
        """A free name of a file: relative to the scene, and its path."""
        base = _FORBIDDEN.sub("_", name).strip(" .") or "data"
        base = f"_{base}" if _DEVICE.fullmatch(base) else base
        free, number = base, 2
        while (free + ending).lower() in self.taken:
            free, number = f"{base} {number}", number + 1
        self.taken.add((free + ending).lower())
        inside = f"{self.data}/{free}{ending}"
        return inside, os.path.join(self.folder, inside)

    def stored(self, kinds, name, inside, above, display=""):
        """A node with a file: `kinds` are (tag, class) of it and of its storage."""
        (kind, of_class), (storage, storage_class) = kinds
        held = self.node(storage, storage_class, name=storage, hideFromEditors="true",
                         fileName=encoded(inside))
        refers = (f"display:{display};" if display else "") + f"storage:{held};"
        refers += f"transform:{above};" if above else ""
        return self.node(kind, of_class, name=name, hideFromEditors="false", selectable="true",
                         selected="false", references=refers)

    def volume(self, source, name, above=None):
        inside, path = self.file(name, ".nrrd")
        save_volume(source, path)
        display = self.node(
            "VolumeDisplay", "ScalarVolumeDisplay", name="VolumeDisplay", hideFromEditors="true",
            colorNodeID="vtkMRMLColorTableNodeGrey", interpolate="1", autoWindowLevel="1")
        return self.stored((("Volume", "ScalarVolume"),
                            ("VolumeArchetypeStorage", "VolumeArchetypeStorage")),
                           name, inside, above, display)

    def deformation(self, bent, name, spacing):
        """The grid transform of a Free-Form Deformation: the map from the parent, as Slicer
        keeps transforms in files."""
        inside, path = self.file(f"{name} deformation", ".nrrd")
        save_field(bent, path, "Backward", None if spacing is None else [spacing] * 3,
                   world_axes(bent.Input) or "RAS")
        return self.stored((("GridTransform", "GridTransform"),
                            ("TransformStorage", "TransformStorage")),
                           f"{name} deformation", inside, None)

    def segmentation(self, source, name, above):
        inside, path = self.file(name, ".seg.nrrd")
        _write_segments(source, path)
        display = self.node("SegmentationDisplay", "SegmentationDisplay",
                            name="SegmentationDisplay", hideFromEditors="true")
        return self.stored((("Segmentation", "Segmentation"),
                            ("SegmentationStorage", "SegmentationStorage")),
                           name, inside, above, display)

    def points(self, source, name, above):
        from paraview import servermanager, simple

        inside, path = self.file(name, ".mrk.json")
        active = simple.GetActiveSource()
        is_file = isinstance(source, (str, os.PathLike))
        read = simple.LandmarkReader(FileName=os.fspath(source)) if is_file else source
        try:
            read.UpdatePipeline()
            reason = reason_of(read) if is_file else ""
            if reason:
                raise ValueError(reason)
            _write(servermanager.writers.LandmarkWriter(Input=read, FileName=path), path)
        finally:
            if is_file:
                simple.Delete(read)
                simple.SetActiveSource(active)
        self.stored((("MarkupsFiducial", "MarkupsFiducial"),
                     ("MarkupsJsonStorage", "MarkupsJsonStorage")), name, inside, above,
                    self.node("MarkupsFiducialDisplay", "MarkupsFiducialDisplay",
                              name="MarkupsDisplay", hideFromEditors="true"))

    def slices(self, volume):
        """Shows a volume in Slicer's slices."""
        for color in ("Red", "Green", "Yellow"):
            self.lines.append(
                f' <SliceComposite id="vtkMRMLSliceCompositeNode{color}" name="SliceComposite" '
                f'hideFromEditors="true" singletonTag="{color}" layoutName="{color}" '
                f'references="backgroundVolume:{volume};"></SliceComposite>')

    def write(self, path):
        text = (f'<?xml version="1.0" encoding="UTF-8"?>\n<MRML  version="{_VERSION}" userTags="">'
                "\n" + "\n".join(self.lines) + "\n</MRML>\n")
        with _whole(path) as part, open(part, "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())


def _named(image, values):
    """Of each label: value, name, colour (0 to 1) and coded terms."""
    named, fields = {}, image.GetFieldData()
    labels, names, colors, terms = (fields.GetAbstractArray("Label" + name) for name in
                                    ("Values", "Names", "Colors", "Terms"))
    for i in range(labels.GetNumberOfTuples() if labels and names else 0):
        color = colors.GetTuple(i) if colors else (255, 255, 255)
        named[int(labels.GetTuple1(i))] = (names.GetValue(i), [each / 255 for each in color[:3]],
                                           terms.GetValue(i) if terms else "")
    return [(value, *named.get(value, (f"Label {value}", _COLORS[i % len(_COLORS)], "")))
            for i, value in enumerate(values)]


def _tags(terms):
    """Coded terms (LabelTerms) as a tag of Slicer, which names the lists that they are from."""
    parts = terms.split("~")
    if len(parts) < 3:
        return "|"
    parts += ["^^"] * (5 - len(parts))
    parts = ["Segmentation category and type - DICOM master list", *parts[:3],
             "Anatomic codes - DICOM master list", *parts[3:5]]
    return "TerminologyEntry:" + " ".join("~".join(parts).replace("|", " ").split()) + "|"


def _of_segments(segments, sides):
    """The lines of Slicer on segments in the header of their file."""
    extent = " ".join(f"0 {side - 1}" for side in sides)
    lines = []
    for i, (value, name, color, terms) in enumerate(segments):
        fields = {"ID": f"Segment_{value}", "Name": " ".join(name.split()), "NameAutoGenerated": 0,
                  "Color": " ".join(f"{each:.6g}" for each in color), "ColorAutoGenerated": 0,
                  "LabelValue": value, "Layer": 0, "Extent": extent, "Tags": _tags(terms)}
        lines += [f"Segment{i}_{key}:={word}" for key, word in fields.items()]
    return [*lines, "Segmentation_ContainedRepresentationNames:=Binary labelmap|",
            "Segmentation_MasterRepresentation:=Binary labelmap",
            "Segmentation_ReferenceImageExtentOffset:=0 0 0"]


def _geometry_of(image, signs):
    """The positions of the voxels of an image, as lines of an NRRD header in LPS."""
    import numpy

    matrix = image.GetDirectionMatrix()
    axes = numpy.array([[matrix.GetElement(i, j) for j in range(3)] for i in range(3)])
    steps = (signs[:, None] * axes * numpy.array(image.GetSpacing())).T
    first = [0.0, 0.0, 0.0]
    image.TransformIndexToPhysicalPoint(image.GetExtent()[::2], first)

    def words(vector):
        return "(" + ",".join(repr(float(each)) for each in vector) + ")"
    return ["space: left-posterior-superior",
            "space directions: " + " ".join(words(step) for step in steps),
            "space origin: " + words(signs * numpy.array(first))]


def _warn_of_labels(source):
    """The warnings that the writer of volumes gives."""
    times = source.GetPropertyValue("TimestepValues") if (
        source.SMProxy.GetProperty("TimestepValues")) else None
    times = [times] if isinstance(times, float) else list(times or [])
    if len(times) > 1:
        has = source.GetDataInformation()
        time = f", at {has.GetTime():g} s" if has.GetHasTime() else ""
        warnings.warn(f"The segmentation {stem(source)} has {len(times)} times; the scene has one "
                      f"of them{time}", stacklevel=2)
    if world_axes(source) is None:
        warnings.warn(f"The world axes of the segmentation {stem(source)} are unknown: it is "
                      "written as RAS", stacklevel=2)


def _write_segments(source, path):
    """Writes labels as a segmentation of Slicer, of one layer."""
    import numpy
    from paraview import servermanager
    from vtkmodules.util.numpy_support import vtk_to_numpy

    image = servermanager.Fetch(source)
    scalars = vtk_to_numpy(image.GetPointData().GetScalars())
    values = numpy.unique(scalars)
    if (scalars.ndim > 1 or len(values) > _MOST_SEGMENTS or values[0] < 0 or values[-1] >= 2**32
            or not (values == numpy.round(values)).all()):
        raise ValueError(f"the segmentation {stem(source)} has values from {values[0]} to "
                         f"{values[-1]}, {len(values)} of them; it must have whole numbers from 0 "
                         f"on, {_MOST_SEGMENTS} at most")
    _warn_of_labels(source)
    kind = next(each for each in ("u1", "<u2", "<u4") if values[-1] <= numpy.iinfo(each).max)
    sides = image.GetDimensions()
    signs = numpy.array((1.0, 1.0, 1.0) if world_axes(source) == "LPS" else (-1.0, -1.0, 1.0))
    segments = _named(image, [int(value) for value in values if value > 0])
    lines = ["NRRD0004", f"type: {_TYPES[kind]}", "dimension: 3", *_geometry_of(image, signs),
             "sizes: " + " ".join(str(side) for side in sides), "kinds: domain domain domain",
             "endian: little", "encoding: gzip", *_of_segments(segments, sides), "", ""]
    with _whole(path) as part, open(part, "wb") as file:
        file.write("\n".join(lines).encode())
        with gzip.GzipFile(fileobj=file, mode="wb", mtime=0) as packed:
            packed.write(scalars.astype(kind).tobytes())
        file.flush()
        os.fsync(file.fileno())


def _is_moved(points):
    """Whether points are deformed already: by Deform Geometry, unless that led them back, by a
    transform of a scene that bends, or below none that does in a scene whose volume is bent."""
    from paraview import servermanager

    manager = servermanager.ProxyManager().SMProxyManager
    proxies = inputs_of(points).values()
    steps = [1 - 2 * proxy.GetProperty("Direction").GetElement(0) for proxy in proxies
             if proxy.GetXMLName() == "DeformGeometry"]  # forward: 1, backward: -1
    marked = any(manager.IsProxyInGroup(proxy, WORLD_POINTS) for proxy in proxies)
    return sum(steps) + marked > 0 or any(
        proxy.GetXMLName() == "TransformReport" and _bends(proxy) for proxy in proxies)


def _bends(report):
    """Whether a transform does more than rotate, shift and mirror, which readers of volumes do."""
    import numpy

    report.UpdatePropertyInformation()
    rows = report.GetProperty("Matrix")
    numbers = numpy.array([rows.GetElement(i) for i in range(rows.GetNumberOfElements())])
    axes = numbers.reshape(-1, 4)[:3, :3]
    return len(axes) == 0 or bool(numpy.abs(axes.T @ axes - numpy.eye(3)).max() > _RIGID)


def _is_path(given):
    return isinstance(given, (str, os.PathLike))


def _require_things(given, spacing):
    """Raises `ValueError` if something given is of the wrong kind, or if there is nothing."""
    if spacing is not None and not (math.isfinite(spacing) and spacing > 0):
        raise ValueError(f"spacing is {spacing!r}; it must be a distance above 0 (mm) or None")
    if not any(given):
        raise ValueError("volumes, points and segmentations are empty; there is nothing to save")
    words = ("volumes", "points", "moved_points", "segmentations")
    for word, role, things in zip(words, ("volume", "landmarks", "landmarks", "segmentation"),
                                  given):
        for each in things:
            if role == "landmarks" and _is_path(each):
                continue
            if not hasattr(each, "SMProxy"):
                raise ValueError(f"{word} has {each!r}; it must have ParaView sources"
                                 + (" or paths of files" if role == "landmarks" else ""))
            require_kind(each, role)
    for volume in given[0]:
        _require_at_rest(volume.Input if _kind(volume) == "FreeFormDeformation" else volume)


def _require_at_rest(volume):
    """Raises `ValueError` for a volume that carries a deformation: it would be saved without."""
    fields = volume.GetDataInformation().GetFieldDataInformation()
    if fields.GetArrayInformation("FFDDisplacements") is not None:
        raise ValueError(f"the volume {stem(volume)} comes after a Free-Form Deformation, and "
                         "would be saved without it; give that filter itself, or a Bake "
                         "Deformation of this volume")


def _save_points(saving, points, above):
    """Adds points, `above` being the transform that they are below."""
    name = os.path.basename(points).split(".")[0] if _is_path(points) else _name(points)
    saving.points(points, name, above)


def _save_all(saving, given, how):
    """Adds what is to be saved; how: whether hardened, and the spacing."""
    from paraview import simple

    hardened, spacing = how
    volumes, points, moved_points, segmentations = given
    above = shown = None
    for volume in volumes:
        is_bent = _kind(volume) == "FreeFormDeformation"
        name = _name(volume.Input if is_bent else volume)
        transform = saving.deformation(volume, name, spacing) if is_bent else None
        node = saving.volume(volume.Input if is_bent else volume, name, transform)
        above, shown = above or transform, shown or node
        if is_bent and volume.Segmentation is not None:
            saving.segmentation(volume.Segmentation, _name(volume.Segmentation), transform)
        if is_bent and hardened:
            active = simple.GetActiveSource()
            baked = simple.BakeDeformation(Input=volume)
            try:
                saving.volume(baked, f"{name} hardened")
            finally:
                simple.Delete(baked)
                simple.SetActiveSource(active)
    for labels in segmentations:
        saving.segmentation(labels, _name(labels), above)
    for each in points:
        is_moved = not _is_path(each) and _is_moved(each)
        _save_points(saving, each, None if is_moved else above)
    for each in moved_points:
        _save_points(saving, each, None)
    if shown:
        saving.slices(shown)


def _save_beside(path, given, how):
    """Saves a `.mrml` and a new folder of data. Files of an earlier save remain until the new scene
    is whole, and longer if a source reads them."""
    folder, name = os.path.split(os.path.splitext(os.path.abspath(path))[0])
    os.makedirs(folder, exist_ok=True)
    former = _data_folders(folder, f"{name}-data")
    number = max(former, default=0) + 1
    saving = _Saving(folder, f"{name}-data" if number == 1 else f"{name}-data {number}")
    data = os.path.join(folder, saving.data)
    try:
        _save_all(saving, given, how)
        _mark(data, path)
        saving.write(path)
    except BaseException:
        shutil.rmtree(data, ignore_errors=True)
        raise
    proxies = [each for kind in given for each in kind if not _is_path(each)]
    for each in former.values():
        if (_is_own(each, path) and not _is_read(each, proxies)
                and not _is_named_beside(each, path)):
            shutil.rmtree(each, ignore_errors=True)


def save_scene(path, volumes, points=(), segmentations=(), hardened=True, spacing=2.0,
               moved_points=()):
    """Save bent volumes, landmarks and segmentations as a scene that 3D Slicer opens.

    - `path`: path of the scene to write: a `.mrml`, whose files are in a folder beside it that ends
      in `-data`, or a `.mrb`, which holds all.
    - `volumes`: a Free-Form Deformation or a volume, or a list of them. Of a Free-Form Deformation
      the scene has the volume at rest, above it the deformation as a grid transform, and its
      Segmentation below the same transform.
    - `points`: landmarks at rest: a source or the path of a file, or a list. They are written as
      `.mrk.json`, below the transform of the first Free-Form Deformation. Sources behind a Deform
      Geometry, and those that `open_scene` moved by a transform that bends or found below none that
      does, beside a volume that is bent, count as `moved_points`.
    - `segmentations`: a source of labels at rest, or a list. They are put below the same transform,
      with the names and colours of their segments.
    - `hardened`: whether a copy with the deformation baked into its voxels goes beside each bent
      volume. Default: `True`.
    - `spacing`: the distance between the points of the grid transform (mm). Default: 2. `None`
      takes the points of the volume. Slicer interpolates between them.
    - `moved_points`: landmarks at deformed positions, given like `points`. No transform is above
      them.

    Volumes are written where they are, the scene where Python runs. Nothing is overwritten but the
    scene: if there is a folder of its data, the new one ends in `-data 2`, and so on. The former
    one is deleted once the new scene is whole, unless it has other files, a source reads it, or
    another scene or state beside it names it. If the scene is not written, the former one remains.

    Raises `ValueError` if `path` has another ending, if something given is of the wrong kind or
    carries a deformation, and if labels are no whole numbers; `OSError` with the reason if a file
    is not written.
    """
    path = os.fspath(path)
    base, ending = os.path.splitext(path)
    if ending.lower() not in (".mrml", ".mrb"):
        raise ValueError(f"path is {path!r}; it must end in .mrml or .mrb")
    given = [_list(each) for each in (volumes, points, moved_points, segmentations)]
    _require_things(given, spacing)
    if ending.lower() == ".mrml":
        _save_beside(path, given, (hardened, spacing))
        return
    name = _FORBIDDEN.sub("_", os.path.basename(base))  # open_scene refuses a colon
    beside = os.path.dirname(os.path.abspath(path))
    os.makedirs(beside, exist_ok=True)
    around = tempfile.mkdtemp(prefix="brainshift-scene-", dir=beside)
    try:
        saving = _Saving(os.path.join(around, name.strip(" .") or "scene"), "Data")
        _save_all(saving, given, (hardened, spacing))
        saving.write(os.path.join(saving.folder, f"{name}.mrml"))
        pack(saving.folder, path)
    finally:
        shutil.rmtree(around, ignore_errors=True)
