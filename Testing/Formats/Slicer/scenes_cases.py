# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled scenes of 3D Slicer: each thing of a scene is opened where a second reader puts
it, or named in a sentence; nothing is left out in silence.

The second reader is Python's ElementTree with numpy: the scenes have linear transforms only.
"""

import os
import re
import shutil
import warnings
import xml.etree.ElementTree
import zipfile

import numpy
from mutation import WORDS
from oracle import Open, Wrong
from slicer_testing import Written, of_rows

POINTS = numpy.array(((10.0, -20.0, 30.0), (-7.0, 5.0, 61.0), (0.5, 44.0, -9.0)))
NEAR = 1e-3  # mm
REFERENCES = re.compile(r"(?:[a-z]+:[\w.]+;)*$")


def scene_text(random):
    """A good scene of three things below up to three transforms, and what else Slicer writes."""
    scene = Written("fuzz scene", version=random.choice(["Slicer 5.6.2 32448", "Slicer4.4.0", ""]))
    scene.node("Camera", "vtkMRMLCameraNode1", name="Camera")
    above, names = None, []
    for i in range(random.randrange(1, 4)):
        matrix = numpy.eye(4)
        matrix[:3] += [[random.uniform(-0.2, 0.2) for _ in range(3)] + [random.uniform(-50, 50)]
                       for _ in range(3)]
        above = scene.linear(f"T{i}", numpy.round(matrix, 6), above)
        names.append(above)
    scene.lines.reverse()  # children stand before their parents, too
    for i in range(3):
        scene.landmarks(f"F{i}", POINTS + i, above=random.choice([*names, None]),
                        old=random.random() < 0.3)
    return scene


def _spoil_words(random, text):
    """Another word for the value of an attribute, a part of one, or a name."""
    found = list(re.finditer(r'"([^"]*)"|(?<= )(\w+)(?==)|(?<=<)(\w+)', text))
    match = random.choice(found)
    begin, end = match.span()
    value = match.group().strip('"')
    parts = value.split(" ")
    parts[random.randrange(len(parts))] = random.choice(
        [*WORDS, "T0", "T1", "F0", "..", "../x.json", "F1.mrk.json", "&#0;", "&x;", "%2e%2e/"])
    word = " ".join(parts)
    return text[:begin] + (f'"{word}"' if match.group().startswith('"') else word) + text[end:]


def _spoil_lines(random, text):
    lines = text.split("\n")
    which, other = (random.randrange(len(lines)) for _ in range(2))
    change = random.random()
    if change < 0.4:
        del lines[which]
    elif change < 0.7:
        lines.insert(other, lines[which])
    else:
        lines[which], lines[other] = lines[other], lines[which]
    return "\n".join(lines)


def _spoil_bytes(random, text):
    data = bytearray(text.encode())
    if random.random() < 0.5:
        data[random.randrange(len(data))] = random.randrange(256)
    else:
        del data[random.randrange(len(data)):]
    return bytes(data)


def _matrix(node):
    words = node.get("matrixTransformToParent", "").split()
    try:
        matrix = numpy.array([float(word) for word in words]).reshape(4, 4)
    except ValueError as error:
        raise Wrong("no matrix") from error
    if not numpy.isfinite(matrix).all() or (matrix[3] != (0, 0, 0, 1)).any():
        raise Wrong("no affine map")
    return matrix


def _refers(node, role):
    text = node.get("references", "")
    if not REFERENCES.match(text):
        raise Open("references of another form")
    found = dict(part.split(":") for part in reversed(text.split(";")) if part)
    return found.get(role) or (node.get(role + "NodeRef", "").split() or [""])[0]


def expected(root, folder):
    """Of each list of landmarks: its name, and its positions; `Wrong` or `Open` in their place."""
    by_id = {}
    for node in root:
        if node.get("id"):
            by_id.setdefault(node.get("id"), node)
    for node in root:
        if node.tag != "MarkupsFiducial" or node.get("hideFromEditors") == "true":
            continue
        try:
            yield node.get("name") or node.get("id") or "without a name", _places(
                node, by_id, folder)
        except (Wrong, Open) as problem:
            yield node.get("name") or node.get("id") or "without a name", problem


def _places(node, by_id, folder):
    storage = by_id.get(_refers(node, "storage"))
    name = storage.get("fileName", "") if storage is not None else ""
    number = re.fullmatch(r"F([0-2])\.mrk\.json", name)
    if not number or not os.path.exists(os.path.join(folder, name)):
        raise Open("another file")
    places, seen = POINTS + int(number[1]), set()
    while above := _refers(node, "transform"):
        if above in seen or above not in by_id:
            raise Wrong("no such transform")
        seen.add(above)
        node = by_id[above]
        if node.tag != "LinearTransform" or "matrixTransformFromParent" in node.attrib or (
                _refers(node, "storage")):
            raise Open("another transform")
        places = of_rows(_matrix(node), places)
    return places


class Cases:
    """Opens spoiled scenes, one for each case."""

    def __init__(self, folder):
        self.folder = folder
        os.environ.setdefault("BRAINSHIFT_TEST_TEMP", folder)

    def run(self, random):
        """What became of one scene: a word, and a sentence if it is a finding."""
        scene = scene_text(random)
        path = scene.written()
        with open(path, encoding="utf-8") as file:
            spoiled = file.read()
        for _ in range(random.randint(0, 2)):
            spoiled = random.choice((_spoil_words, _spoil_words, _spoil_lines))(random, spoiled)
        spoiled = _spoil_bytes(random, spoiled) if random.random() < 0.2 else spoiled.encode()
        with open(path, "wb") as file:
            file.write(spoiled)
        if random.random() < 0.3:
            return self.bundled(random, scene)
        return self.judged(path, spoiled, scene.folder)

    def bundled(self, random, scene):
        """The scene in a bundle whose bytes are spoiled: it opens or is refused."""
        path = os.path.join(self.folder, "case.mrb")
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
            for name in sorted(os.listdir(scene.folder)):
                file.write(os.path.join(scene.folder, name), f"scene/{name}")
        with open(path, "rb") as file:
            data = bytearray(file.read())
        for _ in range(random.randint(1, 3)):
            at = random.randrange(len(data))
            data[at:at + random.choice((1, 4))] = random.randbytes(random.choice((1, 4)))
        with open(path, "wb") as file:
            file.write(data)
        shutil.rmtree(os.path.join(self.folder, "case-opened"), ignore_errors=True)
        found = self.opened(path)
        outside = [name for name in os.listdir(self.folder) if name.startswith("slip")]
        if outside:
            return f"misplaced: {outside} outside the folder"
        return "refused" if isinstance(found, ValueError) else "taken"

    def opened(self, path):
        import brainshift
        from paraview import simple
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                found = brainshift.open_scene(path)
            places = {name: numpy.array(brainshift.points.read_from(source).positions)
                      for name, source in found.points.items()}
            return found.notes, places
        except ValueError as problem:
            return problem
        finally:
            for source in list(simple.GetSources().values()):
                simple.Delete(source)

    def judged(self, path, spoiled, folder):
        found = self.opened(path)
        if isinstance(found, ValueError):
            return "refused" if path in str(found) else f"misplaced: {found}"
        notes, places = found
        try:
            root = xml.etree.ElementTree.fromstring(spoiled)
        except (xml.etree.ElementTree.ParseError, ValueError, LookupError):
            return "open"  # read as Latin-1
        right = list(expected(root, folder))
        if len({name for name, _ in right}) < len(right):
            return "open" if len(places) + len(notes) >= len(right) else "misplaced: two of a name"
        return self.compared(right, places, notes)

    @staticmethod
    def compared(right, places, notes):
        result = "same"
        for name, where in right:
            named = any(f"'{' '.join(name.split())}'"[:70] in note for note in notes)
            if name not in places and not named:
                return f"misplaced: {name} is left out in silence"
            if name in places and isinstance(where, Wrong):
                return f"misplaced: {name} is opened, but {where}"
            if name in places and not isinstance(where, Open) and (
                    places[name].shape != where.shape or numpy.abs(places[name] - where).max()
                    > NEAR * max(1.0, numpy.abs(where).max() / 1e3)):
                return f"misplaced: {name} is at {places[name]}, not at {where}"
            result = "told" if named else result
        return result
