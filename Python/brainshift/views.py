# SPDX-License-Identifier: BSD-3-Clause
"""Lays out the classical four views of a volume: axial, 3D, coronal and sagittal."""

from .answers import slice_axes
from .links import link
from .carried import carry_look, display_of
from .windows import percentile_window

#: Numbers of the planes, in the order of `slice_axes`.
SAGITTAL, CORONAL, AXIAL = 0, 1, 2

PLANES = {"axial": AXIAL, "coronal": CORONAL, "sagittal": SAGITTAL}

#: How each convention looks at each plane. The first number is 1 if the camera looks towards
#: greater coordinates across the plane, and -1 if it looks towards smaller ones. The second number
#: is the axis that points up. In radiological pictures the patient's right is on the left: they are
#: seen from the feet and from the front. In neurological pictures it is on the right: they are seen
#: from above and from behind. Both look at the sagittal plane from the left, with the nose on the
#: left.
CAMERAS = {
    "radiological": {"axial": (1, CORONAL), "coronal": (-1, AXIAL), "sagittal": (1, AXIAL)},
    "neurological": {"axial": (-1, CORONAL), "coronal": (1, AXIAL), "sagittal": (1, AXIAL)},
}

#: Where the right, anterior and superior sides of the patient lie along x, y and z: 1 towards
#: greater coordinates, -1 towards smaller ones.
WORLDS = {"RAS": (1, 1, 1), "LPS": (-1, -1, 1)}

#: Properties that have one value for all four views.
LINKED = ("SlicePosition", "SliceComparison", "ComparisonColors", "WipePosition", "WorldAxes")

#: Size of a view as a multiple of the volume's size, so that some space stays around it.
MARGIN = 1.05


def _plane_of(view):
    """The plane of a flat view that shows one slice of Deformed Slices, or None."""
    if view.GetXMLName() != "RenderView" or view.InteractionMode != "2D":
        return None
    for display in view.Representations:
        if getattr(display, "Representation", None) == "Deformed Slices":
            shown = [plane for plane in PLANES if getattr(display, f"Show{plane.capitalize()}")]
            if len(shown) == 1:
                return shown[0]
    return None


def _is_free(view, layout):
    """Whether four views can be laid out around a view: it is alone in its layout."""
    from paraview import simple

    return (layout is not None and view.GetXMLName() == "RenderView"
            and len(simple.GetViewsInLayout(layout)) == 1)


def views_laid_out():
    """The four views that were laid out before, as `four_views` returns them, or None.

    The layout of the active view comes first. If that is a render view alone in its layout, the
    user wants four views there: others are not looked at. Otherwise all other layouts follow.
    """
    from paraview import simple

    active = simple.GetActiveView()
    own = simple.GetLayout(active) if active is not None else None
    if own is not None and _is_free(active, own):
        return None
    layouts = [own] if own is not None else []
    for layout in layouts + list(simple.GetLayouts().values()):
        views = simple.GetViewsInLayout(layout) if layout is not None else []
        found = {_plane_of(view) or "volume": view for view in views}
        if (len(views) == 4 and set(found) == {*PLANES, "volume"}
                and found["volume"].GetXMLName() == "RenderView"):
            return {name: found[name] for name in (*PLANES, "volume")}
    return None


def _place():
    """The 3D view, its layout, and the cells for the axial, the coronal and the sagittal view.

    It takes the active view if that is a render view that is alone in its layout. Otherwise it
    makes a view in a new layout.
    """
    from paraview import simple

    view = simple.GetActiveView()
    layout = simple.GetLayout(view) if view is not None else None
    if not _is_free(view, layout):
        layout, view = simple.CreateLayout("Four Views"), simple.CreateView("RenderView")
        layout.AssignView(0, view)
    elif layout.GetViewLocation(view.SMProxy) != 0:  # beside empty cells
        layout.Reset()
        layout.AssignView(0, view)
    top = layout.SplitVertical(0, 0.5)
    left, bottom_left = (layout.SplitHorizontal(row, 0.5) for row in (top, top + 1))
    layout.SwapCells(left, left + 1)  # splitting left the 3D view in the axial view's cell
    return view, layout, (left, bottom_left, bottom_left + 1)


