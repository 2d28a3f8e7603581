# SPDX-License-Identifier: BSD-3-Clause
"""Shows what a scene of 3D Slicer shows, with its colours and windows of grey values."""

from .views import _first_array


def _numbers(text, count):
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError:
        return None
    return numbers if len(numbers) == count and all(abs(each) < 1e30 for each in numbers) else None


def _active_volumes(scene):
    """Identifiers of the volumes that a scene shows, first those of its slices."""
    keys = (("SliceComposite", "backgroundVolumeID", "backgroundVolume"),
            ("Selection", "activeVolumeID", "ActiveVolume"))
    return [node.reference(role) or node.attributes[key]
            for kind, key, role in keys for node in scene.nodes
            if node.kind == kind and (node.reference(role) or node.attributes.get(key))]


def _first_volume(scene, sources):
    """The pair of the volume that the slices of a scene show, else of the first; or None."""
    volumes = [pair for pair in sources
               if pair[0].kind == "Volume" and not pair[0].is_on("labelMap")]
    for active in _active_volumes(scene):
        for pair in volumes:
            if pair[0].id == active:
                return pair
    return (volumes or [None])[0]


def _window_of(display):
    """The two ends of the window of grey values that the user set; None without one."""
    window = _numbers(display.attributes.get("window", ""), 1)
    level = _numbers(display.attributes.get("level", ""), 1)
    if not window or not level or display.is_on("autoWindowLevel") or window[0] <= 0:
        return None
    return level[0] - window[0] / 2, level[0] + window[0] / 2


def _draw(shown, source, view, display):
    """A volume in grey values of its own, in the window of the scene."""
    from paraview import simple

    shown.SetRepresentationType("Deformed Volume")
    simple.ColorBy(shown, _first_array(source), separate=True)
    shown.SetScalarBarVisibility(view, False)
    shown.Shade = 1
    window = _window_of(display) if display else None
    if window:
        shown.LookupTable.RescaleTransferFunction(*window)
        shown.LookupTable.AutomaticRescaleRangeMode = "Never"
        shown.ScalarOpacityFunction.RescaleTransferFunction(*window)


def _paint(shown, view, node, display):
    """The colour and the opacity of a surface or of points."""
    # Slicer draws control points that are selected, as new ones are, in a colour of their own.
    key = "selectedColor" if node.kind.startswith("Markups") else "color"
    color = _numbers(display.attributes.get(key) or display.attributes.get("color", ""), 3)
    opacity = _numbers(display.attributes.get("opacity", ""), 1)
    if color and not display.is_on("scalarVisibility"):
        if shown.LookupTable:
            shown.SetScalarBarVisibility(view, False)
        shown.ColorArrayName = [None, ""]
        shown.AmbientColor = shown.DiffuseColor = [min(max(each, 0.0), 1.0) for each in color]
    if opacity:
        shown.Opacity = min(max(opacity[0], 0.0), 1.0)


def show_all(scene, sources):
    """Shows in the active view, if there is one: the volume of the slices, else the first; all
    points and surfaces that the scene shows. `sources`: pairs of node and source."""
    from paraview import simple

    view = simple.GetActiveView()
    if view is None or view.SMProxy.GetXMLName() != "RenderView":
        return
    first = _first_volume(scene, sources)
    for node, source in sources:
        display = scene.by_id.get(node.reference("display"))
        is_image = source.GetDataInformation().DataSetTypeIsA("vtkImageData")
        if is_image and (first is None or source is not first[1]):
            continue
        if not is_image and display and display.attributes.get("visibility") in ("false", "0"):
            continue
        kind = ("UniformGridRepresentation",) if is_image else ()
        shown = simple.Show(source, view, *kind)
        if is_image:
            _draw(shown, source, view, display)
        elif display:
            _paint(shown, view, node, display)
    if sources:
        simple.ResetCamera(view)
        simple.Render(view)
