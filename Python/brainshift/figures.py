# SPDX-License-Identifier: BSD-3-Clause
"""Writes pictures, numbers and animations of a deformation as files, for papers and reports."""

import contextlib
import csv
import io
import os

from .drawing import colored_difference, histogram_svg, png, with_scale_bar
from .version import VERSION

#: Lengths of a scale bar, as multiples of a power of ten.
ROUND = (1, 2, 5)

#: Longest scale bar, as a fraction of the picture's width.
LONGEST_BAR = 0.2

#: Largest multiple of pixels that writers of movies ask for along a side.
MOVIE_STEP = 4

#: Endings of animations, and the module and class of the writer of each.
MOVIES = {".ogv": ("vtkIOOggTheora", "vtkOggTheoraWriter"),
          ".avi": ("vtkIOFFMPEG", "vtkFFMPEGWriter")}

DARK, BRIGHT = "blue: darker after", "orange: brighter after"


def _stands_on(source, bent):
    """Whether a source is the deformation, or is made from it along first inputs."""
    while source is not None and source != bent:
        source = getattr(source, "Input", None)
    return source is not None


def _view_of(bent, view):
    """The view to draw: the given one, else the active one, else one that shows the volume."""
    from paraview import simple

    def shows(candidate):
        return candidate is not None and any(
            _stands_on(getattr(display, "Input", None), bent) and display.Visibility
            for display in getattr(candidate, "Representations", []))

    if view is None:
        candidates = [simple.GetActiveView(), *simple.GetRenderViews()]
        view = next((candidate for candidate in candidates if shows(candidate)), None)
    if view is None or not shows(view):
        raise ValueError("no render view shows the volume" if view is None
                         else "the view does not show the volume")
    return view


def _traces_of(bent):
    """The first Trace Distance that measures the distance to the deformed volume, or None."""
    from paraview import simple

    return next((source for source in simple.GetSources().values()
                 if source.SMProxy.GetXMLName() == "TraceDistance"
                 and _stands_on(source.Deformation, bent)), None)


def _checked(bent, size):
    if getattr(bent, "SMProxy", bent).GetXMLName() != "FreeFormDeformation":
        raise ValueError("bent must be a Free-Form Deformation")
    width, height = (int(side) for side in size)
    if min(width, height) < 64:
        raise ValueError(f"size is {width} x {height}; each side must be at least 64 pixels")
    return width, height


@contextlib.contextmanager
def _strength_kept(bent):
    """Restores Strength, also after an error."""
    before = bent.Strength
    try:
        yield
    finally:
        bent.Strength = before
        bent.UpdatePipeline()


@contextlib.contextmanager
def _without_crosshair(view):
    """Hides the crosshairs of slices, which end where the deformed volume does; they come back."""
    shown = [display for display in view.Representations
             if getattr(display, "Visibility", 0) and getattr(display, "ShowCrosshair", 0)]
    try:
        for display in shown:
            display.ShowCrosshair = 0
        yield bool(shown)
    finally:
        for display in shown:
            display.ShowCrosshair = 1


def _pixels(view, size):
    """The picture of a view in `size`: bytes, indexed [row from below, column, rgb]."""
    from paraview import servermanager
    from vtkmodules.util.numpy_support import vtk_to_numpy

    controller = servermanager.ParaViewPipelineController()
    camera = servermanager.misc.SaveScreenshot()
    controller.PreInitializeProxy(camera)
    camera.View, camera.Layout, camera.SaveAllViews = view, None, 0
    camera.UpdateDefaultsAndVisibilities("picture.png")
    controller.PostInitializeProxy(camera)
    camera.ImageResolution = list(size)
    image = camera.SMProxy.CaptureImage()
    if image is None:
        raise RuntimeError(f"ParaView drew no picture of {size[0]} x {size[1]} pixels")
    width, height, _ = image.GetDimensions()
    scalars = vtk_to_numpy(image.GetPointData().GetScalars())
    return scalars.reshape(height, width, -1)[:, :, :3].copy()


