# SPDX-License-Identifier: BSD-3-Clause
"""Draws the pictures of a case for its report, in views of their own."""

import contextlib

from .answers import slice_axes
from .drawing import BLUE, ORANGE, with_scale_bar
from .figures import _pixels, _scale, _strength_kept
from .images import Labels, fetched
from .looks import look, looks
from .maps import deformed_from_rest, rest_from_deformed
from .views import (PLANES, WORLDS, _first_array, _look, _make_grey, _show_slice, _without_depth,
                    world_axes)

#: Fraction of the colours of labels over a slice.
_COVER = 0.6

#: As the window shows a trace (mm and red, green, blue): purple inside, white at the cortex, green
#: outside.
_TRACE_COLORS = (-1, 0.48, 0, 0.75, -0.25, 0.75, 0.35, 1, 0, 1, 1, 1,
                 0.25, 0.2, 0.85, 0.3, 1, 0, 0.5, 0.1)
_TRACE_SCALE_MM = 6.0
_POINT_PIXELS = 13.0  # in a picture 760 pixels wide, which is 67 mm wide in print

#: Where the tissue is in a picture, fractions: left, right, lower and upper edge. The scale bar is
#: below it, and the scale of distances right of it.
_FRAME = (0.03, 0.88, 0.12, 0.97)
_DARK = 8  # brightness (0 to 255) of the ground, at most


def _hidden_view():
    """A view that no window shows. The render windows of ParaView's own window draw only where they
    are seen: a picture of a new one would be what its memory held."""
    from paraview import servermanager, simple
    from paraview.modules.vtkRemotingViews import vtkPVView

    was_in_window = vtkPVView.GetUseGenericOpenGLRenderWindow()
    vtkPVView.SetUseGenericOpenGLRenderWindow(False)
    try:
        proxy = servermanager.ProxyManager().NewProxy("views", "RenderView")
        servermanager.ParaViewPipelineController().InitializeProxy(proxy)
    finally:
        vtkPVView.SetUseGenericOpenGLRenderWindow(was_in_window)
    window = proxy.GetRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetShowWindow(False)
    view = servermanager._getPyProxy(proxy)
    view.ViewTime = simple.GetTimeKeeper().Time  # which follows registered views alone
    return view


@contextlib.contextmanager
def _own_view(view):
    """A view that is deleted afterwards with what it shows."""
    from paraview import simple

    try:
        yield view
    finally:
        for shown in list(view.Representations):
            simple.Delete(shown)
        view.Representations = []


@contextlib.contextmanager
def nothing_else_changes():
    """The active source and view are those of before."""
    from paraview import simple

    source, view = simple.GetActiveSource(), simple.GetActiveView()
    try:
        yield
    finally:
        simple.SetActiveSource(source)
        if view is not None:
            simple.SetActiveView(view)


def _volume_view(size):
    view = _hidden_view()
    view.ViewSize = list(size)
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [0.0, 0.0, 0.0]
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    view.CameraParallelProjection = 1  # so that the scale bar is valid everywhere
    return view


def _show_bent(bent, view):
    """Shows the bent volume with its look, and aims the camera at it."""
    from paraview import simple

    shown = simple.Show(bent, view, "UniformGridRepresentation")
    shown.SetRepresentationType("Deformed Volume")
    simple.ColorBy(shown, _first_array(bent), separate=True)
    names = looks(shown)
    if names:
        look(shown, "Brain" if "Brain" in names else names[0], view)
    shown.SetScalarBarVisibility(view, False)
    return shown


def _aim_at(view, outwards):
    """Looks at the volume from this side, from the same distance."""
    import numpy

    focus = numpy.array(view.CameraFocalPoint)
    away = numpy.linalg.norm(numpy.array(view.CameraPosition) - focus)
    length = numpy.linalg.norm(outwards)
    if length > 0.0:
        direction = numpy.array(outwards) / length
        view.CameraPosition = list(focus + away * direction)
        view.CameraViewUp = [0, 1, 0] if abs(direction[2]) > 0.9 else [0, 0, 1]


