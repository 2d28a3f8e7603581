# SPDX-License-Identifier: BSD-3-Clause
"""Looks (presets) of a volume: colours, opacities and a camera that fit its tissue."""

from .reports import measure, numbers, report_on


def _array(representation):
    """Association (0 points, 1 cells) and name of the array that colours a display, if any."""
    association, name = representation.ColorArrayName[0], representation.ColorArrayName[1]
    return int(association == "CELLS"), name


def _measured(representation, name=""):
    """The report on a volume, which has made a look."""
    input_property = representation.SMProxy.GetProperty("Input")
    source = input_property.GetProxy(0)
    source.UpdatePipeline()
    association, array = _array(representation)
    report = report_on(
        source, input_property.GetOutputPortForConnection(0), association, array or "")
    report.GetProperty("Look").SetElement(0, name)
    measure(report)
    return report


def _names(report):
    return report.GetProperty("Names").GetElement(0).split()


def _color(representation):
    """Colours a display by its volume's first array if it has no colours yet."""
    from paraview import simple

    if _array(representation)[1]:
        return
    source = representation.Input
    for association, data in (("POINTS", source.PointData), ("CELLS", source.CellData)):
        if data.GetNumberOfArrays() > 0:
            simple.ColorBy(representation, (association, data.GetArray(0).GetName()))
            return
    raise ValueError("the volume has no array to colour by")


def looks(representation):
    """List the looks of a volume. The first one fits at first sight.

    A look (preset) has colours and opacities, made from the histogram of the volume. MR has `Skin`
    and `See-through`, CT has `Bone`, `Brain`, `Skin` and `Vessels`, ultrasound has `Ultrasound` and
    `Skin`. With a segmentation attached, MR and ultrasound have `Brain`, too. A mask, a label map
    or a volume of one constant value has none.

    - `representation`: the display of a volume, for example a Deformed Volume.

    Returns a list of names.

    Raises `ValueError` if the volume has no array.
    """
    _color(representation)
    return _names(_measured(representation))


def look(representation, name=None, view=None):
    """Show a kind of tissue: set colours, opacities and shading of a volume.

    - `representation`: the display of a volume.
    - `name`: one of `looks(representation)`. Default: the first of them.
    - `view`: aim the camera of this render view at the tissue so that it fills the view. Default:
      leave the camera.

    Returns the name of the look.

    Raises `ValueError` if the volume has no look of that name, for example because it is a label
    map.
    """
    from paraview import simple

    _color(representation)
    report = _measured(representation, name or "")
    names = _names(report)
    if not names or (name and name not in names):
        wanted = f"the look {name}" if name else "a look"
        raise ValueError(f"the volume does not have {wanted}; it has {', '.join(names) or 'none'}")
    colors, opacities = representation.LookupTable, representation.ScalarOpacityFunction
    colors.AutomaticRescaleRangeMode = "Never"  # the values mean tissue
    colors.ColorSpace = "RGB"
    colors.RGBPoints = numbers(report, "Colors")
    colors.ScalarRangeInitialized = 1
    curve = numbers(report, "Opacities")
    opacities.Points = [part for value, opacity in zip(curve[0::2], curve[1::2])
                        for part in (value, opacity, 0.5, 0.0)]
    opacities.ScalarRangeInitialized = 1
    representation.Shade = 1
    if "DrawSegment" in representation.ListProperties():
        representation.DrawSegment = report.GetProperty("DrawsSegment").GetElement(0)
    if view is not None:
        simple.Render(view)  # ParaView places the camera itself at its first picture
        _aim(view, report)
    return name or names[0]


def _aim(view, report):
    """Aims the camera at the tissue of a look, so that it fills the view."""
    report.GetProperty("ViewAspect").SetElement(0, view.ViewSize[0] / view.ViewSize[1])
    report.GetProperty("ViewAngle").SetElement(0, view.CameraViewAngle)
    report.UpdateVTKObjects()
    report.UpdatePropertyInformation()
    camera = numbers(report, "Camera")
    if not camera:
        return  # no tissue is visible
    view.CameraPosition, view.CameraViewUp = camera[:3], camera[6:9]
    view.CameraFocalPoint = view.CenterOfRotation = camera[3:6]
    view.CameraParallelScale = camera[9]
