# SPDX-License-Identifier: BSD-3-Clause
"""Maps points between the rest frame and the deformed frame."""


def _mapped(filter, points, direction):
    """N x 3 positions (mm), mapped by Deform Geometry in the process that has the volume."""
    import numpy
    from paraview import servermanager, simple
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = numpy.asarray(points, float)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"points has the shape {points.shape}; it must be N x 3")
    if len(points) == 0:
        return points.copy()
    active = simple.GetActiveSource()
    source = simple.PolyPointSource(Points=points.ravel().tolist())
    moved = simple.DeformGeometry(Input=source, Deformation=filter, Direction=direction)
    try:
        result = servermanager.Fetch(moved).GetPoints()
        if result is None:
            raise ValueError("filter attaches no deformation; it must be a Free-Form Deformation")
        return vtk_to_numpy(result.GetData()).copy()
    finally:
        simple.Delete(moved)
        simple.Delete(source)
        simple.SetActiveSource(active)


def deformed_from_rest(filter, points):
    """Map points of the rest frame to the deformed frame.

    - `filter`: a Free-Form Deformation.
    - `points`: an N x 3 array of positions in mm, world axes, rest frame.

    Returns an N x 3 array of positions in mm, world axes, deformed frame.

    The function evaluates the deformation itself, not the sampled field that pictures are drawn
    with. With a mask, it evaluates the refined field. It runs in the process that has the volume,
    so it works with a server too.

    Raises `ValueError` if `points` has another shape or `filter` attaches no deformation.
    """
    return _mapped(filter, points, "Forward")


def rest_from_deformed(filter, points):
    """Map points of the deformed frame to the rest frame: find the tissue that is drawn there.

    This is the inverse of `deformed_from_rest`.

    - `filter`: a Free-Form Deformation.
    - `points`: an N x 3 array of positions in mm, world axes, deformed frame.

    Returns an N x 3 array of positions in mm, world axes, rest frame.

    Raises `ValueError` if `points` has another shape or `filter` attaches no deformation.
    """
    return _mapped(filter, points, "Backward")
