# SPDX-License-Identifier: BSD-3-Clause
"""Shows a volume at its best at once: colours, opacities and a camera that fit its tissue."""

import math

#: From the middle of the tissue to the camera at first: from the patient's right, front and above.
FIRST_DIRECTION = (0.62, 0.68, 0.40)

#: The tissue fills this part of the view's width or height.
FILLED = 0.92

#: Part of the box's corners in the size of the tissue.
BOX_SHARE = 0.25


def _array(representation):
    """Association (0 points, 1 cells) and name of the array that colours a display, if any."""
    association, name = representation.ColorArrayName[0], representation.ColorArrayName[1]
    return int(association == "CELLS"), name


def _measured(representation, name=""):
    """The report on a volume, which has made a look."""
    input_property = representation.SMProxy.GetProperty("Input")
    source = input_property.GetProxy(0)
    source.UpdatePipeline()
    report = representation.SMProxy.GetSessionProxyManager().NewProxy("misc", "VolumeLookReport")
    report.UnRegister(None)  # Python holds it
    report.PrototypeOn()  # a question is no step to undo
    association, array = _array(representation)
    report.GetProperty("Source").AddProxy(source)
    report.GetProperty("Port").SetElement(0, input_property.GetOutputPortForConnection(0))
    report.GetProperty("Association").SetElement(0, association)
    report.GetProperty("ArrayName").SetElement(0, array or "")
    report.GetProperty("Look").SetElement(0, name)
    report.UpdateVTKObjects()
    report.InvokeCommand("Measure")
    report.UpdatePropertyInformation()
    return report


def _numbers(report, name):
    answer = report.GetProperty(name)
    return [answer.GetElement(i) for i in range(answer.GetNumberOfElements())]


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

    A look is colours and opacities made from the histogram of the volume. MR has `Skin` and
    `See-through`, CT has `Bone`, `Brain`, `Skin` and `Vessels`, ultrasound has `Ultrasound` and
    `Skin`. With a segmentation attached, MR and ultrasound have `Brain`, too. A mask or a label map
    has none.

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
    colors.RGBPoints = _numbers(report, "Colors")
    colors.ScalarRangeInitialized = 1
    curve = _numbers(report, "Opacities")
    opacities.Points = [number for value, opacity in zip(curve[0::2], curve[1::2])
                        for number in (value, opacity, 0.5, 0.0)]
    opacities.ScalarRangeInitialized = 1
    representation.Shade = 1
    if "DrawSegment" in representation.ListProperties():
        representation.DrawSegment = report.GetProperty("DrawsSegment").GetElement(0)
    if view is not None:
        simple.Render(view)  # ParaView places the camera itself at its first picture
        _aim(view, _numbers(report, "TissueBounds"))
    return name or names[0]


def _dot(one, other):
    return sum(a * b for a, b in zip(one, other))


def _reach(half, along):
    """Half the size of tissue in a box along a unit direction.

    It is a little more than that of the ellipsoid in the box, for a head has a neck.
    """
    parts = [abs(h * a) for h, a in zip(half, along)]
    return BOX_SHARE * sum(parts) + (1.0 - BOX_SHARE) * math.sqrt(_dot(parts, parts))


def _aim(view, bounds):
    """Looks at a box (mm, world) from the first direction, so that tissue fills the view."""
    if bounds[0] > bounds[1]:
        return  # nothing is seen
    length = math.sqrt(_dot(FIRST_DIRECTION, FIRST_DIRECTION))
    towards = x, y, z = [part / length for part in FIRST_DIRECTION]
    level = math.hypot(x, y)
    right = [-y / level, x / level, 0.0]
    up = [-x * z / level, -y * z / level, level]
    middle = [(low + high) / 2 for low, high in zip(bounds[0::2], bounds[1::2])]
    half = [max(high - low, 1e-9) / 2 for low, high in zip(bounds[0::2], bounds[1::2])]
    wide = view.ViewSize[0] / view.ViewSize[1]
    scale = max(_reach(half, up), _reach(half, right) / wide) / FILLED
    distance = (scale / math.tan(math.radians(view.CameraViewAngle / 2))
                + BOX_SHARE * _reach(half, towards))
    view.CameraFocalPoint = view.CenterOfRotation = middle
    view.CameraPosition = [m + distance * part for m, part in zip(middle, towards)]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    view.CameraParallelScale = scale
