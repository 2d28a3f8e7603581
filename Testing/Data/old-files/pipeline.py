# SPDX-License-Identifier: BSD-3-Clause
# A script for version 0.1: every setting of a lattice, a refinement, a fit on it and strokes.
# OldFiles.py runs it with the present version; it must not follow new names.
from paraview import simple


def make_pipeline():
    volume = simple.Wavelet(registrationName="Volume")
    tissue = simple.Calculator(registrationName="Tissue", Input=volume, ResultArrayName="Label",
                               Function="if(RTData > 80, 1, 0)")
    found = []  # as a refinement would leave it
    for k in range(7):
        for j in range(6):
            for i in range(5):
                found += [0.25 * (i % 3) - 0.25, 0.125 * (j % 2), 0.0625 * k]
    refined = simple.RefinedLattice(registrationName="Refined", Input=volume,
                                    LatticeDimensions=[5, 6, 7], ControlPoints=found)
    fit = simple.FitDeformation(
        registrationName="Fit", Input=volume, LatticeDimensions=[5, 6, 7], Kernel="B-Spline",
        Samples=3, Mask=tissue, MaskLabels=[1], MaskGrowth=1.5, Feather=3.0, Base=refined,
        Evidence=1, Pulls=[0, 0, 4, 1, 0, 5, 1, 4, 0, 0, 4, 2, 0, 1], Pins=[-6, 0, 0, 1])
    return simple.FreeFormDeformation(
        registrationName="Bent", Input=volume, LatticeDimensions=[5, 6, 7], Kernel="B-Spline",
        Samples=3, Mask=tissue, MaskLabels=[1], MaskGrowth=1.5, Feather=3.0, Lattice=fit,
        Strength=0.875, PointOfInterest=[1.5, -2.25, 3.0],
        Strokes=[1, 0, -4, 2, 1, 1, 0.25, 0, 0, 0, 7, 7, 0.25, 1,
                 2, 2, 1, 2, 0, 0, 1.5, 0, 0, 1, 12, 9, 0.25, 1])


def make_view(bent):
    view = simple.CreateView("RenderView")
    view.ViewSize = [200, 200]
    view.UseColorPaletteForBackground = 0
    view.Background = [0.0, 0.0, 0.0]
    view.OrientationAxesVisibility = 0
    view.CameraPosition = [-18.0, 24.0, 60.0]
    view.CameraFocalPoint = [0.0, 0.0, 0.0]
    view.CameraViewUp = [0.0, 1.0, 0.0]
    display = simple.Show(bent, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "RTData"))
    display.SetScalarBarVisibility(view, False)
    simple.GetColorTransferFunction("RTData").RGBPoints = [40, 0, 0, 0.25, 150, 1, 0.5, 0.25,
                                                            280, 1, 1, 1]
    simple.GetOpacityTransferFunction("RTData").Points = [40, 0, 0.5, 0, 120, 0, 0.5, 0,
                                                           280, 0.75, 0.5, 0]
    display.Shade = 1
    display.ShowEvidence = 1
    return view