def _render(views):
    """Draws views. simple.Render would reset the camera of the first one that it draws."""
    for view in views:
        view.SMProxy.StillRender()


def begin_in_layout(number):
    """Makes the 3D view of a layout that has no view, and makes it active. Else nothing.

    - `number`: global number of the layout's proxy.
    """
    from paraview import simple

    for layout in simple.GetLayouts().values():
        if layout.GetGlobalID() == number and not simple.GetViewsInLayout(layout):
            layout.Reset()
            view = simple.CreateView("RenderView")
            layout.AssignView(0, view)
            simple.SetActiveView(view)


def _slice_view(plane):
    from paraview import simple

    view = simple.CreateView("RenderView")
    simple.RenameView(plane.capitalize(), view)
    return _without_depth(view)


def _without_depth(view):
    """A view as one of slices."""
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [0.0, 0.0, 0.0]
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    return view


def _first_array(source):
    """Association and name of the first array of the volume."""
    for association, data in (("POINTS", source.PointData), ("CELLS", source.CellData)):
        if data.GetNumberOfArrays() > 0:
            return association, data.GetArray(0).GetName()
    raise ValueError("the volume has no array to colour by")


def _coloring(source, display):
    """Association and name of the array that a display is coloured by, or of the first array."""
    association, name = display.ColorArrayName[0], display.ColorArrayName[1]
    return (association, name) if name else _first_array(source)


def _leave_slice(source, view):
    """Makes the 3D view of a view of one slice, which was left of four."""
    from paraview import simple

    for display in view.Representations:
        if getattr(display, "Representation", None) == "Deformed Slices":
            display.Visibility = int(getattr(display, "Input", None) == source)
    view.InteractionMode = "3D"
    view.CameraParallelProjection = 0
    view.UseColorPaletteForBackground = 1
    view.OrientationAxesVisibility = 1
    display = display_of(source, view)
    display.UseSeparateColorMap = 0
    simple.ColorBy(display, _coloring(source, display))


def _show_volume(source, view, former):
    """Shows the volume in the 3D view and returns its display.

    A volume that the view showed before keeps its representation. A comparison of the volume
    `former` that the view showed looks like that one. Any other becomes a Deformed Volume, and so
    does the slice of a view that was left of four. A
    Deformed Volume that has no colours gets those of its first array, and shading.
    """
    from paraview import simple

    was_slice = _plane_of(view) is not None
    was_shown = display_of(source, view) is not None and not was_slice
    display = simple.Show(source, view)
    if was_slice:
        _leave_slice(source, view)
    shown_before = display_of(former, view) if _is_made_of(source, former) else None
    if not was_shown and shown_before is not None:
        carry_look(shown_before, display)
    elif not was_shown:
        simple.ResetCamera(view)
        display.SetRepresentationType("Deformed Volume")
    if display.Representation == "Deformed Volume" and not display.ColorArrayName[1]:
        simple.ColorBy(display, _first_array(source))
        display.SetScalarBarVisibility(view, False)
        display.Shade = 1
    return display


def _is_made_of(source, former):
    """Whether a source is a filter of another one."""
    return former is not None and getattr(source, "Input", None) == former


def _show_slice(source, view, plane, coloring):
    from paraview import simple

    display = simple.Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    simple.ColorBy(display, coloring, separate=True)
    display.SetScalarBarVisibility(view, False)
    for other in PLANES:
        setattr(display, f"Show{other.capitalize()}", int(other == plane))
    display.OrientationMarks = 1
    display.ShowCrosshair = 1
    return display


