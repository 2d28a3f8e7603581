# SPDX-License-Identifier: BSD-3-Clause
"""Writes volumes as OME-Zarr images with several resolutions, and draws them from there."""

import json
import os

VERSIONS = {"0.4": "0.4 (zarr 2)", "0.5": "0.5 (zarr 3)"}


LABELS = {None: "As The Volume Says", True: "Yes", False: "No"}


def pyramid(source, out=None, array=None, world=None, version="0.4", progress=None, labels=None):
    """Write a volume as an OME-Zarr image, with all its levels.

    The volume is read and written piece by piece, so it may be larger than memory if its reader
    reads parts: OME-Zarr, and NIfTI files of one volume. If the function was stopped, call it again
    with the same names: the volume is read again, and what is written of the same voxels is kept.

    - `source`: path of a file or folder, or a ParaView source of an image.
    - `out`: folder to write, on the machine that computes. Its name ends in `.zarr`. The default,
      `None`, is the path of the source with `.ome.zarr` in place of its ending. A folder that is
      not empty is refused, unless its image was not finished.
    - `array`: name of the point array to write. The default, `None`, takes the active scalars.
    - `world`: `"RAS"` or `"LPS"`, the world axes of the volume. The default, `None`, takes those
      that are attached to the volume. Without them the volume is written as RAS, with a warning.
    - `version`: `"0.4"` (default) or `"0.5"`, of OME-Zarr.
    - `labels`: whether the values are labels, `True` or `False`. The default, `None`, takes what
      the volume says. Many files of labels say nothing: their coarser levels would have means.
    - `progress`: called with the fraction that is done, 0 to 1. If it returns `False`, writing
      stops. Only where this process computes. The default, `None`, reports nothing.

    Of several times one is written, the first of a file, and a warning says so.

    Returns the path of the folder. Each coarser level has means of up to 2 x 2 x 2 voxels, whole
    numbers rounded; of labels the most frequent, of as frequent ones the first.

    Raises `OSError` with the reason if the image is not written or not finished, and `ValueError`
    for other words.
    """
    from paraview import servermanager, simple

    from .files import _world, _write
    from .roles import reader_of

    if version not in VERSIONS:
        raise ValueError(f"version is {version!r}; it must be \"0.4\" or \"0.5\"")
    if labels not in LABELS:
        raise ValueError(f"labels is {labels!r}; it must be None, True or False")
    is_path = isinstance(source, (str, os.PathLike))
    if not is_path and out is None:
        raise ValueError("out is missing: it names the folder to write")
    out = _stem(os.fspath(source)) + ".ome.zarr" if out is None else os.fspath(out)
    if not out.rstrip("/").endswith(".zarr"):
        raise ValueError(f"out is {out!r}; it must end in .zarr")
    world = _world(world)
    volume = reader_of(source) if is_path else source
    if is_path and volume.SMProxy.GetXMLName() == "OMEZarrReader":
        volume.Level = 0
    try:
        writer = servermanager.writers.OMEZarrWriter(
            Input=volume, FileName=out, PointArray=array or "", World=world,
            Version=VERSIONS[version], Labels=LABELS[labels])
        _watch(writer, progress)
        _write(writer, out)
    finally:
        if is_path:
            simple.Delete(volume)
    return out


def _stem(path):
    """A path without its ending, which may have two parts, such as `.nii.gz`. Names of folders have
    none but that of a store, and a number is none."""
    path = path.rstrip("/")
    for known in (".ome.zarr", ".zarr"):
        if path.lower().endswith(known):
            return path[:-len(known)]
    stem, ending = os.path.splitext(path)
    if os.path.isdir(path) or ending[1:].isdigit():
        return path
    return os.path.splitext(stem)[0] if ending.lower() == ".gz" else stem


def _watch(writer, progress):
    """Calls `progress` while a writer of this process works."""
    own = writer.GetClientSideObject() if progress else None
    if own is None:
        return

    def report(*_):
        if progress(own.GetProgress()) is False:
            own.SetAbortExecute(1)
    own.AddObserver("ProgressEvent", report)


def draw_from_pyramid(source, out=None, array=None, progress=None):
    """Draw a volume that is too large for the graphics card with all its voxels.

    The volume is written as an OME-Zarr image by `pyramid`, and an OME-Zarr Reader of it takes the
    place of the volume: Deformed Volume and Deformed Slices then draw bricks of its voxels where
    the view needs them. Strokes, masks, displays and all that is made of the deformation stay, and
    so does the source of the volume, which other filters may use. If the image is not written,
    because of an error or a stop, nothing is changed.

    - `source`: a Free-Form Deformation, whose `Input` becomes the reader, or another ParaView
      source of an image. Its displays as Deformed Volume and Deformed Slices then show the reader.
    - `out`: folder to write, on the machine that computes. Its name ends in `.zarr`. The default,
      `None`, is the path of the volume's file with `.ome.zarr` in place of its ending.
    - `array`: name of the point array to write, which the reader's array has, too. The default,
      `None`, takes the one that is drawn, or else the active scalars. Other arrays stay behind.
    - `progress`: called with the fraction that is done, 0 to 1. If it returns `False`, writing
      stops. Only where this process computes. The default, `None`, reports nothing.

    Where the volume is drawn coarser now, the reader gets a `MemoryLimit` (MiB) of half of what is
    drawn, so that there is room for bricks.

    Returns the reader, a ParaView source.

    Raises `OSError` with the reason if the image is not written or not finished, and `ValueError`
    if there is no volume, if it is an OME-Zarr image already, has several times, is bent already,
    or if its world axes are LPS: the image would be in RAS.
    """
    from paraview import simple

    from .casesources import free_name, kept
    from .files import require_read

    is_bent = source.SMProxy.GetXMLName() == "FreeFormDeformation"
    volume = source.Input if is_bent else source
    _require_plain(volume)
    displays = _displays_of(source)
    array = array or _drawn_array(volume, displays)
    out = _beside(volume) if out is None else os.fspath(out)
    limit = _limit_beside_bricks(volume, array, displays)
    pyramid(volume, out, array, progress=progress)

    @kept
    def replace():
        name = os.path.basename(out.rstrip("/"))
        reader = simple.OMEZarrReader(registrationName=free_name(name), FileName=out,
                                      ArrayName=array, **limit)
        require_read(reader, simple.GetActiveSource())
        for user in [source] if is_bent else [one for one in displays if one.Input == volume]:
            user.Input = reader
        if is_bent:
            _take_role(source, volume, reader)
        return reader
    return replace()


