# SPDX-License-Identifier: BSD-3-Clause
"""Copies the colours, opacity and slices of one display to another."""

#: What makes the look, beside the type of the representation.
LOOK = (
    "ColorArrayName", "UseSeparateColorMap", "LookupTable",
    "ScalarOpacityFunction", "Opacity", "Shade", "Ambient", "Diffuse", "Specular", "SpecularPower",
    "ScalarOpacityUnitDistance", "GradientOpacity", "TransferFunction2D", "UseTransfer2D",
    "DrawSegment", "DrawnLabels", "ShowEvidence", "SampleDistance",
    "VolumeNormalTexture", "Translation", "Orientation", "Scale",
    "ShowSagittal", "ShowCoronal", "ShowAxial", "SlicePosition", "ShowCrosshair",
    "SliceInterpolation", "MapSliceOpacity", "OrientationMarks", "WorldAxes", "SliceComparison",
    "ComparisonColors", "WipePosition")


def display_of(source, view):
    """The display of a source that a view has already, shown or hidden, or None."""
    return next((display for display in view.Representations
                 if getattr(display, "Input", None) == source), None)


def carry_look(former, display):
    """Gives a display the colours, opacity, segments and slices of another one."""
    display.SetRepresentationType(str(former.Representation.GetData()))
    for name in LOOK:
        own, other = (shown.SMProxy.GetProperty(name) for shown in (display, former))
        if own is not None and other is not None:
            own.Copy(other)
    display.SMProxy.UpdateVTKObjects()
