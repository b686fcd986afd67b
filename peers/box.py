# SPDX-License-Identifier: Apache-2.0
"""A cube of constant density with an exact answer: as a .vdb file, and as numbers by quadrature."""
import array
import itertools
import math
import struct
import uuid

TILE = 4096  # voxels along the edge of one tile of the root node
EDGE = 2.0  # world units; the cube is [0, EDGE]^3
VOXEL = EDGE / TILE


def vdb_file():
    """Bytes of an OpenVDB file (format 224): one float grid `density` of one active root tile of the value 1."""

    def text(string):
        return struct.pack("<I", len(string)) + string.encode()

    scale = VOXEL
    transform = text("UniformScaleMap") + b"".join(
        struct.pack("<3d", *[value] * 3) for value in (scale, scale, 1 / scale, 1 / scale**2, 0.5 / scale)
    )
    metadata = struct.pack("<I", 1) + text("class") + text("string") + text("fog volume")
    root = struct.pack("<fII", 0.0, 1, 0) + struct.pack("<3if?", 0, 0, 0, 1.0, True)
    grid = struct.pack("<I", 0) + metadata + transform + struct.pack("<I", 1) + root
    head = struct.pack("<qIII?", 0x56444220, 224, 10, 0, True) + str(uuid.uuid4()).encode() + struct.pack("<I", 0)
    descriptor = text("density") + text("Tree_float_5_4_3") + text("")
    start = len(head) + 4 + len(descriptor) + 24
    positions = struct.pack("<3q", start, start + len(grid), start + len(grid))
    return head + struct.pack("<I", 1) + descriptor + positions + grid


def span(origin, direction):
    """(entry, exit) of a ray and the cube, entry at least 0; empty where entry >= exit."""
    near, far = 0.0, math.inf
    for start, slope in zip(origin, direction):
        ends = sorted(
            (corner - start) / slope if slope else math.copysign(math.inf, corner - start) for corner in (0, EDGE)
        )
        near, far = max(near, ends[0]), min(far, ends[1])
    return near, far


def unit(vector):
    length = math.hypot(*vector)
    return [component / length for component in vector]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def camera_ray(setup, x, y):
    """Direction through the raster position (x, y) in pixels from the top left; up is +y."""
    forward = unit([a - b for a, b in zip(setup.target, setup.position)])
    right = unit(cross(forward, (0, 1, 0)))
    up = cross(right, forward)
    half = math.tan(math.radians(setup.fov) / 2)
    across, along = (2 * x / setup.size - 1) * half, (1 - 2 * y / setup.size) * half
    return unit([f + across * r + along * u for f, r, u in zip(forward, right, up)])


def radiance(setup, direction, nodes=200):
    """(radiance, chord) along one camera ray, sun of irradiance 4 pi: albedo times the integral of sigma T T_sun."""
    near, far = span(setup.position, direction)
    if near >= far:
        return 0.0, 0.0
    to_light, sigma, step, total = unit(setup.to_light), setup.density_scale, (far - near) / nodes, 0.0
    for k in range(nodes):
        depth = (k + 0.5) * step
        point = [o + (near + depth) * d for o, d in zip(setup.position, direction)]
        total += math.exp(-sigma * (depth + span(point, to_light)[1]))
    return setup.albedo * sigma * step * total, far - near


def picture(setup, offsets):
    """(mean radiance over rays at these offsets in a pixel, both ways; shortest chord of those rays), per pixel."""
    values, chords = array.array("f"), []
    for y, x in itertools.product(range(setup.size), repeat=2):
        rays = [camera_ray(setup, x + a, y + b) for a, b in itertools.product(offsets, repeat=2)]
        found = [radiance(setup, ray) for ray in rays]
        values.append(sum(value for value, _ in found) / len(found))
        chords.append(min(chord for _, chord in found))
    return values, chords
