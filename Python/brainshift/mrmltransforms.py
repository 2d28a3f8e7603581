# SPDX-License-Identifier: BSD-3-Clause
"""The transforms of a scene of 3D Slicer: the chain that leads from the world to a node.

Slicer keeps a linear transform as the matrix to its parent, and the file of a transform as the map
from its parent. A chain here leads the second way, as TransformReader wants it: points of the world
pass the outermost transform first.
"""

import hashlib
import os

from .mrml import SceneClause, SceneProblem, path_of
from .mrmlfiles import require_below
from .transforms import _LPS, _write_itk, read_transform

#: Kinds of transform nodes.
KINDS = ("LinearTransform", "BSplineTransform", "GridTransform", "Transform")

#: Transforms above one another. Slicer's own scenes have a handful.
_DEEPEST = 64

#: A matrix counts as a motion where its axes keep length and right angles to this.
_RIGID = 5e-6  # Slicer writes six digits


def _matrix_in(text):
    """16 numbers of a node as a matrix that has an inverse."""
    import numpy

    try:
        numbers = [float(word) for word in text.split()]
    except ValueError as error:
        raise SceneProblem("has a matrix with words that are no numbers") from error
    matrix = numpy.array(numbers)
    if matrix.size != 16:
        raise SceneProblem(f"has a matrix of {matrix.size} numbers; it must have 16")
    matrix = matrix.reshape(4, 4)
    if not numpy.isfinite(matrix).all() or (matrix[3] != (0, 0, 0, 1)).any():
        raise SceneProblem("has a matrix that is not affine")
    if not 1e-9 < abs(numpy.linalg.det(matrix[:3, :3])) < 1e9:
        raise SceneProblem("has a matrix without an inverse")
    return matrix


class Link:
    """One transform: the matrix or the file that leads from its parent."""

    def __init__(self, name, matrix=None, file=None):
        self.name, self.matrix, self.file = name, matrix, file


def _link_of_file(node, path):
    """The link of a transform's file. A linear one becomes a matrix."""
    import numpy

    try:
        transform = read_transform(path)
    except OSError as problem:
        raise SceneProblem(f"cannot be read: {problem}") from problem
    matrix = transform.moving_from_fixed
    # Scenes before Slicer 4.4 name the direction of files, that of linear ones by its opposite.
    word = node.attributes.get("readWriteAsTransformToParent")
    if word is not None and (word == "true") != (node.kind == "LinearTransform"):
        if matrix is None:
            raise SceneProblem("is stored as leading to its parent (readWriteAsTransformToParent); "
                               "save the scene again with Slicer 5")
        matrix = numpy.linalg.inv(matrix)
    return Link(node.name, matrix=matrix) if matrix is not None else Link(node.name, file=path)


def _own_matrix(node):
    """The matrix from its parent of a node that holds it itself; None if it does not."""
    import numpy

    if "matrixTransformToParent" in node.attributes:
        return numpy.linalg.inv(_matrix_in(node.attributes["matrixTransformToParent"]))
    if "matrixTransformFromParent" in node.attributes:
        return _matrix_in(node.attributes["matrixTransformFromParent"])
    return None


class Transforms:
    """The transforms of a scene, each read once."""

    def __init__(self, scene, outside):
        self._scene, self._outside, self._known = scene, outside, {}
        self.notes = []  #: sentences on what was read otherwise than Slicer means it to be

    def _read(self, node):
        storage = self._scene.by_id.get(node.reference("storage"))
        names = storage.file_names() if storage else []
        if node.kind not in KINDS:
            raise SceneProblem("is no transform")
        if names:
            try:
                path = path_of(self._scene, names[0], self._outside)
                require_below(self._scene, path, self._outside, is_transform=True)
                return _link_of_file(node, path)
            except SceneProblem as problem:
                if _own_matrix(node) is None:
                    raise
                self.notes.append(f"{node.words} {problem}. The matrix in the scene counts.")
        matrix = _own_matrix(node)
        if matrix is None:
            raise SceneProblem("has neither a matrix nor a file")
        return Link(node.name, matrix=matrix)

    def own_link(self, node):
        """The link of a transform node; the same reason each time if it cannot be read."""
        if node.id not in self._known:
            try:
                self._known[node.id] = self._read(node)
            except SceneProblem as problem:
                self._known[node.id] = problem
        found = self._known[node.id]
        if isinstance(found, SceneProblem):
            raise found
        return found

    def link(self, node):
        """The link of a transform above another node; a reason names the transform."""
        try:
            return self.own_link(node)
        except SceneProblem as problem:
            raise SceneClause(f"{node.words}, a transform above, {problem}") from problem

    def chain(self, node):
        """The links from the world to a node, the outermost transform first."""
        links, seen = [], set()
        while name := node.reference("transform"):
            if name in seen or len(seen) == _DEEPEST:
                raise SceneClause("its transforms lead back to themselves" if name in seen else
                                  f"it has more than {_DEEPEST} transforms above it")
            seen.add(name)
            if name not in self._scene.by_id:
                raise SceneClause(f"its transform {name} is not in the scene")
            node = self._scene.by_id[name]
            links.insert(0, self.link(node))
        return links


def is_still(matrix):
    """Whether a matrix moves nothing, apart from rounding."""
    import numpy

    return numpy.abs(matrix - numpy.eye(4)).max() < 1e-9


def motion_in(links, centre):
    """The motion that all linear links of a chain make together, from below to the world: the
    nearest rotation or mirrored rotation, and the shift of a centre."""
    import numpy

    linear = numpy.eye(4)
    for link in links:
        if link.matrix is not None:
            linear = linear @ numpy.linalg.inv(link.matrix)
    left, lengths, right = numpy.linalg.svd(linear[:3, :3])
    if numpy.abs(lengths - 1.0).max() < _RIGID:
        return linear
    motion = numpy.eye(4)
    motion[:3, :3] = left @ right
    motion[:3, 3] = linear[:3, :3] @ centre + linear[:3, 3] - motion[:3, :3] @ centre
    return motion


def merged(links):
    """The same chain with neighbouring matrices as one, and none that moves nothing."""
    found = []
    for link in links:
        if link.matrix is not None and found and found[-1].matrix is not None:
            found[-1] = Link(found[-1].name, matrix=link.matrix @ found[-1].matrix)
        else:
            found.append(link)
    return [link for link in found if link.matrix is None or not is_still(link.matrix)]


def files_of(links, folder):
    """The files of a chain, matrices written into `folder()`."""
    import numpy

    signs, names = numpy.array(_LPS), []
    for link in links:
        if link.file is not None:
            names.append(link.file)
            continue
        matrix = signs[:, None] * link.matrix * signs
        parameters = [*matrix[:3, :3].ravel(), *matrix[:3, 3]]
        digest = hashlib.sha256(repr([float(number) for number in parameters]).encode())
        name = os.path.join(folder(), f"linear-{digest.hexdigest()[:12]}.tfm")
        try:
            _write_itk(name, "AffineTransform", parameters, (0.0, 0.0, 0.0))
        except OSError as problem:
            raise SceneProblem(f"needs {name}, which cannot be written: {problem.strerror}"
                               ) from problem
        names.append(name)
    return names