def _mm_in_pixel(view, height):
    """Size of a pixel of a picture (mm), and the name of the projection.

    In a parallel projection this holds everywhere, in a perspective one at the focal point.
    """
    import math

    if view.CameraParallelProjection:
        return 2 * view.CameraParallelScale / height, "parallel"
    distance = math.dist(view.CameraPosition, view.CameraFocalPoint)
    half = math.tan(math.radians(view.CameraViewAngle) / 2)
    return 2 * distance * half / height, "perspective"


def _bar_length(limit):
    """The longest round length that is not above a limit (mm)."""
    import math

    power = 10.0 ** math.floor(math.log10(limit))
    return max(step * power for step in ROUND if step * power <= limit * (1 + 1e-9))


def _scale(view, size):
    """Settings of the scale bar: its length, and where it is valid."""
    mm, projection = _mm_in_pixel(view, size[1])
    length = _bar_length(LONGEST_BAR * size[0] * mm)
    where = "" if projection == "parallel" else " at the focal point"
    return {"mm": length, "pixels": length / mm, "label": f"{length:g} mm{where}",
            "projection": projection, "pixel": mm}


def _volume_name(bent):
    """Name of the file that the volume was read from, without its folder, or of the source."""
    from paraview import servermanager

    source = bent
    while getattr(source, "Input", None) is not None:
        source = source.Input
    for name in ("FileName", "FileNames"):
        value = getattr(source, name, None)
        if value:
            return os.path.basename(value if isinstance(value, str) else value[0])
    return servermanager.ProxyManager().GetProxyName("sources", source.SMProxy) or "unknown"


def _versions():
    from paraview import servermanager
    from vtkmodules.vtkCommonCore import vtkVersion

    paraview = servermanager.vtkSMProxyManager.GetParaViewSourceVersion()
    return [("BrainShift", VERSION, ""),
            ("ParaView", paraview.replace("paraview version", "").strip(), ""),
            ("VTK", vtkVersion.GetVTKVersion(), "")]


def _settings(bent, scale, size):
    """The settings that pictures depend on, as rows of name, value and unit."""
    strokes = len(bent.Strokes) // 14
    return [
        ("Volume", _volume_name(bent), ""),
        ("Strokes", strokes, ""),
        ("Enabled strokes", sum(number != 0 for number in bent.Strokes[13::14]), ""),
        ("Lattice", " x ".join(str(side) for side in bent.LatticeDimensions), "control points"),
        ("Kernel", bent.GetProperty("Kernel").GetData(), ""),
        ("Strength", float(bent.Strength), ""),
        ("Guard folding", int(bent.GuardFolding), ""),
        ("Inverse", bent.GetProperty("Inverse").GetData(), ""),
        ("Picture", f"{size[0]} x {size[1]}", "pixels"),
        ("Projection", scale["projection"], ""),
        ("Scale bar", float(scale["mm"]), "mm"),
        ("Pixel" if scale["projection"] == "parallel" else "Pixel at the focal point",
         float(scale["pixel"]), "mm"),
        *_versions()]


def _bend_numbers(bent):
    bent.UpdatePipeline()
    bent.SMProxy.UpdatePropertyInformation()
    return [("Maximum displacement", float(bent.MaximumDisplacement), "mm"),
            ("Minimum Jacobian", float(bent.MinimumJacobian), ""),
            ("Shortened strokes", int(bent.ShortenedStrokes), "")]


def _trace_numbers(traces, when):
    """Rows of the trace's figures, and its histogram."""
    if traces is None:
        return [], None
    traces.UpdatePipeline()
    traces.SMProxy.UpdatePropertyInformation()
    rows = [(f"Trace points {when}", int(traces.Count), "")]
    rows += [(f"Trace {label} {when}", float(getattr(traces, name)), "mm") for label, name in
             (("mean", "Mean"), ("RMS", "RMS"), ("95th percentile", "Percentile95"))]
    return rows, list(traces.Histogram)