def _require_plain(volume):
    """Raises `ValueError` if an image of a volume cannot take its place."""
    if volume is None:
        raise ValueError("the deformation has no Input; it must be a volume")
    volume.UpdatePipeline()
    data = volume.GetDataInformation()
    fields = data.GetFieldDataInformation()
    world = fields.GetArrayInformation("WorldAxes")
    if not data.DataSetTypeIsA("vtkImageData"):
        raise ValueError("the source is no volume; it must be an image")
    if volume.SMProxy.GetXMLName() == "OMEZarrReader":
        raise ValueError("the volume is an OME-Zarr image already; a lower MemoryLimit of its "
                         "reader leaves room for bricks of its finer levels")
    if fields.GetArrayInformation("FFDDisplacements"):
        raise ValueError("the volume is bent already; an OME-Zarr image holds no deformation")
    if data.GetNumberOfTimeSteps() > 1:
        raise ValueError(f"the volume has {data.GetNumberOfTimeSteps()} times; the image would "
                         "have one of them")
    if world is not None and world.GetStringValue(0) == "LPS":
        raise ValueError("the world axes of the volume are LPS; its image would be in RAS, away "
                         "from what is here")


def _displays_of(source):
    """The displays that show a source, or what is made of it, as Deformed Volume or Deformed
    Slices."""
    from paraview import simple

    from .answers import REPRESENTATIONS
    from .casesources import inputs_of

    every = [display for view in simple.GetRenderViews() for display in view.Representations]
    return [display for display in every
            if getattr(display, "Representation", None) in REPRESENTATIONS and display.Visibility
            and source.SMProxy.GetGlobalID() in inputs_of(display.Input)]


def _drawn_array(volume, displays):
    """The name of the point array of a volume that is drawn, or else of its active scalars."""
    points = volume.GetDataInformation().GetPointDataInformation()
    drawn = [display.ColorArrayName[1] for display in displays
             if display.ColorArrayName[0] == "POINTS"]
    scalars = points.GetAttributeInformation(0)
    known = next((name for name in drawn if points.GetArrayInformation(name)), None)
    return known or (scalars.GetName() if scalars else None)


def _beside(volume):
    """The path of an image beside the file of a volume."""
    from .casesources import paths_of

    paths = list(paths_of(volume))
    if not paths:
        raise ValueError("out is missing: it names the folder to write")
    return _stem(paths[0]) + ".ome.zarr"


def _limit_beside_bricks(volume, array, displays):
    """The `MemoryLimit` of the reader, MiB, as a dict: half of the voxels that are drawn now; the
    rest is for bricks. Empty if all are drawn."""
    from vtkmodules.vtkCommonCore import VTK_DOUBLE, vtkDataArray

    from .answers import gpu

    joined = max((gpu(display)["gpuVoxelsPerTexel"] for display in displays), default=1)
    data = volume.GetDataInformation()
    kind = data.GetPointDataInformation().GetArrayInformation(array) if array else None
    if joined <= 1 or kind is None:
        return {}
    size = vtkDataArray.GetDataTypeSize(kind.GetDataType())
    size = size if kind.GetDataType() == VTK_DOUBLE else min(size, 4)  # as they are written
    bytes_of_all = data.GetNumberOfPoints() * kind.GetNumberOfComponents() * size
    return {"MemoryLimit": bytes_of_all / joined / 2 / 2 ** 20}


def _take_role(bent, volume, reader):
    """Lets the cases that a deformation is of take a reader for their volume, or they would set
    their former one again."""
    from .casesources import MARK, marks

    for role, case in marks(bent):
        key = f"{MARK}volume.{case}"
        if role == "bent" and volume.SMProxy.HasAnnotation(key):
            volume.SMProxy.RemoveAnnotation(key)
            reader.SMProxy.SetAnnotation(key, "1")


def draw_in_window(text):
    """`draw_from_pyramid` for the button of the window.

    - `text`: JSON with `source`, the name of the source in the pipeline, and `out`

    Returns why nothing was changed: a sentence, or an empty text.
    """
    from paraview import servermanager

    asked = json.loads(text)
    source = servermanager.ProxyManager().GetProxy("sources", asked["source"])
    try:
        draw_from_pyramid(source, asked["out"])
    except (OSError, ValueError) as problem:
        return str(problem).rstrip(".")
    return ""
