# SPDX-License-Identifier: BSD-3-Clause
"""Saves a bent volume as a scene of 3D Slicer."""

import gzip
import os
import re
import shutil
import tempfile
from xml.sax.saxutils import quoteattr

from .casesources import stem
from .files import _write, save_field, save_volume
from .mrb import pack
from .mrml import encoded
from .views import world_axes

#: The version of Slicer whose scenes these are.
_VERSION = "Slicer 5.0.3 30893"

#: Signs that names of files must not have on some machine.
_FORBIDDEN = re.compile(r'[\x00-\x1f\\/:*?"<>|]+')

#: Most values of a label map that become segments.
_MOST_SEGMENTS = 10_000

#: Types of labels in NRRD files.
_TYPES = {"u1": "uint8", "<u2": "uint16", "<u4": "uint32"}

#: Colours of segments that have none.
_COLORS = ((1, 0.6, 0.2), (0.3, 0.7, 1), (0.4, 0.85, 0.4), (0.9, 0.4, 0.7), (0.9, 0.9, 0.3))


def _name(source):
    """What a source is called in the scene."""
    return stem(source).removesuffix(".seg")


def _sources(given):
    return list(given) if isinstance(given, (list, tuple)) else [given]


def _kind(source):
    return source.SMProxy.GetXMLName()


