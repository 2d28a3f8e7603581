# SPDX-License-Identifier: BSD-3-Clause
"""Finds the window of grey values in which a volume is seen at first."""

#: Number of bins of the histogram: one for each value of 16 bits.
BINS = 65536


def _histogram(source, association, name):
    """Counts and edges of the bins. The server counts; only the counts come here."""
    from paraview import servermanager
    from vtkmodules.util.numpy_support import vtk_to_numpy

    manager = source.SMProxy.GetSessionProxyManager()
    proxy = manager.NewProxy("filters", "ExtractHistogram")
    proxy.UnRegister(None)  # Python holds it
    proxy.PrototypeOn()  # a question is no step to undo
    histogram = servermanager._getPyProxy(proxy)
    histogram.Input = servermanager.OutputPort(source, 0)
    histogram.SelectInputArray = [association, name]
    histogram.BinCount = BINS
    histogram.UpdateVTKObjects()
    histogram.UpdatePipeline()
    rows = servermanager.Fetch(histogram).GetRowData()
    if rows.GetNumberOfArrays() < 2:
        return None
    middles, counts = (vtk_to_numpy(rows.GetArray(name))
                       for name in ("bin_extents", "bin_values"))
    return middles.astype(float), counts.astype(float)


def _otsu(middles, counts):
    """The value that divides the histogram into the two groups that differ most (Otsu 1979)."""
    import numpy

    below, moment = counts.cumsum(), (counts * middles).cumsum()
    above = below[-1] - below
    with numpy.errstate(divide="ignore", invalid="ignore"):
        between = (moment[-1] * below / below[-1] - moment) ** 2 / (below * above)
    return middles[int(numpy.nanargmax(numpy.where(above > 0, between, numpy.nan)))]


def _without_background(middles, counts):
    """The counts of all but the background: the many values about the commonest one, if dark.

    Otsu's threshold alone would take the dark fluid of the brain for background, so the background
    ends half-way to it.
    """
    commonest = middles[int(counts.argmax())]
    threshold = _otsu(middles, counts)
    if commonest >= threshold:
        return counts
    return counts * (middles > (commonest + threshold) / 2)


def percentile_window(source, association, name, percentiles=(1, 99)):
    """Find a window of grey values that shows the tissue of a volume.

    A few very bright voxels do not darken the window, and the background around the patient does
    not count. The voxels are counted where they are, so this works with a server too.

    - `source`: a ParaView source of image data.
    - `association`: `"POINTS"` or `"CELLS"`.
    - `name`: name of an array with one component.
    - `percentiles`: the shares of tissue (%) that are darker than the two ends of the window.
      Default 1 and 99.

    Returns the values at the two ends, or `None` if the array has no two different numbers or has
    several components.

    Raises `ValueError` if `percentiles` are not two ascending numbers from 0 to 100.
    """
    import numpy

    if len(percentiles) != 2 or not 0 <= percentiles[0] < percentiles[1] <= 100:
        raise ValueError(f"percentiles are {tuple(percentiles)}; "
                         "they must be two ascending numbers from 0 to 100")
    arrays = source.PointData if association == "POINTS" else source.CellData
    array = arrays.GetArray(name)
    if array is None or array.GetNumberOfComponents() != 1:
        return None
    low, high = array.GetRange()
    if not (numpy.isfinite([low, high]).all() and low < high):
        return None
    found = _histogram(source, association, name)
    if found is None or not found[1].any():
        return None
    middles, counts = found
    shares = _without_background(middles, counts).cumsum()
    ends = [float(middles[int(numpy.searchsorted(shares, percent / 100 * shares[-1]))])
            for percent in percentiles]
    return tuple(ends) if ends[0] < ends[1] else None