def _frame(view, size):
    """Moves and zooms the camera so that what is drawn on the black ground fills `_FRAME`."""
    import numpy

    view.CameraParallelScale *= 2.0  # so that nothing is cut off
    drawn = _pixels(view, size).max(axis=2) > _DARK
    if not drawn.any():
        return
    columns, rows = (numpy.flatnonzero(drawn.any(axis=axis)) for axis in (0, 1))
    left, right, lower, upper = numpy.array(_FRAME) * (size[0], size[0], size[1], size[1])
    zoom = min((right - left) / (columns[-1] + 1 - columns[0]),
               (upper - lower) / (rows[-1] + 1 - rows[0]))
    focus, eye, up = (numpy.array(view.GetPropertyValue(name)) for name in (
        "CameraFocalPoint", "CameraPosition", "CameraViewUp"))
    along = (focus - eye) / numpy.linalg.norm(focus - eye)
    across = numpy.cross(along, up)
    across /= numpy.linalg.norm(across)
    mm = 2.0 * view.CameraParallelScale / size[1]  # of a pixel before the zoom
    middle = (columns[-1] + 1 + columns[0] - size[0]) / 2, (rows[-1] + 1 + rows[0] - size[1]) / 2
    wanted = (left + right - size[0]) / 2 / zoom, (lower + upper - size[1]) / 2 / zoom
    shift = mm * ((middle[0] - wanted[0]) * across
                  + (middle[1] - wanted[1]) * numpy.cross(across, along))
    view.CameraFocalPoint, view.CameraPosition = list(focus + shift), list(eye + shift)
    view.CameraParallelScale /= zoom


def _outwards(case):
    """The direction from the middle of the volume to what was measured, or zero."""
    import numpy

    from .points import read_from

    middle = numpy.array(_middle(case.volume))
    points = case.traced or case.electrodes
    if points is not None:
        return read_from(points).positions.mean(axis=0) - middle
    ball = case.opening_ball()
    return numpy.array(ball[0]) - middle if ball else numpy.zeros(3)


def turn_to_opening(case, view):
    """Looks at the volume from the side of the measured points or the opening, if it is known."""
    from paraview import simple

    outwards = _outwards(case)
    if outwards.any():
        _aim_at(view, outwards)
        simple.Render(view)


def _middle(source):
    bounds = source.GetDataInformation().GetBounds()
    return [(low + high) / 2 for low, high in zip(bounds[0::2], bounds[1::2])]


def before_and_after(case, size):
    """The volume in 3D as loaded and as bent, from the side of the opening: two pictures."""
    with _own_view(_volume_view(size)) as view:
        _show_bent(case.bent, view)
        _aim_at(view, _outwards(case))
        _frame(view, size)
        after = with_scale_bar(_pixels(view, size), _scale(view, size))
        if case.bent.Strength == 0:
            return after, after
        with _strength_kept(case.bent):
            case.bent.Strength = 0.0
            before = with_scale_bar(_pixels(view, size), _scale(view, size))
    return before, after


def traces(case, size):
    """The volume with the measured points, coloured by their distance to the cortex: as loaded and
    as bent. None without such points."""
    from paraview import simple

    measures = [measure for measure, _, reason in case.measures() if not reason]
    if not measures:
        return None
    with _own_view(_volume_view(size)) as view:
        _show_bent(case.bent, view)
        _aim_at(view, _outwards(case))
        for measure in measures:
            points = simple.Show(measure, view)
            points.PointSize, points.RenderPointsAsSpheres = _POINT_PIXELS, 1
            simple.ColorBy(points, ("POINTS", "DistanceToCortex"), separate=True)
            color = simple.GetColorTransferFunction("DistanceToCortex", points, separate=True)
            color.ColorSpace, color.RGBPoints = "RGB", _TRACE_COLORS
            color.RescaleTransferFunction(-_TRACE_SCALE_MM, _TRACE_SCALE_MM)
        _frame(view, size)
        bar = simple.GetScalarBar(color, view)
        bar.Title, bar.ComponentTitle = "mm above the cortex", ""
        bar.RangeLabelFormat = "{:.0f}" if "{" in bar.RangeLabelFormat else "%.0f"
        points.SetScalarBarVisibility(view, True)
        with _strength_kept(case.bent):
            after = with_scale_bar(_pixels(view, size), _scale(view, size))
            case.bent.Strength = 0.0
            return with_scale_bar(_pixels(view, size), _scale(view, size)), after


