# SPDX-License-Identifier: BSD-3-Clause
"""Helpers to deform a medical volume with BrainShift from Python.

    import brainshift
    ffd.Strokes = brainshift.stamp(anchor, toward, 10.0) + brainshift.move(point, (0, 0, 2))

`move`, `soft` and `stamp` make strokes. A stroke is a tuple of 14 numbers. The property `Strokes`
of a Free-Form Deformation holds strokes one after another, so add tuples to get several.

All positions and distances are in millimetres, in world axes. The *rest frame* is the volume as it
was loaded. The *deformed frame* is the volume as it is drawn.

Research software, not a medical device.
"""

from .answers import counters, draw_detail, gpu, pick, slice_axes
from .batching import Done, batch
from .cases import Case
from .directions import MapDirection, direction
from .figures import animate, figure
from .files import (
    dicom_patient, load_field, load_lattice, save_dicom, save_field, save_lattice,
    save_segmentation, save_volume)
from .fitting import Fit, fit
from .grids import ElectrodeGrid, Electrodes, electrodes
from .judging import TargetErrors, tre
from .looks import look, looks
from .maps import deformed_from_rest, rest_from_deformed
from .openscene import OpenedScene, open_scene
from .points import map_points, read_points
from .pyramids import draw_from_pyramid, pyramid
from .registering import (
    Alignment, Refinement, RegistrationFailed, align, refine, similarities)
from .reporting import report
from .resecting import Resection, resect
from .sample import open_sample
from .savescene import save_scene
from .steps import Step
from .strokes import MOVE, NUMBERS_PER_STROKE, SOFT, STAMP, move, soft, stamp
from .transforms import Transform, apply_transform, read_transform, save_transform
from .views import four_views, show_comparison
from .windows import percentile_window

__all__ = [
    "Alignment", "Case", "Done", "ElectrodeGrid", "Electrodes", "Fit", "MOVE", "MapDirection",
    "NUMBERS_PER_STROKE", "OpenedScene", "Refinement", "RegistrationFailed", "Resection",
    "SOFT", "STAMP", "Step", "TargetErrors", "Transform", "align", "animate",
    "apply_transform", "batch", "counters", "deformed_from_rest", "dicom_patient", "direction",
    "draw_detail", "draw_from_pyramid", "electrodes", "figure", "fit", "four_views", "gpu",
    "load_field", "load_lattice", "look", "looks", "map_points", "move", "open_sample",
    "open_scene", "percentile_window", "pick", "pyramid", "read_points", "read_transform",
    "refine", "report", "resect", "rest_from_deformed", "save_dicom", "save_field",
    "save_lattice", "save_scene", "save_segmentation", "save_transform", "save_volume",
    "show_comparison", "similarities", "slice_axes", "soft", "stamp", "tre"]