def _show_slices(source, views, coloring, former):
    """Shows one slice in each view and returns the displays.

    A comparison of the volume `former` that the views showed looks like that one, and so the views
    keep their grey values and their position.
    """
    from paraview import simple

    carried = _is_made_of(source, former)
    displays = {}
    for plane in PLANES:
        shown_before = display_of(former, views[plane]) if carried else None
        if shown_before is None:
            displays[plane] = _show_slice(source, views[plane], plane, coloring)
            carried = False
        else:
            displays[plane] = simple.Show(source, views[plane], "UniformGridRepresentation")
            carry_look(shown_before, displays[plane])
            displays[plane].SetScalarBarVisibility(views[plane], False)
    if not carried:
        _make_grey(source, list(displays.values()), coloring)
    return displays


def _slices_shown(views, source):
    """The source whose slices the views show, another one than `source` if possible, or None."""
    shown = [display.Input for plane in PLANES for display in views[plane].Representations
             if getattr(display, "Representation", None) == "Deformed Slices"
             and display.Visibility]
    return next((other for other in shown if other != source), shown[0] if shown else None)


def world_axes(source):
    """The world axes that the reader of the data has attached, or None."""
    attached = source.GetDataInformation().GetFieldDataInformation().GetArrayInformation(
        "WorldAxes")
    if attached is None or attached.GetNumberOfStringValues() == 0:
        return None
    name = attached.GetStringValue(0)
    return name if name in WORLDS else None


def warn_of_axes(volume, noun, axes, of="the volume"):
    """Warns if something lies along other world axes than a volume, or the volume's are unknown."""
    import warnings

    own = world_axes(volume)
    if axes and own != axes:
        warnings.warn(f"The world axes of {of} are {own or 'unknown'}, those of {noun} are {axes}: "
                      "left and right may be exchanged between them. Check it in a picture",
                      stacklevel=3)


def _look(view, plane, convention, sides, bounds):
    """`sides`: directions (world) of the patient's right, anterior and superior."""
    towards, up = CAMERAS[convention][plane]
    direction = [towards * part for part in sides[PLANES[plane]]]
    middle = [(low + high) / 2 for low, high in zip(bounds[0::2], bounds[1::2])]
    size = [high - low for low, high in zip(bounds[0::2], bounds[1::2])]
    distance = 2 * sum(size)
    view.CameraFocalPoint = middle
    view.CameraPosition = [m - distance * d for m, d in zip(middle, direction)]
    view.CameraViewUp = list(sides[up])
    view.CameraParallelScale = MARGIN / 2 * max(size)  # one magnification for all views


def _looks_so(view, plane, convention, sides):
    """Whether a view looks along its direction already, at any position and zoom."""
    towards, up = CAMERAS[convention][plane]
    ahead = [f - p for f, p in zip(view.CameraFocalPoint, view.CameraPosition)]
    length = sum(part * part for part in ahead) ** 0.5

    def follows(direction, wanted):
        return sum(d * w for d, w in zip(direction, wanted)) > 0.999

    return (length > 0
            and follows([part / length for part in ahead],
                        [towards * part for part in sides[PLANES[plane]]])
            and follows(view.CameraViewUp, sides[up]))


def _look_at_slices(views, displays, convention, world, keeps):
    """Aims the slice views by the convention. `keeps`: views that are aimed so keep their zoom."""
    for plane, display in displays.items():
        view, source = views[plane], display.Input
        if world or not keeps:
            display.WorldAxes = world or "From the data"
        view.SMProxy.StillRender()  # the axes are known after that
        chosen = str(display.WorldAxes.GetData())
        known = chosen if chosen in WORLDS else world_axes(source)
        normals, _ = slice_axes(display)
        sides = [[sign * part for part in normal]
                 for sign, normal in zip(WORLDS[known or "RAS"], normals)]
        if not (keeps and _looks_so(view, plane, convention, sides)):
            _look(view, plane, convention, sides, source.GetDataInformation().GetBounds())


