# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled files of landmarks: each is read by BrainShift and by a second reader.

The second reader uses Python's own json and csv modules and knows only the plainest form of each
format; what it refuses to judge is left open.
"""

import csv
import io
import json
import os
import re

import numpy
from mutation import WORDS
from oracle import Open, Wrong

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$")
FARTHEST = 1e6  # mm
COLUMNS = "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID"


def _number(word):
    if not NUMBER.match(word.strip()):
        raise Wrong(f"no number: {word!r}")
    return float(word)


def _signs(system):
    signs = {"RAS": 1.0, "0": 1.0, "LPS": -1.0, "1": -1.0}.get(str(system))
    if signs is None:
        raise Wrong(f"coordinate system {system}")
    return numpy.array([signs, signs, 1.0])


def _places(random):
    return [[round(random.uniform(-99, 99), random.randrange(9)) for _ in range(3)]
            for _ in range(random.randrange(1, 6))]


def _label(random):
    return random.choice(["", "F-1", 'a, "b"', "後頭葉"])


def markups(random):
    points = [{"label": _label(random), "position": place, "positionStatus": "defined"}
              for place in _places(random)]
    return json.dumps({"markups": [{"coordinateSystem": random.choice(["RAS", "LPS"]),
                                    "controlPoints": points}]}, indent=1, ensure_ascii=False)


def read_markups(text):
    def once(pairs):
        if len({key for key, _ in pairs}) < len(pairs):
            raise Open("a key twice")
        return dict(pairs)
    try:
        root = json.loads(text, object_pairs_hook=once, parse_constant=_number)
    except (json.JSONDecodeError, RecursionError) as error:
        raise Wrong("no JSON") from error
    if not isinstance(root, dict) or not isinstance(root.get("markups"), list):
        raise Wrong("no markups")
    found = []
    for markup in root["markups"]:
        if not isinstance(markup, dict) or not isinstance(markup.get("controlPoints"), list):
            raise Open("no control points")
        for point in markup["controlPoints"]:
            place = point.get("position") if isinstance(point, dict) else None
            if not isinstance(place, list) or point.get("positionStatus") != "defined":
                raise Open("no place")
            if len(place) != 3 or not all(type(number) in (int, float) for number in place):
                raise Wrong("not 3 numbers") if place else Open("no place")
            found.append(numpy.array(place, float) * _signs(markup.get("coordinateSystem", "LPS")))
    return found


def fiducials(random):
    said = io.StringIO()
    print("# Markups fiducial file version = 4.11", file=said)
    print(f"# CoordinateSystem = {random.choice(['0', '1', 'RAS', 'LPS'])}", file=said)
    print(f"# columns = {COLUMNS}", file=said)
    rows = csv.writer(said, lineterminator="\n")
    for number, place in enumerate(_places(random)):
        rows.writerow([number, *place, 0, 0, 0, 1, 1, 1, 0, _label(random), "", ""])
    return said.getvalue()


def read_fiducials(text):
    if '"' in text and text.count('"') % 2:
        raise Open("quotes")
    signs, found = numpy.ones(3), []
    for row in csv.reader(io.StringIO(text)):
        if not "".join(row).strip():
            continue
        line = ",".join(row).strip()
        if line.startswith("#"):
            key, _, value = line[1:].partition("=")
            if key.strip() == "CoordinateSystem":
                if found:
                    raise Open("axes after points")
                signs = _signs(value.strip())
            elif "coordinatesystem" in key.lower() or (
                    key.strip().lower() == "columns" and value != f" {COLUMNS}"):
                raise Open("another word")
            continue
        if len(row) < 4 or len(row) > 14:
            raise Open("columns")
        found.append(numpy.array([_number(word) for word in row[1:4]]) * signs)
    return found


def tags(random):
    volumes = random.choice([1, 2])
    lines = [f"MNI Tag Point File\nVolumes = {volumes};\n\nPoints ="]
    for place in _places(random):
        words = map(str, place * volumes)
        lines.append(f" {' '.join(words)} \"{random.choice(['', 'F-1', '後頭葉'])}\"")
    return "\n".join(lines) + ";\n"


def read_tags(text):
    found = re.fullmatch(r"MNI Tag Point File\nVolumes = ([12]);\n+Points =\n((?:[^;%#']|\n)*);\n*",
                         text)
    if not found:
        raise Open("another form")
    count, places = 3 * int(found[1]), []
    for line in found[2].split("\n"):
        plain = re.fullmatch(r'([^"]*)("[^"]*")?', line.strip())
        words = plain[1].split() if plain else []
        if not plain or len(words) != count:
            raise Open("another form")
        places.append(numpy.array([_number(word) for word in words])[:3])
    return places


def table(random):
    said = io.StringIO()
    names = random.choice([["x", "y", "z"], ["R", "A", "S"], ["l", "p", "s"]])
    rows = csv.writer(said, lineterminator=random.choice(["\n", "\r\n"]),
                      delimiter=random.choice(",;\t"))
    rows.writerow([*names, "label"])
    for place in _places(random):
        rows.writerow([*place, _label(random)])
    return said.getvalue()


def read_table(text):
    first = text.splitlines()[0] if text else ""
    names = re.split(r"[,;\t]", first)
    if len(names) != 4 or len(set(re.findall(r"[,;\t]", first))) != 1 or text.count('"') % 2:
        raise Open("another form")
    axes = "".join(names[:3]).lower()
    if axes not in ("xyz", "ras", "lps") or names[3] != "label" or "\r" in text.replace("\r\n", ""):
        raise Open("another form")
    found = []
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=first[len(names[0])])
    for row in list(rows)[1:]:
        if not "".join(row).strip():
            continue
        if len(row) != 4 or not all(word.strip() for word in row[:3]):
            raise Open("another form")
        found.append(numpy.array([_number(word) for word in row[:3]]) *
                     _signs("LPS" if axes == "lps" else "RAS"))
    return found


FORMATS = {".mrk.json": (markups, read_markups), ".fcsv": (fiducials, read_fiducials),
           ".tag": (tags, read_tags), ".csv": (table, read_table)}


def _spoil(random, data):
    """Another byte, another word, a line twice or gone, or an end too early."""
    change = random.random()
    place = random.randrange(max(1, len(data)))
    if change < 0.3:
        return data[:place] + bytes([random.randrange(256)]) + data[place + 1:]
    if change < 0.4:
        return data[:place]
    if change < 0.8:
        words = re.split(rb"([\s,;:=]+)", data)
        words[2 * random.randrange((len(words) + 1) // 2)] = random.choice(WORDS).encode()
        return b"".join(words)
    lines = data.split(b"\n")
    which = random.randrange(len(lines))
    lines[which:which + 1] = [lines[which]] * random.choice([0, 2])
    return b"\n".join(lines)


def _answer(ending, data):
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise Open("no UTF-8") from error
    if "\0" in text:
        raise Wrong("a byte 0")
    found = FORMATS[ending][1](text.removeprefix("\ufeff"))
    if found and not numpy.abs(numpy.array(found)).max() <= FARTHEST:
        raise Wrong("too far away")
    return found


class Cases:
    """Reads spoiled files, one for each case."""

    def __init__(self, folder):
        self.folder = folder

    def run(self, random):
        """What became of one file: a word, and a sentence if it is a finding."""
        import brainshift
        from brainshift_testing import messages
        ending = random.choice(sorted(FORMATS))
        data = FORMATS[ending][0](random).encode()
        for _ in range(random.choice([0, 1, 1, 1, 2, 3])):
            data = _spoil(random, data)
        name = os.path.join(self.folder, f"case{ending}")
        with open(name, "wb") as file:
            file.write(data)
        with messages() as said:
            try:
                read = brainshift.read_points(name).positions
            except ValueError as error:
                return "refused" if str(error) and "\n" not in str(error) else f"misplaced: {error}"
        try:
            expected = _answer(ending, data)
        except (Open, csv.Error):
            return "open"
        except Wrong as error:
            return f"accepted: the other reader says: {error}"
        if len(read) == len(expected) and (not expected or numpy.array_equal(read, expected)):
            return "same"
        return f"misplaced: {read.tolist()} in place of {expected} {said.text[:80]}"