def _csv_text(rows):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("name", "value", "unit"))
    writer.writerows((name, repr(value) if isinstance(value, float) else value, unit)
                     for name, value, unit in rows)
    return text.getvalue()


def _as_text(rows):
    """Rows as the dict of texts that pictures carry."""
    return {name: f"{value!r} {unit}".strip() if isinstance(value, float)
            else f"{value} {unit}".strip() for name, value, unit in rows}


def _in_a_line(rows):
    """The figures of a trace, shortened to two decimals."""
    texts = (f"{name.removeprefix('Trace ').rsplit(' ', 1)[0]} "
             + (f"{value:.2f}" if isinstance(value, float) else str(value)) + f" {unit}"
             for name, value, unit in rows)
    return ", ".join(text.strip() for text in texts)


def _write(folder, name, content):
    path = os.path.join(folder, name)
    with open(path, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode("utf-8"))
    return path


def figure(bent, folder, traces=None, view=None, size=(1200, 900)):
    """Write pictures and numbers of a deformation into a folder.

    It writes these files and replaces old ones of the same names:

    - `before.png`: the view with `Strength` 0, the volume as loaded.
    - `after.png`: the view with `Strength` as it is.
    - `difference.png`: where the two pictures differ, without crosshairs. Orange is brighter
      after, blue is darker after. Full colour is a difference of half the full scale of brightness.
    - `histogram.svg`: distances of the traced points to the cortex before and after, in mm, if
      there is a Trace Distance.
    - `numbers.csv`: settings and figures as rows of `name,value,unit`.

    All pictures have one camera, that of the view. Each has a scale bar. In a parallel projection
    the bar is valid everywhere, in a perspective one at the focal point. The PNG files carry the
    settings as text: name of the volume without its folder, number of strokes, lattice, kernel,
    strength, scale and versions. `Strength` is restored afterwards, also after an error.

    - `bent`: a Free-Form Deformation.
    - `folder`: path of the folder. It is made if it is missing.
    - `traces`: a Trace Distance. Default: the first one that measures to the deformed volume, if
      there is one.
    - `view`: a render view that shows the deformed volume. Default: the active view, or else the
      first view that shows it. A picture shows the same height as the view.
    - `size`: width and height of the pictures in pixels. Default: 1200 x 900.

    Returns a list of the paths of the files.

    Raises `ValueError` if no view shows the volume, `Strength` is 0 or `size` is below 64 pixels,
    and `OSError` with the path if a file cannot be written.
    """
    size = _checked(bent, size)
    view = _view_of(bent, view)
    if bent.Strength == 0:
        raise ValueError("Strength is 0; the pictures before and after would be the same")
    os.makedirs(folder, exist_ok=True)
    traces = traces or _traces_of(bent)
    scale = _scale(view, size)
    settings = _settings(bent, scale, size)
    with _strength_kept(bent):
        bent.Strength = 0.0
        earlier, old_histogram = _trace_numbers(traces, "before")
        before = _pixels(view, size)
        with _without_crosshair(view) as hidden:
            compared = [_pixels(view, size) if hidden else before]
    after = _pixels(view, size)
    with _without_crosshair(view) as hidden:
        compared.append(_pixels(view, size) if hidden else after)
    later, new_histogram = _trace_numbers(traces, "after")
    texts = _as_text(settings)
    pictures = {"before": (before, {"Strength": "0.0"}), "after": (after, {}),
                "difference": (colored_difference(*compared),
                               {"Colours": f"{DARK}; {BRIGHT}"})}
    paths = [_write(folder, f"{name}.png", png(with_scale_bar(pixels, scale), {
        "Title": name, **texts, **own})) for name, (pixels, own) in pictures.items()]
    if traces is not None:
        paths.append(_write(folder, "histogram.svg", histogram_svg(
            (old_histogram, _in_a_line(earlier)), (new_histogram, _in_a_line(later)), texts)))
    rows = settings + _bend_numbers(bent) + earlier + later
    return [*paths, _write(folder, "numbers.csv", _csv_text(rows))]


