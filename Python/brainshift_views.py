# SPDX-License-Identifier: BSD-3-Clause
"""The classical four views of a volume: axial, 3D, coronal and sagittal. Part of `brainshift`."""

import itertools

#: Numbers of the planes, as `brainshift.slice_axes` orders them.
SAGITTAL, CORONAL, AXIAL = 0, 1, 2

PLANES = {"axial": AXIAL, "coronal": CORONAL, "sagittal": SAGITTAL}

#: Where each convention looks: along which axis (and whether towards its greater coordinates), and
#: which axis points up. Radiological: the patient's right is on the left of the picture, as seen
#: from the feet and from the front; neurological: on the right, from above and from behind. Both
#: look at the sagittal plane from the left, nose to the left.
CAMERAS = {
    "radiological": {"axial": (1, CORONAL), "coronal": (-1, AXIAL), "sagittal": (1, AXIAL)},
    "neurological": {"axial": (-1, CORONAL), "coronal": (1, AXIAL), "sagittal": (1, AXIAL)},
}

#: What is one for all four views.
LINKED = ("SlicePosition", "SliceComparison", "WipePosition")

#: Space around the volume, as a share of it.
MARGIN = 1.05


def _place():
    """The view for 3D, its layout, and the cells for axial, coronal and sagittal views. The active
    view and its layout if it is a render view and alone there; else new ones."""
    from paraview import simple

    view = simple.GetActiveView()
    layout = simple.GetLayout(view) if view is not None else None
    if (layout is None or view.GetXMLName() != "RenderView"
            or len(simple.GetViewsInLayout(layout)) > 1):
        layout, view = simple.CreateLayout("Four Views"), simple.CreateView("RenderView")
        layout.AssignView(0, view)
    top = layout.SplitVertical(0, 0.5)
    left, bottom_left = (layout.SplitHorizontal(row, 0.5) for row in (top, top + 1))
    layout.SwapCells(left, left + 1)  # the view has moved to the first cell
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
    """Association and name of what the volume is coloured by if nobody chose."""
    for association, data in (("POINTS", source.PointData), ("CELLS", source.CellData)):
        if data.GetNumberOfArrays() > 0:
            return association, data.GetArray(0).GetName()
    raise ValueError("the volume has no array to colour by")


def _coloring(source, display):
    """The array that a display is coloured by, else the first one."""
    name = display.ColorArrayName
    return (name[0], name[1]) if name[1] else _first_array(source)


def _show_slice(source, view, plane, coloring):
    from paraview import simple

    display = simple.Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    simple.ColorBy(display, coloring, separate=True)
    display.SetScalarBarVisibility(view, False)
    for shown in PLANES:
        setattr(display, f"Show{shown.capitalize()}", int(shown == plane))
    display.OrientationMarks = 1
    return display


def _look(view, plane, convention, normals, bounds):
    towards, up = CAMERAS[convention][plane]
    direction = [towards * part for part in normals[PLANES[plane]]]
    middle = [(low + high) / 2 for low, high in zip(bounds[0::2], bounds[1::2])]
    size = [high - low for low, high in zip(bounds[0::2], bounds[1::2])]
    distance = 2 * sum(size)
    view.CameraFocalPoint = middle
    view.CameraPosition = [m - distance * d for m, d in zip(middle, direction)]
    view.CameraViewUp = list(normals[up])
    view.CameraParallelScale = MARGIN / 2 * max(size)  # so that all views magnify alike


def _make_grey(displays, coloring):
    """Gives slices one grey map of their own, whatever the 3D view's colours are."""
    from paraview import simple

    first, *others = displays
    grey = simple.GetColorTransferFunction(coloring[1], first, separate=True)
    grey.ApplyPreset("Grayscale", True)
    first.RescaleTransferFunctionToDataRange(False, True)
    for display in others:
        display.LookupTable = grey


def _link(displays, name):
    """Gives all displays one value of a property from now on. ParaView's links keep a closed view's
    display as a null pointer and follow it, and ParaView's window forgets the whole link with it;
    so the link is made anew without it."""
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
                if proxy is not None and proxy.GetGlobalID() == number]  # names are used again

    def make_anew(*_):
        link.RemoveAllLinks()
        proxies = remaining()
        if len(proxies) < 2:
            return
        if manager.SMProxyManager.GetRegisteredLink(link_name) != link:
            manager.RegisterLink(link_name, link)
        for proxy, direction in itertools.product(proxies, (link.INPUT, link.OUTPUT)):
            link.AddLinkedProperty(proxy, name, direction)

    for display in displays:
        display.SMProxy.AddObserver("DeleteEvent", make_anew)
    make_anew()


def four_views(source, convention="radiological"):
    """Lays out the classical four views of a volume: axial, 3D, coronal and sagittal.

    Returns them as a dict: axial, coronal, sagittal, volume. The slices are Deformed Slices in 2D
    views with one position: set `SlicePosition` (mm) of one, the others follow, as they do in
    `SliceComparison` and `WipePosition`; they share a grey colour map of their own. Letters tell
    the sides of the patient, where world axes are right, anterior, superior. `convention`:
    radiological (patient's right on the left of the picture) or neurological (on the right).

    The active view becomes the 3D view if it is a render view that is alone in its layout; else a
    new layout is made.
    """
    from paraview import simple

    if convention not in CAMERAS:
        raise ValueError(f"convention is {convention}; it must be {' or '.join(CAMERAS)}")
    source.UpdatePipeline()
    active, layout, cells = _place()
    views = {plane: _slice_view(plane) for plane in PLANES}
    for view, cell in zip(views.values(), cells):
        layout.AssignView(cell, view)
    was_shown = source in (getattr(shown, "Input", None) for shown in active.Representations)
    volume = simple.Show(source, active)
    if not was_shown:
        simple.ResetCamera(active)
    coloring = _coloring(source, volume)
    displays = {plane: _show_slice(source, views[plane], plane, coloring) for plane in PLANES}
    for plane, display in displays.items():
        view = views[plane]
        view.SMProxy.StillRender()
        import brainshift
        normals, _ = brainshift.slice_axes(display)
        _look(view, plane, convention, normals, source.GetDataInformation().GetBounds())
    _make_grey(list(displays.values()), coloring)
    for name in LINKED:
        _link([*displays.values(), volume], name)
    simple.SetActiveView(active)
    simple.RenderAllViews()
    return {**views, "volume": active}