def _make_grey(source, displays, coloring):
    """Gives the slices one grey colour map, which the 3D view does not share.

    It spans the grey values of the tissue, and ParaView does not change it afterwards.
    """
    from paraview import simple

    first, *others = displays
    grey = simple.GetColorTransferFunction(coloring[1], first, separate=True)
    grey.ApplyPreset("Grayscale", True)
    grey.SMProxy.SetAnnotation("BrainShift.SliceGreys", "1")  # the window does not show them in 3D
    first.RescaleTransferFunctionToDataRange(False, True)
    window = percentile_window(source, *coloring)
    if window is not None:
        grey.RescaleTransferFunction(*window)
        grey.AutomaticRescaleRangeMode = "Never"
    for display in others:
        display.LookupTable = grey


def _new_views():
    """Lays out four views. All are empty except the active view, which becomes the 3D view."""
    active, layout, cells = _place()
    views = {plane: _slice_view(plane) for plane in PLANES}
    for view, cell in zip(views.values(), cells):
        layout.AssignView(cell, view)
    link(list(views.values()), "views", "CameraParallelScale")
    return {**views, "volume": active}


def _hide(source, views):
    from paraview import simple

    for view in views.values():
        if display_of(source, view) is not None:
            simple.Hide(source, view)


def four_views(source, convention="radiological", world=None):
    """Lay out the classical four views of a volume: axial, 3D, coronal and sagittal.

    The three slice views are 2D views of Deformed Slices. They share a grey colour map and one
    slice position: set `SlicePosition` (mm) of one display, and the others follow. They also share
    `SliceComparison`, `ComparisonColors`, `WipePosition` and `WorldAxes`. Letters mark the sides of
    the patient where the world axes are known. Otherwise x, y and z mark the edges, and the views
    are oriented as for RAS.

    The grey values reach from the 1st to the 99th percentile of the tissue: see
    `percentile_window`. Lines in each slice show the other two slices (`ShowCrosshair`). The
    slices have one zoom (`CameraParallelScale`).

    The 3D view shows Deformed Volume, unless it shows the volume in another way already. If the
    active view shows the volume with its evidence or, for Compare Volumes, with a comparison, then
    all four views do.

    The active view becomes the 3D view if it is a render view that is alone in its layout.
    Otherwise four views that were laid out before are used again: they keep their zoom if the new
    volume fills the same box. Otherwise a new layout is made.

    - `source`: a ParaView source of image data, for example a Free-Form Deformation.
    - `convention`: `"radiological"`, the default, shows the patient's right on the left of the
      picture. `"neurological"` shows it on the right.
    - `world`: the world axes, `"RAS"` or `"LPS"`. Default: those that the reader of the file has
      attached to the data, if any.

    Returns a dict of views with the keys `axial`, `coronal`, `sagittal` and `volume`.

    Raises `ValueError` if `convention` or `world` is another word or the volume has no array.
    """
    from paraview import simple

    if convention not in CAMERAS:
        raise ValueError(f"convention is {convention}; it must be {' or '.join(CAMERAS)}")
    if world is not None and world not in WORLDS:
        raise ValueError(f"world is {world}; it must be {' or '.join(WORLDS)}")
    source.UpdatePipeline()
    shown = _display_in_active_view(source)
    laid_out = views_laid_out()
    views = laid_out or _new_views()
    former = _slices_shown(views, source) if laid_out else None
    displays = _show_again(source, views, former) or _show_both(source, views, former, shown)
    keeps = former is not None and _bounds(former) == _bounds(source)
    _look_at_slices(views, displays, convention, world, keeps)
    if former is not None and not keeps:
        simple.ResetCamera(views["volume"])
    simple.SetActiveView(views["volume"])
    _render(simple.GetRenderViews())
    return views


def _bounds(source):
    return source.GetDataInformation().GetBounds()