class _Slice:
    """A view of one plane of the bent volume through a position."""

    def __init__(self, case, plane, position, size):
        self.case, self.plane, self.size = case, plane, size
        self.view = _without_depth(_hidden_view())
        self.view.ViewSize = list(size)
        coloring = _first_array(case.bent)
        self.display = _show_slice(case.bent, self.view, plane, coloring)
        self.display.ShowCrosshair = 0
        _make_grey(case.bent, [self.display], coloring)
        self.display.SlicePosition = list(position)
        self.view.SMProxy.StillRender()
        normals, _ = slice_axes(self.display)
        known = world_axes(case.bent)
        sides = [[sign * part for part in normal]
                 for sign, normal in zip(WORLDS[known or "RAS"], normals)]
        _look(self.view, plane, "radiological", sides,
              case.bent.GetDataInformation().GetBounds())
        self._through(position)

    def _through(self, position):
        """Moves the camera along its direction, so that its focal point is in the slice."""
        import numpy

        focus, eye = (numpy.array(self.view.GetPropertyValue(name))
                      for name in ("CameraFocalPoint", "CameraPosition"))
        direction = (focus - eye) / numpy.linalg.norm(focus - eye)
        shift = direction * ((numpy.array(position) - focus) @ direction)
        self.view.CameraFocalPoint, self.view.CameraPosition = list(focus + shift), list(
            eye + shift)

    def zoom(self, position, half_mm):
        """Shows so much (mm) above and below a position."""
        import numpy

        focus, eye = (numpy.array(self.view.GetPropertyValue(name))
                      for name in ("CameraFocalPoint", "CameraPosition"))
        self.view.CameraFocalPoint = list(position)
        self.view.CameraPosition = list(numpy.array(position) + eye - focus)
        self.view.CameraParallelScale = half_mm

    def pixels(self):
        return with_scale_bar(_pixels(self.view, self.size), _scale(self.view, self.size))

    def positions(self):
        """Positions (mm) of the pixels: rows from below, columns, x y z."""
        import numpy

        width, height = self.size
        focus, eye, up = (numpy.array(self.view.GetPropertyValue(name)) for name in (
            "CameraFocalPoint", "CameraPosition", "CameraViewUp"))
        direction = (focus - eye) / numpy.linalg.norm(focus - eye)
        right = numpy.cross(direction, up)
        mm = 2.0 * self.view.CameraParallelScale / height
        rows = ((numpy.arange(height) + 0.5) - height / 2) * mm
        columns = ((numpy.arange(width) + 0.5) - width / 2) * mm
        return (focus + rows[:, None, None] * up + columns[None, :, None] * right)


@contextlib.contextmanager
def evidence_on(bent):
    """The bent volume carries the uncertainty of its fit; afterwards only if it did before. Yields
    whether there is one: none is known where the fit is for other settings."""
    fit = bent.Lattice
    before = fit.Evidence
    try:
        fit.Evidence = 1
        bent.UpdatePipeline()
        arrays = bent.GetDataInformation().GetFieldDataInformation()
        yield arrays.GetArrayInformation("FFDDeviations") is not None
    finally:
        fit.Evidence = before
        bent.UpdatePipeline()


def slices(case, position, size, evidence=False, strength=None):
    """Pictures of the three planes through a position (mm): a dict by the names of planes.

    `evidence`: with the uncertainty of the fit, which `evidence_on` turns on.
    """
    result = {}
    with _strength_kept(case.bent):
        if strength is not None:
            case.bent.Strength = strength
        for plane in PLANES:
            each = _Slice(case, plane, position, size)
            with _own_view(each.view):
                each.display.ShowEvidence = int(evidence)
                result[plane] = each.pixels()
    return result


def _colored(pixels, mask, color):
    import numpy

    result = pixels.astype(float)
    result[mask] = (1 - _COVER) * result[mask] + _COVER * numpy.array(color)
    return numpy.rint(result).astype(numpy.uint8)


def tumour_after(case, position, size):
    """Slices with the tumour that is left in orange and that which was removed in blue."""
    import numpy

    from .resecting import pose_of

    tumour = Labels(fetched(case.tumour), case.tumour_labels)
    cavity = Labels(fetched(case.cavity), case.cavity_labels)
    if case.comparison is not None:
        cavity = cavity.moved(pose_of(case.comparison))
    low, high = tumour.box(margin=1)
    corners = numpy.array(numpy.meshgrid(*zip(low, high))).reshape(3, -1).T.astype(float)
    corners = deformed_from_rest(case.bent, tumour.positions(corners))
    near, far = corners.min(axis=0) - 10.0, corners.max(axis=0) + 10.0
    result = {}
    for plane in PLANES:
        each = _Slice(case, plane, position, size)
        with _own_view(each.view):
            each.zoom(position, 0.8 * numpy.linalg.norm(far - near))
            places = each.positions()
            inside = ((places > near) & (places < far)).all(axis=2)
            mask = numpy.zeros(inside.shape, bool)
            removed = mask.copy()
            if inside.any():
                rest = rest_from_deformed(case.bent, places[inside])
                mask[inside] = tumour.fractions(rest) >= 0.5
                removed[inside] = cavity.fractions(places[inside]) >= 0.5
            pixels = _colored(each.pixels(), mask & ~removed, ORANGE)
            result[plane] = _colored(pixels, mask & removed, BLUE)
    return result


def focus_of(case):
    """The position (mm, deformed frame) that slices show: the middle of the tumour, else of the
    measured points, a little inside, else of the volume."""
    import numpy

    from .points import read_from

    middle = numpy.array(_middle(case.volume))
    if case.tumour is not None:
        tumour = Labels(fetched(case.tumour), case.tumour_labels)
        low, high = tumour.box()
        place = tumour.positions(((low + high) / 2.0)[None])
        return deformed_from_rest(case.bent, place)[0]
    points = case.traced or case.electrodes
    if points is not None:
        return 0.75 * read_from(points).positions.mean(axis=0) + 0.25 * middle
    return middle
