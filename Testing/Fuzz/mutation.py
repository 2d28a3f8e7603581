# SPDX-License-Identifier: BSD-3-Clause
"""Spoils files: bytes, words and lengths. Each format has its own files in Testing/Formats."""

import dataclasses
import gzip
import typing

import numpy

#: Numbers that readers stumble over.
REALS = [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 1e-320, 1e-38, 1e38, -1e38, 1e308, float("nan"),
         float("inf"), float("-inf")]
SINGLES = [value for value in REALS if not 1e39 < abs(value) < float("inf")]
INTEGERS = [0, 1, -1, 2, 3, 5, 7, 8, 64, 255, 256, 1006, 1007, 32767, -32768]
WORDS = ["0", "-1", "1", "2", "3", "65535", "65536", "2147483648", "99999999999999999999", "2.5",
         "1e-320", "1e308", "1e400", "nan", "inf", "-inf", "", "x", "True", "False", "LOCAL", "(",
         ")", "none", "big", "little", "raw", "gzip", "RAS", "MET_FLOAT", "MET_DOUBLE", "double"]


def rotation(random):
    """A matrix of unit columns at right angles, mirrored every other time."""
    q = numpy.array([random.gauss(0, 1) for _ in range(4)])
    w, x, y, z = q / numpy.linalg.norm(q)
    turned = numpy.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    if random.random() < 0.5:
        turned[:, random.randrange(3)] *= -1
    if random.random() < 0.3:
        turned = numpy.eye(3)[random.sample(range(3), 3)] * random.choice([1.0, -1.0])
    return turned


def numbers(random, count, kind):
    values = [random.randrange(0, 100) for _ in range(count)]
    return numpy.array(values, kind).tobytes()


def flip(random, data, end):
    place = random.randrange(max(1, min(end, len(data))))
    return data[:place] + bytes([random.randrange(256)]) + data[place + 1:]


def cut(random, data, end):
    kept = random.choice([0, 1, 40, end, end + 1, len(data) // 2, len(data) - 1])
    return data[:kept] if random.random() < 0.8 else data + bytes(random.randrange(1, 99))


def word(random, data, end):
    """Another word in a line of the header, or a line twice, gone or elsewhere."""
    lines = data[:end].split(b"\n")
    which = random.randrange(len(lines))
    change = random.random()
    if change < 0.7:
        words = lines[which].split(b" ")
        words[random.randrange(len(words))] = random.choice(WORDS).encode()
        lines[which] = b" ".join(words)
    elif change < 0.8:
        lines.insert(which, random.choice(lines))
    elif change < 0.9:
        del lines[which]
    else:
        other = random.randrange(len(lines))
        lines[which], lines[other] = lines[other], lines[which]
    return b"\n".join(lines) + data[end:]


@dataclasses.dataclass
class Spoiled:
    """A file of a format: how a good one is made, what spoils it, and who reads it."""

    name: str
    make: typing.Callable      #: from dice, the bytes and the length of the header
    changes: list              #: each takes dice, the bytes and the length of the header
    reader: str                #: BrainShift's, by its label
    answer: typing.Callable    #: of the second reader, from the bytes: world(index) and values
    packs: bool = False        #: whether gzip may pack the whole file

    @property
    def array(self):
        return "Displacement" if self.name.startswith("field") else "Intensity"

    def spoil(self, random):
        """The name and the bytes of a file in which up to three things are spoiled."""
        name, (data, end) = self.name, self.make(random)
        for _ in range(random.choice([0, 1, 1, 1, 2, 3])):
            data = random.choice(self.changes)(random, data, end)
        if self.packs and random.random() < 0.3:
            data = gzip.compress(data)
            name += ".gz"
            if random.random() < 0.3:
                data = random.choice([flip, cut])(random, data, len(data))
        return name, data
