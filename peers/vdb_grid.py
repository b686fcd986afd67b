# SPDX-License-Identifier: Apache-2.0
"""Writes a small dense array as an OpenVDB file, so that another program can be given the very same numbers."""
import struct
import uuid

import numpy

from pictures import Failure

ROOT = 4096  # voxels along the edge of what one child of the root node spans


def text(string):
    return struct.pack("<I", len(string)) + string.encode()


def mask(indices, count):
    """Bits of a node: `indices` are on."""
    bits = numpy.zeros(count, numpy.uint8)
    bits[indices] = 1
    return numpy.packbits(bits, bitorder="little").tobytes()


def linear(coordinate, bits):
    """Index of a child: z runs fastest."""
    return (coordinate[0] << 2 * bits) + (coordinate[1] << bits) + coordinate[2]


def leaves_of(values, first):
    """Origin of each 8^3 leaf that the array touches -> (which of its voxels are active, their values)."""
    low = numpy.array(first)
    high = low + values.shape
    leaves = {}
    for corner in numpy.ndindex(*((high - 1) // 8 - low // 8 + 1)):
        origin = (low // 8 + corner) * 8
        active, inside = numpy.zeros((8, 8, 8), bool), numpy.zeros((8, 8, 8), numpy.float32)
        begin, end = numpy.maximum(origin, low), numpy.minimum(origin + 8, high)
        here = tuple(slice(b, e) for b, e in zip(begin - origin, end - origin))
        active[here] = True
        inside[here] = values[tuple(slice(b, e) for b, e in zip(begin - low, end - low))]
        leaves[tuple(int(c) for c in origin)] = active, inside
    return leaves


def children_of(leaves, bits, span):
    """Groups leaves by the child of `span` voxels that holds them, in the order of the node's mask of 8^`bits`."""
    groups = {}
    for origin, leaf in leaves.items():
        groups.setdefault(linear([c // span % (1 << bits) for c in origin], bits), {})[origin] = leaf
    return dict(sorted(groups.items()))


def topology(leaves):
    """(bytes of the tree's nodes, leaves in the order of the file). `values` of inner nodes are all 0, uncompressed."""

    def inner(groups, bits):
        count = 1 << 3 * bits
        return mask(list(groups), count) + mask([], count) + b"\x06" + bytes(4 * count)

    data, ordered = b"", []
    upper = children_of(leaves, 5, 128)
    data += inner(upper, 5)
    for group in upper.values():
        lower = children_of(group, 4, 8)
        data += inner(lower, 4)
        for child in lower.values():
            ((active, _),) = child.values()
            data += mask(numpy.flatnonzero(active), 512)
            ordered += child.values()
    return data, ordered


def vdb_file(values, first, voxel):
    """Bytes of an OpenVDB file (format 224): one float grid `density` of uniform voxels.

    @param values array [x, y, z]; all of them are active. @param first index of values[0, 0, 0], not negative.
    @param voxel world units; index (i, j, k) is at voxel * (i, j, k).
    """
    if min(first) < 0 or max(a + b for a, b in zip(first, values.shape)) > ROOT:
        raise Failure(f"a grid from {first} of {values.shape} voxels does not lie in [0, {ROOT})")
    scales = (voxel, voxel, 1 / voxel, 1 / voxel**2, 0.5 / voxel)
    transform = text("UniformScaleMap") + b"".join(struct.pack("<3d", *[scale] * 3) for scale in scales)
    metadata = struct.pack("<I", 1) + text("class") + text("string") + text("fog volume")
    nodes, leaves = topology(leaves_of(values, first))
    root = struct.pack("<fII", 0.0, 0, 1) + struct.pack("<3i", 0, 0, 0) + nodes
    grid = struct.pack("<I", 0) + metadata + transform + struct.pack("<I", 1) + root
    buffers = b"".join(
        mask(numpy.flatnonzero(active), 512) + b"\x06" + inside.astype("<f4").tobytes() for active, inside in leaves
    )
    head = struct.pack("<qIII?", 0x56444220, 224, 10, 0, True) + str(uuid.UUID(int=0)).encode() + struct.pack("<I", 0)
    descriptor = text("density") + text("Tree_float_5_4_3") + text("")
    start = len(head) + 4 + len(descriptor) + 24
    positions = struct.pack("<3q", start, start + len(grid), start + len(grid) + len(buffers))
    return head + struct.pack("<I", 1) + descriptor + positions + grid + buffers