class _Saving:
    """A scene that is being written: its nodes as text, its files in `folder`/`data`."""

    def __init__(self, folder, data):
        self.folder, self.data = folder, data
        self.lines, self.counts, self.taken = [], {}, set()
        os.makedirs(os.path.join(folder, data), exist_ok=True)

    def node(self, kind, of_class, **attributes):
        """Adds a node; its identifier is that of Slicer's class with a number."""
        number = self.counts[of_class] = self.counts.get(of_class, 0) + 1
        identifier = f"vtkMRML{of_class}Node{number}"
        words = "".join(f' {key}={quoteattr(str(value))}' for key, value in attributes.items())
        self.lines.append(f' <{kind} id="{identifier}"{words}></{kind}>')
        return identifier

    def file(self, name, ending):
        """A free name of a file: relative to the scene, and its path."""
        base = _FORBIDDEN.sub("_", name).strip(" .") or "data"
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
        """The grid transform of a Free-Form Deformation: the way from the parent, as Slicer keeps
        transforms in files."""
        inside, path = self.file(f"{name} deformation", ".nrrd")
        save_field(bent, path, "Backward", [spacing] * 3 if spacing else None)
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
        with open(path + ".part", "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(path + ".part", path)


def _named(image, values):
    """Of each label: value, name and colour (0 to 1)."""
    named, fields = {}, image.GetFieldData()
    labels, names, colors = (fields.GetAbstractArray(name) for name in
                             ("LabelValues", "LabelNames", "LabelColors"))
    for i in range(labels.GetNumberOfTuples() if labels and names else 0):
        color = colors.GetTuple(i) if colors else (255, 255, 255)
        named[int(labels.GetTuple1(i))] = (names.GetValue(i), [each / 255 for each in color[:3]])
    return [(value, *named.get(value, (f"Label {value}", _COLORS[i % len(_COLORS)])))
            for i, value in enumerate(values)]


def _of_segments(segments, sides):
    """What Slicer says of segments in the header of their file."""
    extent = " ".join(f"0 {side - 1}" for side in sides)
    lines = []
    for i, (value, name, color) in enumerate(segments):
        said = {"ID": f"Segment_{value}", "Name": " ".join(name.split()), "NameAutoGenerated": 0,
                "Color": " ".join(f"{each:.6g}" for each in color), "ColorAutoGenerated": 0,
                "LabelValue": value, "Layer": 0, "Extent": extent, "Tags": "|"}
        lines += [f"Segment{i}_{key}:={word}" for key, word in said.items()]
    return [*lines, "Segmentation_ContainedRepresentationNames:=Binary labelmap|",
            "Segmentation_MasterRepresentation:=Binary labelmap",
            "Segmentation_ReferenceImageExtentOffset:=0 0 0"]


def _place_of(image, signs):
    """Where the voxels of an image lie, as lines of an NRRD header in LPS."""
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
    kind = next(each for each in ("u1", "<u2", "<u4") if values[-1] <= numpy.iinfo(each).max)
    sides = image.GetDimensions()
    signs = numpy.array((1.0, 1.0, 1.0) if world_axes(source) == "LPS" else (-1.0, -1.0, 1.0))
    segments = _named(image, [int(value) for value in values if value > 0])
    lines = ["NRRD0004", f"type: {_TYPES[kind]}", "dimension: 3", *_place_of(image, signs),
             "sizes: " + " ".join(str(side) for side in sides), "kinds: domain domain domain",
             "endian: little", "encoding: gzip", *_of_segments(segments, sides), "", ""]
    with open(path + ".part", "wb") as file:
        file.write("\n".join(lines).encode())
        with gzip.GzipFile(fileobj=file, mode="wb", mtime=0) as packed:
            packed.write(scalars.astype(kind).tobytes())
        file.flush()
        os.fsync(file.fileno())
    os.replace(path + ".part", path)


def _save_all(saving, volumes, points, segmentations, how):
    """Adds what is to be saved; how: whether hardened, and the spacing."""
    from paraview import simple

    hardened, spacing = how
    above = shown = None
    for volume in _sources(volumes):
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
    for labels in _sources(segmentations):
        saving.segmentation(labels, _name(labels), above)
    for each in _sources(points):
        is_path = isinstance(each, (str, os.PathLike))
        name = os.path.basename(each).split(".")[0] if is_path else _name(each)
        is_moved = not is_path and _kind(each) in ("DeformGeometry", "TransformPoints")
        saving.points(each, name, None if is_moved else above)
    if shown:
        saving.slices(shown)


def save_scene(path, volumes, points=(), segmentations=(), hardened=True, spacing=2.0):
    """Save bent volumes, landmarks and segmentations as a scene that 3D Slicer opens.

    - `path`: path of the scene to write: a `.mrml`, whose files are in a folder beside it that ends
      in `-data`, or a `.mrb`, which holds all.
    - `volumes`: a Free-Form Deformation or a volume, or a list of them. Of a Free-Form Deformation
      the scene has the volume at rest, above it the deformation as a grid transform, and its
      Segmentation below the same transform.
    - `points`: a source of landmarks or the path of a file of them, or a list. They are written as
      `.mrk.json`. Points at rest are put below the transform of the first Free-Form Deformation;
      the output of a Deform Geometry is moved already.
    - `segmentations`: a source of labels at rest, or a list. They are put below the same transform,
      with the names and colours of their segments.
    - `hardened`: whether a copy with the deformation baked into its voxels goes beside each bent
      volume. Default: `True`.
    - `spacing`: the distance between the points of the grid transform (mm). Default: 2. `None`
      takes the points of the volume. Slicer interpolates between them.

    Volumes are written where they are, the scene where Python runs.

    Raises `ValueError` if `path` has another ending or labels are no whole numbers, and `OSError`
    with the reason if a file is not written.
    """
    path = os.fspath(path)
    base, ending = os.path.splitext(path)
    if ending.lower() not in (".mrml", ".mrb"):
        raise ValueError(f"path is {path!r}; it must end in .mrml or .mrb")
    name = os.path.basename(base)
    if ending.lower() == ".mrml":
        saving = _Saving(os.path.dirname(os.path.abspath(path)), f"{name}-data")
        _save_all(saving, volumes, points, segmentations, (hardened, spacing))
        saving.write(path)
        return
    beside = os.path.dirname(os.path.abspath(path))
    around = tempfile.mkdtemp(prefix="brainshift-scene-", dir=beside)
    try:
        saving = _Saving(os.path.join(around, name.strip() or "scene"), "Data")
        _save_all(saving, volumes, points, segmentations, (hardened, spacing))
        saving.write(os.path.join(saving.folder, f"{name}.mrml"))
        pack(saving.folder, path)
    finally:
        shutil.rmtree(around, ignore_errors=True)
