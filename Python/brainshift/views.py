# SPDX-License-Identifier: BSD-3-Clause
"""Lays out the classical four views of a volume: axial, 3D, coronal and sagittal."""

import itertools

from .answers import slice_axes

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
LINKED = ("SlicePosition", "SliceComparison", "WipePosition", "WorldAxes")

#: Size of a view as a multiple of the volume's size, so that some space stays around it.
MARGIN = 1.05


def _place():
    """The 3D view, its layout, and the cells for the axial, the coronal and the sagittal view.

    It takes the active view if that is a render view that is alone in its layout. Otherwise it
    makes a view in a new layout.
    """
    from paraview import simple

    view = simple.GetActiveView()
    layout = simple.GetLayout(view) if view is not None else None
    if (layout is None or view.GetXMLName() != "RenderView"
            or len(simple.GetViewsInLayout(layout)) > 1):
        layout, view = simple.CreateLayout("Four Views"), simple.CreateView("RenderView")
        layout.AssignView(0, view)
    top = layout.SplitVertical(0, 0.5)
    left, bottom_left = (layout.SplitHorizontal(row, 0.5) for row in (top, top + 1))
    layout.SwapCells(left, left + 1)  # splitting left the 3D view in the axial view's cell
    return view, layout, (left, bottom_left, bottom_left + 1)


def _slice_view(plane):
    from paraview import simple

    view = simple.CreateView("RenderView")
    simple.RenameView(plane.capitalize(), view)
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


def _show_volume(source, view):
    """Shows the volume in the 3D view and returns its display.

    A volume that the view showed before keeps its representation. Any other becomes a Deformed
    Volume. A Deformed Volume that has no colours gets those of its first array, and shading.
    """
    from paraview import simple

    was_shown = source in [getattr(display, "Input", None) for display in view.Representations]
    display = simple.Show(source, view)
    if not was_shown:
        simple.ResetCamera(view)
        display.SetRepresentationType("Deformed Volume")
    if display.Representation == "Deformed Volume" and not display.ColorArrayName[1]:
        simple.ColorBy(display, _first_array(source))
        display.SetScalarBarVisibility(view, False)
        display.Shade = 1
    return display


def _show_slice(source, view, plane, coloring):
    from paraview import simple

    display = simple.Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    simple.ColorBy(display, coloring, separate=True)
    display.SetScalarBarVisibility(view, False)
    for other in PLANES:
        setattr(display, f"Show{other.capitalize()}", int(other == plane))
    display.OrientationMarks = 1
    return display


def _world_axes(source):
    """The world axes that the reader of the data has attached, or None."""
    attached = source.GetDataInformation().GetFieldDataInformation().GetArrayInformation(
        "WorldAxes")
    if attached is None or attached.GetNumberOfStringValues() == 0:
        return None
    name = attached.GetStringValue(0)
    return name if name in WORLDS else None


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


def _make_grey(displays, coloring):
    """Gives the slices one grey colour map, which the 3D view does not share."""
    from paraview import simple

    first, *others = displays
    grey = simple.GetColorTransferFunction(coloring[1], first, separate=True)
    grey.ApplyPreset("Grayscale", True)
    first.RescaleTransferFunctionToDataRange(False, True)
    for display in others:
        display.LookupTable = grey


def _link(displays, name):
    """Keeps a property equal in all displays from now on, also after a view is closed.

    When a view is closed, ParaView's link keeps its display as a null pointer and follows it, and
    ParaView's window forgets the whole link. So the link is then made again without that display.
    """
    from paraview import servermanager

    manager = servermanager.ProxyManager()
    link = servermanager.vtkSMPropertyLink()
    link_name = f"{name}{displays[0].SMProxy.GetGlobalIDAsString()}"
    linked = {manager.GetProxyName("representations", display.SMProxy):
              display.SMProxy.GetGlobalID() for display in displays}

    def remaining():
        found = ((manager.SMProxyManager.GetProxy("representations", registered), number)
                 for registered, number in linked.items())
        return [proxy for proxy, number in found
                if proxy is not None and proxy.GetGlobalID() == number]  # a name may be reused

    def relink(*_):
        link.RemoveAllLinks()
        proxies = remaining()
        if len(proxies) < 2:
            return
        if manager.SMProxyManager.GetRegisteredLink(link_name) != link:
            manager.RegisterLink(link_name, link)
        for proxy, direction in itertools.product(proxies, (link.INPUT, link.OUTPUT)):
            link.AddLinkedProperty(proxy, name, direction)

    for display in displays:
        display.SMProxy.AddObserver("DeleteEvent", relink)
    relink()


def four_views(source, convention="radiological", world=None):
    """Lay out the classical four views of a volume: axial, 3D, coronal and sagittal.

    The three slice views are 2D views of Deformed Slices. They share a grey colour map and one
    slice position: set `SlicePosition` (mm) of one display, and the others follow. They also share
    `SliceComparison`, `WipePosition` and `WorldAxes`. Letters mark the sides of the patient where
    the world axes are known. Elsewhere x, y and z mark the edges, and the views lie as for RAS.

    The 3D view shows Deformed Volume, unless it shows the volume in another way already. The active
    view becomes the 3D view if it is a render view that is alone in its layout.
    Otherwise a new layout is made.

    - `source`: a ParaView source of image data, for example a Free-Form Deformation.
    - `convention`: `"radiological"`, the default, shows the patient's right on the left of the
      picture. `"neurological"` shows it on the right.
    - `world`: what x, y and z mean for the patient, `"RAS"` or `"LPS"`. Default: what the reader of
      the file has attached to the data, if anything.

    Returns a dict of views with the keys `axial`, `coronal`, `sagittal` and `volume`.

    Raises `ValueError` if `convention` or `world` is none of these or the volume has no array.
    """
    from paraview import simple

    if convention not in CAMERAS:
        raise ValueError(f"convention is {convention}; it must be {' or '.join(CAMERAS)}")
    if world is not None and world not in WORLDS:
        raise ValueError(f"world is {world}; it must be {' or '.join(WORLDS)}")
    source.UpdatePipeline()
    signs = WORLDS[world or _world_axes(source) or "RAS"]
    active, layout, cells = _place()
    views = {plane: _slice_view(plane) for plane in PLANES}
    for view, cell in zip(views.values(), cells):
        layout.AssignView(cell, view)
    volume = _show_volume(source, active)
    coloring = _coloring(source, volume)
    displays = {plane: _show_slice(source, views[plane], plane, coloring) for plane in PLANES}
    for plane, display in displays.items():
        view = views[plane]
        display.WorldAxes = world or "From the data"
        view.SMProxy.StillRender()  # the axes are known after that
        normals, _ = slice_axes(display)
        sides = [[sign * part for part in normal] for sign, normal in zip(signs, normals)]
        _look(view, plane, convention, sides, source.GetDataInformation().GetBounds())
    _make_grey(list(displays.values()), coloring)
    for name in LINKED:
        _link([*displays.values(), volume], name)
    simple.SetActiveView(active)
    simple.RenderAllViews()
    return {**views, "volume": active}
