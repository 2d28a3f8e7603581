# SPDX-License-Identifier: BSD-3-Clause
"""Finds the first window of grey values of a volume."""

from .reports import measure, numbers, report_on


def percentile_window(source, association, name, percentiles=(1, 99)):
    """Find a window of grey values that shows the tissue of a volume.

    A few very bright voxels do not darken the window, and the background around the patient does
    not count. The process that has the volume counts the voxels, so this works with a server too.
    Of a larger volume, it counts about 4 million voxels at even distances.

    - `source`: a ParaView source of image data.
    - `association`: `"POINTS"` or `"CELLS"`.
    - `name`: name of an array with one component.
    - `percentiles`: the percentages of tissue that are darker than the two ends of the window,
      0 to 100. Default 1 and 99.

    Returns the values at the two ends, or `None` if the array has no two different values or has
    several components.

    Raises `ValueError` if `percentiles` are not two ascending numbers from 0 to 100.
    """
    if len(percentiles) != 2 or not 0 <= percentiles[0] < percentiles[1] <= 100:
        raise ValueError(f"percentiles are {tuple(percentiles)}; "
                         "they must be two ascending numbers from 0 to 100")
    source.UpdatePipeline()
    report = report_on(source.SMProxy, 0, int(association == "CELLS"), name)
    for i, percent in enumerate(percentiles):
        report.GetProperty("Percentiles").SetElement(i, percent)
    measure(report, "MeasureWindow")
    return tuple(numbers(report, "Window")) or None
