# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of the documentation that show volumes and slices as they are drawn."""

import json
import os
import tempfile

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import demo
import stage

DENT = -12.0  # mm

# The mask, a little smaller and without its voxels' steps, so that no membrane is left over it.
INNER_MASK = """
import numpy
inside = numpy.asarray(inputs[0].PointData[0], numpy.float32)
inside = inside.reshape(inputs[0].GetDimensions()[::-1])
for repetition in range(10):
    for axis in range(3):
        inside = (numpy.roll(inside, 1, axis) + 2 * inside + numpy.roll(inside, -1, axis)) / 4
output.PointData.append((inside.ravel() > 0.9).astype(numpy.uint8), "Label")
output.PointData.SetActiveScalars("Label")
"""


def _bent_head(amount=DENT, **properties):
    import brainshift
    stroke = brainshift.stamp(demo.SCALP_ANCHOR, stage.CENTRE, amount, 80.0, 50.0)
    return stage.bend(stage.head(), stroke, **properties)


def before_after(width):
    """A brain as loaded, and pushed in by 10 mm."""
    side = width // 2
    return stage.side_by_side([stage.brain_view(stage.bend(stage.brain(), strokes), side)
                               for strokes in ((), stage.push())])


def strength(width):
    """A head at strength 0, 0.5 and 1."""
    side = width // 3
    return stage.side_by_side([stage.head_view(_bent_head(Strength=part), side)
                               for part in (0.0, 0.5, 1.0)])


def deformed_volume(width):
    """A head, and its brain as a segment alone."""
    side = width // 2
    inner = simple.ProgrammableFilter(Input=stage.mask(), Script=INNER_MASK)
    brain = stage.bend(stage.head(), stage.push(), Segmentation=inner)
    views = [stage.head_view(_bent_head(), side), stage.view(side)]
    demo.show(brain, "Intensity", views[1])
    display = simple.GetDisplayProperties(brain, views[1])
    display.DrawSegment = 1
    _separate_maps(display, demo.CORTEX_COLORS, demo.CORTEX_OPACITIES)
    stage.look_at_brain(views[1])
    return stage.side_by_side(views)


def _separate_maps(display, colors, opacities):
    """Colour and opacity of one view's own."""
    simple.ColorBy(display, ("POINTS", "Intensity"), separate=True)
    color = simple.GetColorTransferFunction("Intensity", display, separate=True)
    color.RGBPoints = colors
    opacity = simple.GetOpacityTransferFunction("Intensity", display, separate=True)
    opacity.Points = [number for scalar, share in zip(opacities[0::2], opacities[1::2])
                      for number in (scalar, share, 0.5, 0.0)]


def looks(width):
    """One head as three looks."""
    import brainshift
    side = width // 3
    head = stage.bend(stage.head(), Segmentation=stage.mask())
    views = []
    for name in ("Skin", "Brain", "See-through"):
        views.append(stage.view(side))
        display = simple.Show(head, views[-1], "UniformGridRepresentation")
        display.SetRepresentationType("Deformed Volume")
        simple.ColorBy(display, ("POINTS", "Intensity"), separate=True)
        display.SetScalarBarVisibility(views[-1], False)
        brainshift.look(display, name, views[-1])
    return stage.side_by_side(views)


def deformed_slices(width):
    """Three planes through a bent head in 3D, and the coronal one seen from the front."""
    side = width // 2
    bent = stage.bend(stage.head(), stage.push(-15.0))
    scene = stage.view(side)
    display = stage.show_slices(bent, scene, ("Sagittal", "Coronal", "Axial"))
    simple.Render(scene)
    demo.frame(scene, (-309, 20, 470), (-330, 420, 260), 24)
    display.SlicePosition = (-335.0, 10.0, 460.0)
    display.MapSliceOpacity = 1
    flat = stage.flat_view(side, (-309.0, 30.0, 470.0), 95.0)
    stage.show_slices(bent, flat).OrientationMarks = 1
    return stage.side_by_side([scene, flat])


def mask(width):
    """A coronal slice pushed in: without a mask the skull goes along, with the mask it stays."""
    side = width // 2
    views = []
    for properties in ({}, {"Mask": stage.mask(), "Feather": 8.0, "MaskGrowth": 0.0}):
        bent = stage.bend(stage.head(), stage.push(-14.0, 80.0, 35.0), **properties)
        views.append(stage.flat_view(side, (-325.0, 30.0, 500.0), 50.0))
        stage.show_slices(bent, views[-1])
    return stage.side_by_side(views)


