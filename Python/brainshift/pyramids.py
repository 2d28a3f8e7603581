# SPDX-License-Identifier: BSD-3-Clause
"""Writes volumes as OME-Zarr images with several resolutions."""

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
