# SPDX-License-Identifier: Apache-2.0
"""Pictures for the comparisons in this folder: OpenEXR in, measures of error out. Standard library only.

A picture here is one channel, an array of floats row by row from the top, since nothing compared has a colour.
"""
import array
import itertools
import math
import pathlib
import struct
import zlib


class Failure(Exception):
    """What went wrong and what to do, for the user."""


def read_exr(path):
    """Channel name -> array of floats, row by row from the top. Scanlines, 32-bit floats, uncompressed or ZIP."""
    data = pathlib.Path(path).read_bytes()
    if data[:4] != b"\x76\x2f\x31\x01":
        raise Failure(f"{path}: not an OpenEXR file")
    attributes, at = {}, 8
    while data[at]:
        kind = data.index(b"\0", at) + 1
        length = data.index(b"\0", kind) + 1
        (size,) = struct.unpack_from("<i", data, length)
        attributes[data[at : kind - 1].decode()] = data[length + 4 : length + 4 + size]
        at = length + 4 + size
    at += 1
    names = []
    for entry in parse_channels(attributes["channels"]):
        if entry[1] != 2:
            raise Failure(f"{path}: channel {entry[0]} is not of 32-bit floats, the only kind that is read here")
        names.append(entry[0])
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    compression = attributes["compression"][0]
    if compression not in (0, 2, 3):
        raise Failure(f"{path}: compression {compression} is not read here; write it with none or zip")
    rows = {0: 1, 2: 1, 3: 16}[compression]
    channels = {name: array.array("f", bytes(4 * width * height)) for name in names}
    for (offset,) in struct.iter_unpack("<Q", data[at : at + 8 * -(-height // rows)]):
        y, size = struct.unpack_from("<2i", data, offset)
        count = min(rows, y1 - y + 1)
        raw = unpack_block(data[offset + 8 : offset + 8 + size], 4 * width * len(names) * count)
        values = array.array("f", raw)
        for row, (index, name) in itertools.product(range(count), enumerate(names)):
            start = (row * len(names) + index) * width
            channels[name][(y - y0 + row) * width : (y - y0 + row + 1) * width] = values[start : start + width]
    return channels


def write_exr(path, width, height, channels):
    """Scanlines of 32-bit floats, uncompressed. `channels`: name -> array of floats, row by row from the top."""

    def attribute(name, kind, value):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value

    names = sorted(channels)
    listed = b"".join(name.encode() + b"\0" + struct.pack("<i4B2i", 2, 0, 0, 0, 0, 1, 1) for name in names)
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = b"\x76\x2f\x31\x01" + struct.pack("<i", 2)
    head += attribute("channels", "chlist", listed + b"\0") + attribute("compression", "compression", b"\0")
    head += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    head += attribute("lineOrder", "lineOrder", b"\0") + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    head += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    row_bytes = 4 * width * len(names)
    first = len(head) + 8 * height
    offsets = struct.pack(f"<{height}Q", *(first + y * (8 + row_bytes) for y in range(height)))
    with open(path, "wb") as file:
        file.write(head + offsets)
        for y in range(height):
            rows = (channels[name][y * width : (y + 1) * width].tobytes() for name in names)
            file.write(struct.pack("<2i", y, row_bytes) + b"".join(rows))


def parse_channels(block):
    """Yields (name, pixel type) of an EXR `chlist`."""
    at = 0
    while block[at]:
        end = block.index(b"\0", at)
        yield block[at:end].decode(), struct.unpack_from("<i", block, end + 1)[0]
        at = end + 17


def unpack_block(block, size):
    """Undoes EXR's ZIP: deflate, then running sums, then bytes of even and odd position joined again."""
    if len(block) == size:
        return block
    sums = bytes(itertools.accumulate(zlib.decompress(block), lambda a, b: (a + b - 128) & 255))
    joined = bytearray(size)
    joined[0::2], joined[1::2] = sums[: (size + 1) // 2], sums[(size + 1) // 2 :]
    return bytes(joined)


def grey(path):
    """(radiance, 1 - transmittance) of a picture in which nothing has a colour."""
    image = read_exr(path)
    if image["R"] != image["G"] or image["R"] != image["B"]:
        raise Failure(f"{path}: R, G and B differ, although nothing in this comparison has a colour")
    return image["R"], image["A"]


def box_filtered(values, width, height, factor):
    """Means over squares of factor x factor of a picture of width*factor x height*factor pixels."""
    if factor == 1:
        return values
    wide, means = width * factor, array.array("f", bytes(4 * width * height))
    for y in range(height):
        rows = [values[row * wide : (row + 1) * wide] for row in range(y * factor, (y + 1) * factor)]
        columns = [row[i::factor] for row in rows for i in range(factor)]
        means[y * width : (y + 1) * width] = array.array("f", (sum(square) / factor**2 for square in zip(*columns)))
    return means


def relative_error(picture, reference, pixels):
    """(rRMSE, relative difference of the means) over the pixels with these indices; docs/conventions.md."""
    squares = sum((picture[i] - reference[i]) ** 2 for i in pixels)
    difference = sum(picture[i] - reference[i] for i in pixels)
    return (
        math.sqrt(squares / sum(reference[i] ** 2 for i in pixels)),
        difference / sum(reference[i] for i in pixels),
    )


def registration(picture, reference, size, pixels):
    """Least squares of picture = gain * reference(x - dx, y - dy), linearised. Returns (dx, dy in pixels, gain).

    Positive: the picture lies to the right of, or below the reference. `pixels` have all four neighbours.
    """
    rows = [
        (
            (reference[i - 1] - reference[i + 1]) / 2,
            (reference[i - size] - reference[i + size]) / 2,
            reference[i],
            picture[i],
        )
        for i in pixels
    ]
    matrix = [[sum(row[a] * row[b] for row in rows) for b in range(4)] for a in range(3)]
    for a, b in itertools.permutations(range(3), 2):  # Gauss-Jordan; symmetric and positive, so no pivoting
        factor = matrix[b][a] / matrix[a][a]
        matrix[b] = [matrix[b][c] - factor * matrix[a][c] for c in range(4)]
    shift_x, shift_y, gain = (matrix[a][3] / matrix[a][a] for a in range(3))
    return shift_x / gain, shift_y / gain, gain