def bake(width):
    """Contour of Free-Form Deformation sees the volume unbent; of Bake Deformation, bent."""
    side = width // 2
    bent = stage.bend(stage.brain(), stage.push())
    views = []
    for volume in (bent, simple.BakeDeformation(Input=bent)):
        contour = stage.cortex(volume)
        made = stage.view(side)
        stage.show_surface(contour, made, (0.85, 0.72, 0.6), Specular=0.2)
        stage.look_at_brain(made)
        views.append(made)
    return stage.side_by_side(views)


def orientation(width):
    """One axial slice: radiological, the patient's right on the left; then neurological."""
    side = width // 2
    views = []
    for mirrored in (False, True):
        made = stage.flat_view(side, (-309.0, 25.0, 480.0), 118.0, "Axial")
        if mirrored:
            x, y, z = made.CameraPosition
            made.CameraPosition = (x, y, z + 800.0)
        display = stage.show_slices(stage.head(), made, ("Axial",), position=(-309, 25, 480))
        display.OrientationMarks = 1
        views.append(made)
    return stage.side_by_side(views)


def nifti(width):
    """A NIfTI volume's three planes, each seen along its axis."""
    side = width // 3
    views = []
    for plane in ("Axial", "Coronal", "Sagittal"):
        made = stage.flat_view(side, (-309.0, 25.0, 475.0), 125.0, plane)
        display = stage.show_slices(stage.head(), made, (plane,), position=(-320, 25, 475))
        display.OrientationMarks = 1
        views.append(made)
    return stage.side_by_side(views)


def dicom(width):
    """Three planes of a phantom in a multi-frame DICOM file, each seen along its axis."""
    side = width // 3
    file = os.path.join(demo.DATA, "dcm-qa-enh", "IM_0027_fMAP.dcm")
    volume = stage.once("dicom", lambda: simple.DICOMVolumeReader(FileName=file))
    views = []
    for plane in ("Axial", "Coronal", "Sagittal"):
        made = stage.flat_view(side, (1.0, -6.0, 24.0), 125.0, plane)
        display = stage.show_slices(volume, made, (plane,), position=(1, 5, 24), white=1600.0)
        display.OrientationMarks = 1
        views.append(made)
    return stage.side_by_side(views)


def _write_level(folder, values):
    """One array of zarr version 2, in one chunk."""
    os.makedirs(folder)
    with open(os.path.join(folder, ".zarray"), "w", encoding="utf-8") as file:
        json.dump({"zarr_format": 2, "shape": values.shape, "chunks": values.shape,
                   "dtype": values.dtype.str, "compressor": None, "filters": None, "order": "C",
                   "fill_value": 0}, file)
    values.tofile(os.path.join(folder, "0.0.0"))


def _pyramid_of_head(folder):
    """The head as OME-Zarr with three levels, each the average of 2 x 2 x 2 voxels of the last."""
    image = simple.FetchData(stage.head())[0]
    values = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])
    scale, shift = numpy.flip(image.GetSpacing()), numpy.flip(image.GetOrigin())
    datasets = []
    for level in range(3):
        _write_level(os.path.join(folder, str(level)), values.astype(numpy.float32))
        datasets.append({"path": str(level), "coordinateTransformations": [
            {"type": "scale", "scale": list(scale)},
            {"type": "translation", "translation": list(shift)}]})
        values = values.reshape([part for side in values.shape for part in (side // 2, 2)])
        values = values.mean(axis=(1, 3, 5))
        shift, scale = shift + scale / 2, scale * 2
    axes = [{"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"]
    with open(os.path.join(folder, ".zattrs"), "w", encoding="utf-8") as file:
        json.dump({"multiscales": [{"version": "0.4", "axes": axes, "datasets": datasets}]}, file)
    return folder


def ome_zarr(width):
    """The same slice of an OME-Zarr image at three levels."""
    side = width // 3
    views = []
    with tempfile.TemporaryDirectory() as folder:
        store = _pyramid_of_head(folder)
        for level in range(3):
            volume = simple.OMEZarrReader(FileName=store, Level=level)
            made = stage.flat_view(side, (-309.0, 25.0, 475.0), 125.0, "Sagittal")
            stage.show_slices(volume, made, ("Sagittal",), position=(-309, 25, 475))
            views.append(made)
        return stage.side_by_side(views)


VOLUME_SCENES = {
    "brain-before-after": before_after, "head-strength": strength,
    "representation-deformed-volume": deformed_volume, "looks": looks,
    "representation-deformed-slices": deformed_slices, "filter-free-form-deformation-mask": mask,
    "filter-bake-deformation": bake, "orientation": orientation,
    "filter-dicom-volume-reader": dicom, "filter-nifti-volume-reader": nifti,
    "filter-ome-zarr-reader": ome_zarr}
