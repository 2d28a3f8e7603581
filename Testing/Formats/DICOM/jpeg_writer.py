# SPDX-License-Identifier: BSD-3-Clause
"""Writes JPEG frames of one component from the text of the standard (ISO 10918-1).

Of lossless frames GDCM writes the first predictor only, without restarts; and frames of 12 bits
with the cosine transform say 16.
"""

import struct

import numpy

CODE_BITS = 5  # all 17 symbols have codes of this length


def segment(marker, payload):
    return b"\xff" + bytes([marker]) + struct.pack(">H", 2 + len(payload)) + payload


def _predicted(predictor, left, above, corner):
    """The standard halves by a shift to the right, which rounds down."""
    return (left, above, corner, left + above - corner, left + ((above - corner) >> 1),
            above + ((left - corner) >> 1), (left + above) >> 1)[predictor - 1]


def _packed(bits):
    """Bytes of a text of 0 and 1, filled up with ones; a zero follows each 0xff."""
    bits += "1" * (-len(bits) % 8)
    data = int(bits, 2).to_bytes(len(bits) // 8, "big") if bits else b""
    return data.replace(b"\xff", b"\xff\0")


def _code(difference):
    """The code of a difference, taken modulo 65536."""
    difference = (difference + 32767) % 65536 - 32767
    size = abs(difference).bit_length()
    code = f"{size:0{CODE_BITS}b}"
    if size in (0, 16):
        return code
    return code + f"{difference if difference > 0 else difference + (1 << size) - 1:0{size}b}"


def encode(pixels, bits, predictor=1, dropped=0, restart_rows=0):
    """A frame of whole numbers [row, column] from 0 to 2^bits - 1. dropped: lowest bits that are
    left out. restart_rows: rows between two restarts; 0: none."""
    rows, columns = pixels.shape
    frame = struct.pack(">BHHB", bits, rows, columns, 1) + b"\x01\x11\0"
    codes = b"\0" + bytes(17 if length == CODE_BITS else 0 for length in range(1, 17))
    head = b"\xff\xd8" + segment(0xfe, b"written by a test") + segment(0xc3, frame)
    head += segment(0xc4, codes + bytes(range(17)))
    if restart_rows:
        head += segment(0xdd, struct.pack(">H", restart_rows * columns))
    head += segment(0xda, bytes([1, 1, 0, predictor, 0, dropped]))
    values = [[int(value) >> dropped for value in row] for row in pixels]
    text, data, restarts = [], b"", 0
    for y, row in enumerate(values):
        begins = y == 0 or restart_rows and y % restart_rows == 0
        if begins and y > 0:
            data += _packed("".join(text)) + bytes([0xff, 0xd0 + restarts % 8])
            text, restarts = [], restarts + 1
        for x, value in enumerate(row):
            if begins or x == 0:
                guess = row[x - 1] if x else 1 << (bits - dropped - 1)
                guess = values[y - 1][0] if not begins else guess
            else:
                guess = _predicted(predictor, row[x - 1], values[y - 1][x], values[y - 1][x - 1])
            text.append(_code(value - guess))
    return head + data + _packed("".join(text)) + b"\xff\xd9"


ZIGZAG = sorted(range(64), key=lambda i: (i // 8 + i % 8,
                                          i // 8 if (i // 8 + i % 8) % 2 else i % 8))


def _coefficients(pixels, bits):
    """Of blocks from left to right, row by row: 64 whole numbers in the order of the file."""
    rows, columns = (-side % 8 for side in pixels.shape)
    shifted = numpy.pad(pixels.astype(float), ((0, rows), (0, columns)), "edge") - (1 << bits - 1)
    u, x = numpy.mgrid[:8, :8]
    waves = numpy.cos((2 * x + 1) * u * numpy.pi / 16) * numpy.where(u == 0, 0.125, 0.25) ** 0.5
    for top in range(0, shifted.shape[0], 8):
        for left in range(0, shifted.shape[1], 8):
            block = waves @ shifted[top:top + 8, left:left + 8] @ waves.T
            yield numpy.rint(block).astype(int).ravel()[ZIGZAG]


def _size_and_bits(number):
    size = abs(int(number)).bit_length()
    low = int(number) if number > 0 else int(number) + (1 << size) - 1
    return size, f"{low:0{size}b}" if size else ""


def encode_transformed(pixels, bits):
    """An extended frame of whole numbers [row, column], with all factors 1: a number is off by 1 at
    the most. A code is the symbol itself, of 5 bits for first coefficients and of 9 for others."""
    frame = struct.pack(">BHHB", bits, *pixels.shape, 1) + b"\x01\x11\0"
    first = b"\0" + bytes(17 if length == 5 else 0 for length in range(1, 17)) + bytes(range(17))
    others = b"\x10" + bytes(255 if length == 9 else 0 for length in range(1, 17))
    head = b"\xff\xd8" + segment(0xdb, bytes([0]) + bytes([1] * 64)) + segment(0xc1, frame)
    head += segment(0xc4, first + others + bytes(range(255))) + segment(0xda, b"\1\1\0\0\x3f\0")
    text, last = [], 0
    for block in _coefficients(pixels, bits):
        size, low = _size_and_bits(block[0] - last)
        text.append(f"{size:05b}{low}")
        last, zeros = block[0], 0
        for number in block[1:]:
            zeros += 1
            if number != 0:
                size, low = _size_and_bits(number)
                text.append(f"{0xf0:09b}" * ((zeros - 1) // 16))
                text.append(f"{(zeros - 1) % 16 << 4 | size:09b}{low}")
                zeros = 0
        text.append(f"{0:09b}" if zeros else "")
    return head + _packed("".join(text)) + b"\xff\xd9"
