# SPDX-License-Identifier: BSD-3-Clause
"""Shows what a scene of 3D Slicer shows, with its colours and windows of grey values."""


def _numbers(text, count):
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError:
        return None
    return numbers if len(numbers) == count and all(abs(each) < 1e30 for each in numbers) else None


def _active_volumes(scene):
    """Identifiers of the volumes that the slices of a scene show."""
    keys = ("activeVolumeID", "backgroundVolumeID")
    found = [node.attributes.get(key) or node.reference(role)
             for node in scene.nodes if node.kind in ("Selection", "SliceComposite")
             for key, role in zip(keys, ("ActiveVolume", "backgroundVolume"))]
    return [name for name in found if name]


def _set_window(shown, display):
    """The window of grey values of a volume, where the user set it."""
    from paraview import simple

    window = _numbers(display.attributes.get("window", ""), 1)
    level = _numbers(display.attributes.get("level", ""), 1)
    if not window or not level or display.is_on("autoWindowLevel") or window[0] <= 0:
        return
    colors = simple.GetColorTransferFunction(shown.ColorArrayName[1], shown, separate=True)
    colors.RescaleTransferFunction(level[0] - window[0] / 2, level[0] + window[0] / 2)


def _paint(shown, display):
    """The colour and the opacity of a surface or of points."""
    from paraview import simple

    color = _numbers(display.attributes.get("color", ""), 3)
    opacity = _numbers(display.attributes.get("opacity", ""), 1)
    if color and not display.is_on("scalarVisibility"):
        simple.ColorBy(shown, None)
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
    active = _active_volumes(scene)
    volumes = [pair for pair in sources if pair[0].kind in ("Volume",)]
    first = next((pair for pair in volumes if pair[0].id in active), (volumes or [None])[0])
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
            shown.SetRepresentationType("Deformed Volume")
        if display:
            _set_window(shown, display) if is_image else _paint(shown, display)
    if sources:
        simple.ResetCamera(view)
        simple.Render(view)