def _show_again(source, views, former):
    """Shows a source that all four views have shown before, at the same position; else None."""
    from paraview import simple

    displays = {name: display_of(source, view) for name, view in views.items()}
    if former is None or None in displays.values():
        return None
    for view in views.values():
        simple.Show(source, view)
    if former != source:
        displays["axial"].SlicePosition = display_of(former, views["axial"]).SlicePosition
        _hide(former, views)
    return {plane: displays[plane] for plane in PLANES}


def _show_both(source, views, former, shown):
    """Shows the slices and the volume, in place of another volume if there is one. `shown`: the
    display of the source in the view that was active, or None."""
    volume = _show_volume(source, views["volume"], former)
    displays = _show_slices(source, views, _coloring(source, volume), former)
    if former is not None:
        _hide(former, views)
    if shown is not None:
        _take_over(shown, [*displays.values(), volume])
    for name in LINKED:  # all take the value of the first one
        link([*displays.values(), volume], "representations", name)
    if source.GetXMLName() == "CompareVolumes":
        _stand_by(source, views)
    return displays


def _stand_by(comparison, views):
    """Gives the volume of a comparison hidden displays where it has none: ParaView shows them once
    the comparison is deleted. They are at the position of the comparison."""
    from paraview import simple

    volume = comparison.Input
    missing = [view for view in views.values() if display_of(volume, view) is None]
    for view in missing:
        display = simple.Show(volume, view, "UniformGridRepresentation")
        carry_look(display_of(comparison, view), display)
        display.SliceComparison = "None"
        display.SetScalarBarVisibility(view, False)
        display.Visibility = 0
    own, hidden = ([display_of(each, view) for view in views.values()]
                   for each in (comparison, volume))
    for name in LINKED if missing else ():
        link(hidden, "representations", name)
    for name in ("SlicePosition", "WorldAxes"):
        link([*own, *hidden], "representations", name)


def _take_over(shown, displays):
    """Shows the comparison and the evidence that a display shows of the same source."""
    way, evidence = _comparison_of(shown), int(shown.ShowEvidence)
    for display in displays:
        if evidence:
            display.ShowEvidence = 1
        if way != "None":
            for name in ("ComparisonColors", "WipePosition"):
                display.SMProxy.GetProperty(name).Copy(shown.SMProxy.GetProperty(name))
            display.SliceComparison = way


def _comparison_of(display):
    """How slices show the comparison that a display shows."""
    kind = str(display.Representation.GetData())
    if display.Input.GetXMLName() != "CompareVolumes":
        return "None"
    if kind == "Deformed Volume":
        return "None" if display.VolumeComparison == "Off" else "Two colours"
    return str(display.SliceComparison.GetData()) if kind == "Deformed Slices" else "None"


def _display_in_active_view(source):
    """The display of a source that the active view shows, or None."""
    from paraview import simple

    view = simple.GetActiveView()
    if view is None or view.GetXMLName() != "RenderView":
        return None
    display = display_of(source, view)
    return display if display is not None and display.Visibility else None


def _view_of_comparison(comparison, view):
    """Shows a comparison in a view as the view shows its volume, if it does."""
    former = display_of(comparison.Input, view)
    display = display_of(comparison, view)
    if former is not None and display is not None:
        carry_look(former, display)


def show_comparison(comparison):
    """Show a comparison where its volume is shown, with the same look.

    In the active view the comparison gets the representation, the colours, the opacity and the
    segments of the volume that it compares. If the active view is one of the four views, slices
    and 3D show the comparison together, in two colours unless another mode was chosen.

    - `comparison`: a Compare Volumes filter that the active view shows.
    """
    from paraview import simple

    active = simple.GetActiveView()
    if active is None:
        return
    _view_of_comparison(comparison, active)
    views = views_laid_out()
    if views is None or active not in views.values():
        return
    if display_of(comparison.Input, views["axial"]) is None:
        return
    four_views(comparison)
    for plane in PLANES:
        display = display_of(comparison, views[plane])
        if display.SliceComparison == "None":
            display.SliceComparison = "Two colours"  # the others follow
    simple.SetActiveView(active)
    _render(simple.GetRenderViews())
