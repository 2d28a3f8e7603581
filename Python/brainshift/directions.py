# SPDX-License-Identifier: BSD-3-Clause
"""Which way a transform leads: both directions, their closure, and what other programs do."""

import os

from .transforms import _names, read_transform

#: What programs do with a map from the fixed to the moving image.
_PROGRAMS = {
    "ANTs": "antsApplyTransforms -r FIXED -i MOVING -t FILE resamples the moving image on the "
            "fixed one; antsApplyTransformsToPoints with the same FILE takes points of the fixed "
            "image to the moving one. To move points of the moving image, invert the map.",
    "FSL": "applywarp --ref=FIXED --in=MOVING --warp=FILE resamples with such a warp. flirt's "
           "matrix leads the other way, from the moving to the fixed image.",
    "SPM": "The voxels of a y_ file are those of the fixed image, and its numbers the positions in "
           "the moving one: Pullback resamples the moving image with it.",
    "Slicer": "Files hold the transform from the parent: what the node moves is the moving image, "
              "and the displayed transform to the parent is the inverse of the file's map.",
}


class MapDirection:
    """The result of `direction`. `print` shows all of it.

    - `stories`: what each file says and which way it leads, a sentence or two for each.
    - `kind`: `"identity"`, `"rigid"`, `"affine"` or `"nonlinear"`.
    - `fixed`, `moving`: N x 3 arrays of points in mm, world axes, and where the map takes them.
    - `back`: where its inverse takes `moving`.
    - `closure`: the largest distance in mm between `fixed` and `back`. It is large where the map
      folds or ends.
    - `programs`: a sentence for each of ANTs, FSL, SPM and Slicer.
    """

    def __init__(self, names, transform, fixed):
        import numpy
        self.kind, self.fixed, self.programs = transform.kind, fixed, dict(_PROGRAMS)
        stories = transform._report.GetProperty("Stories").GetElement(0).split("\n")
        self.stories = stories
        self._names, self._knows_sides = names, transform._knows_sides
        self.moving = transform.map(fixed)
        self.back = transform.map_back(self.moving)
        misses = numpy.linalg.norm(self.back - fixed, axis=1)
        self.closure = float(numpy.nanmax(misses)) if numpy.isfinite(misses).any() else numpy.nan
        self._open = int((~(misses <= 0.01)).sum())

    def __str__(self):
        import numpy
        names = self._names if len(self._names) == len(self.stories) else [
            ", ".join(self._names)] + ["A file that it names"] * (len(self.stories) - 1)
        lines = [f"{os.path.basename(name)} {story}" for name, story in zip(names, self.stories)]
        moves = numpy.linalg.norm(self.moving - self.fixed, axis=1)
        moves = numpy.where(numpy.isfinite(moves), moves, -1.0)
        at = int(moves.argmax())

        def place(point):
            return "(" + ", ".join(f"{number:.2f}" for number in point) + ") mm"
        lines += [
            f"The map is {self.kind}, and moves up to {moves[at]:.2f} mm of {len(moves)} points.",
            f"From fixed to moving (resampling; backward): {place(self.fixed[at])} goes to "
            f"{place(self.moving[at])}.",
            f"From moving to fixed (tissue, landmarks; forward): {place(self.moving[at])} goes to "
            f"{place(self.back[at])}.",
            f"There and back the points miss by up to {self.closure:.2g} mm; {self._open} miss by "
            "more than 0.01 mm or have no place.",
            "If the volume that you bend was the moving image, use direction=\"backward\"; if it "
            "was the fixed one, \"forward\"."]
        if not self._knows_sides:
            lines.append("An image does not say where the sides of the patient are: left and right "
                         "may be exchanged.")
        return "\n".join(lines + [f"{name}: {line}" for name, line in self.programs.items()])


def _sample(transform):
    """Points inside the own B-spline or field of a map, or within 60 mm of 0, 7 along each axis."""
    import numpy
    bounds = transform._report.GetProperty("OwnBounds")
    ends = [bounds.GetElement(i) for i in range(bounds.GetNumberOfElements())] or [-60.0, 60.0] * 3
    inside = [numpy.linspace(low, high, 9)[1:-1] for low, high in zip(ends[::2], ends[1::2])]
    return numpy.stack(numpy.meshgrid(*inside, indexing="ij"), axis=-1).reshape(-1, 3)


def direction(files, world="RAS", fixed_image=None, moving_image=None, program=None, points=None):
    """Say which way a transform or a displacement field leads.

    - `files`, `world`, `fixed_image`, `moving_image`, `program`: as in `read_transform`. A field
      that says that it leads forward is turned round.
    - `points`: an N x 3 array of points of the fixed image in mm, world axes, to map there and
      back. The default is 7 x 7 x 7 points inside the file's own field, or within 60 mm of 0.

    Returns a `MapDirection`: `print` it.

    Raises `OSError` with the reason if a file cannot be read.
    """
    import numpy
    names = _names(files)
    transform = read_transform(names, world, fixed_image, moving_image, program)
    fixed = _sample(transform) if points is None else numpy.asarray(points, float)
    return MapDirection(names, transform, fixed)