class _Movie:
    """One file with all pictures. The writers themselves would not name a file that fails."""

    def __init__(self, file, rate):
        import importlib

        module, name = MOVIES[os.path.splitext(file)[1]]
        try:
            self._writer = getattr(importlib.import_module(f"vtkmodules.{module}"), name)()
        except ImportError as error:
            raise ValueError(f"this ParaView cannot write {file}; write .png instead") from error
        with open(file, "wb"):
            self.paths = [file]
        self._writer.SetFileName(file)
        self._writer.SetRate(rate)
        self._writer.SetQuality(2)  # the best
        self._started = False

    def add(self, pixels, _):
        from .drawing import as_image

        self._writer.SetInputData(as_image(pixels))
        if not self._started:
            self._started = True
            self._writer.Start()
        self._writer.Write()
        if self._writer.GetError():
            raise OSError(f"{self.paths[0]} was not written; the disk may be full")

    def close(self):
        if self._started:
            self._writer.End()


class _Series:
    """A numbered picture for each frame."""

    def __init__(self, file):
        self._stem = os.path.splitext(file)[0]
        self.paths = []

    def add(self, pixels, texts):
        path = f"{self._stem}.{len(self.paths):04d}.png"
        self.paths.append(_write(os.path.dirname(path), os.path.basename(path), png(pixels, texts)))

    def close(self):
        pass


def animate(bent, file, view=None, size=(1200, 900), frames=50, rate=25):
    """Write an animation in which `Strength` goes from 0 to 1.

    Each picture has a scale bar, as those of `figure`. `Strength` is restored afterwards, also
    after an error.

    - `bent`: a Free-Form Deformation.
    - `file`: path of the file. Its ending chooses the format: `.ogv` (Ogg Theora) or `.avi` for
      a movie, `.png` for one numbered picture per frame: `NAME.0000.png` and so on. The folder must
      exist.
    - `view`: a render view that shows the deformed volume. Default: the active view, or else the
      first view that shows it.
    - `size`: width and height in pixels, multiples of 4 for a movie. Default: 1200 x 900.
    - `frames`: number of pictures, at least 2. Default: 50.
    - `rate`: pictures per second of a movie. Default: 25.

    Returns a list of the paths of the files.

    Raises `ValueError` if an argument is none of these or no view shows the volume, and `OSError`
    with the path if a file cannot be written.
    """
    width, height = size = _checked(bent, size)
    view = _view_of(bent, view)
    ending = os.path.splitext(file)[1]
    if ending != ".png" and ending not in MOVIES:
        raise ValueError(f"file is {file}; it must end in {', '.join(MOVIES)} or .png")
    if ending != ".png" and (width % MOVIE_STEP or height % MOVIE_STEP):
        raise ValueError(f"size is {width} x {height}; a movie needs multiples of {MOVIE_STEP}")
    if frames < 2:
        raise ValueError(f"frames is {frames}; it must be at least 2")
    scale = _scale(view, size)
    settings = [row for row in _settings(bent, scale, size) if row[0] != "Strength"]
    target = _Series(file) if ending == ".png" else _Movie(file, rate)
    try:
        with _strength_kept(bent):
            for frame in range(frames):
                bent.Strength = frame / (frames - 1)
                texts = _as_text([*settings, ("Strength", float(bent.Strength), "")])
                target.add(with_scale_bar(_pixels(view, size), scale), texts)
    finally:
        target.close()
    view.SMProxy.StillRender()  # a window shows Strength as it is again
    return target.paths
