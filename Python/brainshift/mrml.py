# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of 3D Slicer as text (.mrml): nodes, their references and their files."""

import collections
import os
import xml.parsers.expat

#: What a scene may have. Real scenes have some hundred nodes and less than a megabyte.
MOST_BYTES, MOST_NODES, DEEPEST = 64 * 2**20, 20_000, 32

#: What Slicer escapes in names of files, in the order in which it takes that back.
_ESCAPED = (("%22", '"'), ("%3C", "<"), ("%3E", ">"), ("%27", "'"), ("%20", " "), ("%25", "%"))

#: Attributes for references in scenes that have none in `references`.
_OLD_ROLES = {"transform": "transformNodeRef", "storage": "storageNodeRef",
              "display": "displayNodeRef"}

#: The group of ParaView's proxies with points that a scene has at deformed positions.
WORLD_POINTS = "brainshift_world_points"


class SceneProblem(ValueError):
    """Why a scene, or one thing of it, cannot be opened: the end of a sentence about it."""


class SceneClause(SceneProblem):
    """The same with a subject of its own."""


def with_way_out(reason):
    """A reason with what to do about it, unless it says that behind a semicolon."""
    return reason if "; " in reason else f"{reason}; save it again, with the scene, in 3D Slicer 5"


def shown(text):
    """A text of a file for a sentence: of one line, and not long."""
    text = " ".join(str(text).split())
    return text if len(text) <= 80 else text[:77] + "..."


def decoded(name):
    """The name of a file, as Slicer escapes it."""
    for escaped, sign in _ESCAPED:
        name = name.replace(escaped, sign)
    return name


def encoded(name):
    """The reverse of `decoded`."""
    for escaped, sign in reversed(_ESCAPED):
        name = name.replace(sign, escaped)
    return name


class Node:
    """One node: its kind, such as `LinearTransform`, and its attributes as texts."""

    def __init__(self, kind, attributes):
        self.kind, self.attributes = kind, attributes
        self.id = attributes.get("id", "")
        self._references = _references(attributes.get("references", ""))

    @property
    def name(self):
        return self.attributes.get("name") or self.id or "without a name"

    @property
    def words(self):
        """What a sentence calls the node."""
        return f"{self.kind} '{shown(self.name)}'"

    def reference(self, role):
        """The identifier that the node refers to in a role, or an empty text."""
        if role in self._references:
            return self._references[role]
        return (self.attributes.get(_OLD_ROLES.get(role, ""), "").split() or [""])[0]

    def is_on(self, attribute):
        return self.attributes.get(attribute, "").lower() in ("1", "true")

    def file_names(self):
        """Names of the files of a storage node, as they are stored, the first one leading."""
        members = sorted((key for key in self.attributes if key.startswith("fileListMember")),
                         key=lambda key: (len(key), key))
        names = [self.attributes.get("fileName", "")] + [self.attributes[key] for key in members]
        return list(dict.fromkeys(decoded(name) for name in names if name))


def _references(text):
    """The first identifier of each role, of "role:id id;role:id;"."""
    found = {}
    for part in text.split(";"):
        role, _, identifiers = part.partition(":")
        names = [word for word in identifiers.split() if not word.startswith("{")]
        if role.strip() and names:
            found.setdefault(role.strip(), names[0])
    return found


class _Handler:
    """Receives what the parser finds. Nodes are the children of the root; SceneView and the like
    hold copies of nodes, which count for nothing."""

    def __init__(self):
        self.depth, self.nodes, self.version, self.root = 0, [], "", ""

    def doctype(self, name, system, public, has_subset):
        if has_subset:
            raise SceneProblem("declares entities of its own, which no scene of Slicer does")

    def entity(self, *_):
        raise SceneProblem("declares entities of its own, which no scene of Slicer does")

    def start(self, name, attributes):
        self.depth += 1
        if self.depth > DEEPEST:
            raise SceneProblem(f"nests nodes more than {DEEPEST} deep")
        if self.depth == 1:
            self.root, self.version = name, attributes.get("version", "")
        elif self.depth == 2:
            if len(self.nodes) == MOST_NODES:
                raise SceneProblem(f"has more than {MOST_NODES} nodes")
            self.nodes.append(Node(name, attributes))

    def end(self, _):
        self.depth -= 1


def _parsed(data, encoding):
    handler = _Handler()
    parser = xml.parsers.expat.ParserCreate(encoding)
    parser.StartElementHandler, parser.EndElementHandler = handler.start, handler.end
    parser.StartDoctypeDeclHandler, parser.EntityDeclHandler = handler.doctype, handler.entity
    parser.Parse(data, True)
    if handler.root != "MRML":
        raise SceneProblem(f"begins with <{shown(handler.root)}>; a scene begins with <MRML>")
    return handler


Scene = collections.namedtuple("Scene", "path version nodes by_id notes")


def read_scene(path):
    """The nodes of a file `.mrml`; `SceneProblem` with the end of a sentence if it is none."""
    if os.path.getsize(path) > MOST_BYTES:
        raise SceneProblem(f"has {os.path.getsize(path)} bytes; a scene may have {MOST_BYTES}")
    with open(path, "rb") as file:
        data = file.read()
    notes, by_id = [], {}
    try:
        try:
            handler = _parsed(data, None)
        except SceneProblem:
            raise
        except (xml.parsers.expat.ExpatError, ValueError, LookupError):
            if b"encoding=" in data[:200]:
                raise
            handler = _parsed(data, "iso-8859-1")  # old scenes of Windows
            notes.append("The scene is no UTF-8 and names no encoding; its names are read as "
                         "Latin-1.")
    except SceneProblem:
        raise
    except (xml.parsers.expat.ExpatError, ValueError, LookupError) as error:
        raise SceneProblem(f"is no good XML: {error}") from error
    for node in handler.nodes:
        if node.id and node.id in by_id:
            notes.append(f"{node.words} has the identifier {shown(node.id)} of another node; "
                         "references lead to the first.")
        elif node.id:
            by_id[node.id] = node
    return Scene(path, handler.version, handler.nodes, by_id, notes)


def is_below(scene, path):
    """Whether a file is below the folder of a scene, once links are followed."""
    folder = os.path.realpath(os.path.dirname(os.path.abspath(scene.path)))
    return "\0" not in path and os.path.realpath(path).startswith(folder + os.sep)


def path_of(scene, name, outside):
    """The path of a file that a scene names. `outside`: whether it may be elsewhere than below the
    folder of the scene."""
    folder = os.path.dirname(os.path.abspath(scene.path))
    slashed = name.replace("\\", "/")
    if "\0" in name or "://" in slashed:
        raise SceneProblem(f"is at {shown(name)}, which is no file of this machine")
    path = next((each for each in (os.path.join(folder, name), os.path.join(folder, slashed))
                 if os.path.exists(each)), os.path.join(folder, slashed))
    if not outside and not is_below(scene, path):
        raise SceneProblem(f"is in {shown(name)}, outside the folder of the scene; move it there, "
                           "or open the scene with outside=True")
    if not os.path.isfile(path):
        raise SceneProblem(f"is in {shown(name)}, and there is no such file")
    return os.path.normpath(path)
